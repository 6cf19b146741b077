// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace dust::run {

/// Wall time per simulated time, smoothed over the last seconds.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Pace(double time_at_start) : last_(Clock::now()), last_time_(time_at_start) {}
  /// After a step; looks at the clock and takes note every half second.
  void update(double time);
  [[nodiscard]] bool is_known() const { return pace_ > 0.0; }
  [[nodiscard]] double seconds_per_second() const { return pace_; }

 private:
  Clock::time_point last_;
  double last_time_;
  double pace_ = 0.0;
};

/// The progress line: percent, simulated time, speed and ETA. On a terminal one line is rewritten;
/// elsewhere a line is printed every 30 s. Silent when quiet.
class Progress {
 public:
  Progress(bool is_quiet, double end_time);
  void update(double time, std::int64_t grains, const Pace& pace);
  /// Leaves the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_quiet_;
  bool is_terminal_;
  double end_time_;
  Clock::time_point last_print_;
};

}  // namespace dust::run
