// SPDX-License-Identifier: Apache-2.0
#include "base/process/end_signals.hpp"

#include <array>
#include <csignal>

namespace dust::base {
namespace {

constexpr std::array k_end_signals = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};

/// What is started by nohup is to outlive its terminal.
bool is_to_be_ignored(int signal) {
  struct sigaction now {};
  return signal == SIGHUP && ::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

void catch_end_signals(void (*handler)(int)) {
  for (const int signal : k_end_signals) {
    if (!is_to_be_ignored(signal)) std::signal(signal, handler);
  }
}

void release_end_signals() {
  for (const int signal : k_end_signals) {
    if (!is_to_be_ignored(signal)) std::signal(signal, SIG_DFL);
  }
}

void ignore_write_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace dust::base
