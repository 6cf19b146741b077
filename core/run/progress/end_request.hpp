// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::run {

/// Asking a run to end, as Ctrl-C, a batch system or `kill` does. From here on a signal is noted;
/// a second one ends the program at once, for making a run ready cannot be broken off.
void note_end_requests_while_making_ready();
/// From here on any number of signals are noted, and the run looks for them between its steps.
void note_end_requests_between_steps();
/// The last signal; 0: none.
[[nodiscard]] int end_request();

}  // namespace dust::run
