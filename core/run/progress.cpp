// SPDX-License-Identifier: Apache-2.0
#include "run/progress.hpp"

#include "base/text.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace dust::run {

Progress::Progress(bool is_quiet, double end_time, double time_at_start)
    : is_quiet_(is_quiet),
      is_terminal_(isatty(STDOUT_FILENO) != 0),
      end_time_(end_time),
      time_at_start_(time_at_start),
      start_(Clock::now()),
      last_print_(start_),
      recent_time_(time_at_start) {}

void Progress::update(double time, std::int64_t grains) {
  if (is_quiet_) return;
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_print_).count();
  if (since < (is_terminal_ ? 0.5 : 30.0)) return;
  const double recent = since / (time - recent_time_);
  pace_ = pace_ == 0.0 ? recent : 0.7 * pace_ + 0.3 * recent;
  last_print_ = now;
  recent_time_ = time;
  std::printf("%s%5.1f %%  %.4g of %.4g s  %lld grains  %.0f s per simulated s  ETA %s%s",
              is_terminal_ ? "\r\033[K" : "", 100.0 * time / end_time_, time, end_time_,
              static_cast<long long>(grains), pace_,
              base::duration_text(std::round(pace_ * (end_time_ - time))).c_str(),
              is_terminal_ ? "" : "\n");
  std::fflush(stdout);
}

void Progress::finish() {
  if (!is_quiet_ && is_terminal_) {
    std::printf("\r\033[K");
    std::fflush(stdout);
  }
}

}  // namespace dust::run
