// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::fluid {

/// Whether red-black sweeps visit the numbers of their colour alone. In vectors they go over whole
/// rows: what they find for the other colour is thrown away, and its numbers are stored as they
/// were. No result hangs on that, but the thread sanitizer sees a row read what its neighbour
/// stores. Under it a sweep reads and writes what it needs, so that a real race shows.
#if defined(__SANITIZE_THREAD__)
constexpr bool k_visits_one_colour = true;
#else
constexpr bool k_visits_one_colour = false;
#endif

}  // namespace dust::fluid
