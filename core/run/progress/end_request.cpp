// SPDX-License-Identifier: Apache-2.0
#include "run/progress/end_request.hpp"

#include "base/process/end_signals.hpp"

#include <csignal>

namespace dust::run {
namespace {

volatile std::sig_atomic_t g_signal = 0;

void on_signal(int signal) { g_signal = signal; }

void on_early_signal(int signal) {
  g_signal = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void note_end_requests_while_making_ready() { base::catch_end_signals(on_early_signal); }
void note_end_requests_between_steps() { base::catch_end_signals(on_signal); }
int end_request() { return g_signal; }

}  // namespace dust::run
