// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace dust::run {

/// The progress line: percent, simulated time, speed and ETA. On a terminal one line is rewritten;
/// elsewhere a line is printed every 30 s. Silent when quiet.
class Progress {
 public:
  Progress(bool is_quiet, double end_time, double time_at_start);
  void update(double time, std::int64_t grains);
  /// Leaves the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_quiet_;
  bool is_terminal_;
  double end_time_;
  double time_at_start_;
  Clock::time_point start_;
  Clock::time_point last_print_;
  double recent_time_;
  double pace_ = 0.0;  ///< wall seconds per simulated second, smoothed
};

}  // namespace dust::run
