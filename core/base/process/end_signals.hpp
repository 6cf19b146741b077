// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::base {

/// Signals by which a run or a study is asked to end in good order: those of a person (INT), of the
/// system (TERM), of a terminal that closes (HUP, unless it is ignored as by nohup), of batch
/// systems (USR1) and of the limit on processor time (XCPU).
void catch_end_signals(void (*handler)(int));
/// They end the program again.
void release_end_signals();

/// What would end the program at a write comes back as the error of that write: nobody reads what
/// is printed any more (PIPE), or a file exceeds `ulimit -f` (XFSZ).
void ignore_write_signals();

}  // namespace dust::base
