// SPDX-License-Identifier: Apache-2.0
#include "run/progress/progress.hpp"

#include "base/text.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace dust::run {

void Pace::update(double time) {
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (since < 0.5 || !(time > last_time_)) return;
  const double recent = since / (time - last_time_);
  // An old measure fades within about ten seconds, however long the steps are.
  const double share = 1.0 - std::exp(-since / 10.0);
  pace_ = pace_ == 0.0 ? recent : pace_ + share * (recent - pace_);
  last_ = now;
  last_time_ = time;
}

Progress::Progress(bool is_quiet, double end_time)
    : is_quiet_(is_quiet),
      is_terminal_(isatty(STDOUT_FILENO) != 0),
      end_time_(end_time),
      last_print_(Clock::now()) {}

void Progress::update(double time, std::int64_t grains, const Pace& pace) {
  if (is_quiet_ || !pace.is_known()) return;
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_print_).count();
  if (since < (is_terminal_ ? 0.5 : 30.0)) return;
  last_print_ = now;
  std::printf(
      "%s%5.1f %%  %.4g of %.4g s  %lld grains  %.0f s per simulated s  ETA %s%s",
      is_terminal_ ? "\r\033[K" : "", 100.0 * time / end_time_, time, end_time_,
      static_cast<long long>(grains), pace.seconds_per_second(),
      base::duration_text(std::round(pace.seconds_per_second() * (end_time_ - time))).c_str(),
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
