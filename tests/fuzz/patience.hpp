// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/time.h>

#include <csignal>
#include <cstdlib>

namespace dust::fuzz {

/// Ends the program, for the fuzzer to keep the input, when one input takes this much processor
/// time: inputs take milliseconds. Wall time would blame inputs for a busy or sleeping machine.
class Patience {
 public:
  static constexpr int k_seconds = 20;

  Patience() {
    static const bool is_set = std::signal(SIGVTALRM, [](int) { std::abort(); }) != SIG_ERR;
    if (is_set) set(k_seconds);
  }
  ~Patience() { set(0); }
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

 private:
  static void set(int seconds) {
    const itimerval timer{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_VIRTUAL, &timer, nullptr);
  }
};

}  // namespace dust::fuzz
