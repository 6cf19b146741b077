// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace dust::model::settling_velocity {

/// The first passage of a height that falls through each of several levels.
class Passages {
 public:
  explicit Passages(std::vector<double> levels)
      : levels_(std::move(levels)), time_(levels_.size(), 0.0), velocity_(levels_.size(), 0.0) {}

  /// `before`, `now`: heights [m] at the times `now_time - interval` and `now_time` [s]; linear in
  /// between. `velocity` [m/s] is taken the same way from `velocity_before`.
  void look(double before, double now, double velocity_before, double velocity, double now_time,
            double interval) {
    for (std::size_t n = 0; n < levels_.size(); ++n) {
      if (time_[n] > 0.0 || before <= levels_[n] || now > levels_[n]) continue;
      const double part = (before - levels_[n]) / (before - now);
      time_[n] = now_time - (1.0 - part) * interval;
      velocity_[n] = velocity_before + part * (velocity - velocity_before);
    }
  }
  [[nodiscard]] const std::vector<double>& levels() const { return levels_; }
  [[nodiscard]] std::vector<double>& times() { return time_; }
  [[nodiscard]] const std::vector<double>& times() const { return time_; }
  [[nodiscard]] std::vector<double>& velocities() { return velocity_; }
  [[nodiscard]] const std::vector<double>& velocities() const { return velocity_; }

 private:
  std::vector<double> levels_;    ///< [m]
  std::vector<double> time_;      ///< [s] 0: not passed yet
  std::vector<double> velocity_;  ///< [m/s]
};

}  // namespace dust::model::settling_velocity
