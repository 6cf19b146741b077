// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dust::run {

/// The particle steps within a fluid step: which one it is, and when the drag is due again.
class DemCycle {
 public:
  /// [s]
  DemCycle(double fluid_step, double dem_step)
      : dem_step_(dem_step),
        steps_(std::max<std::int64_t>(1, std::llround(fluid_step / dem_step))) {}

  /// Before the first step: every how many the drag is due, from the interval [s] asked for.
  void begin(double refresh_interval) {
    steps_per_refresh_ =
        std::max<std::int64_t>(1, std::llround(std::floor(refresh_interval / dem_step_ + 1e-6)));
    begin();
  }
  /// The same as often as before.
  void begin() { step_ = 0; }
  void advance() { ++step_; }

  [[nodiscard]] bool is_done() const { return step_ >= steps_; }
  [[nodiscard]] bool is_last_step() const { return step_ + 1 == steps_; }
  /// [s] since the beginning of the fluid step
  [[nodiscard]] double time() const { return static_cast<double>(step_) * dem_step_; }
  [[nodiscard]] bool is_refresh_due() const { return step_ % steps_per_refresh_ == 0; }
  /// [s] that a refresh now holds for
  [[nodiscard]] double refresh_held() const {
    return static_cast<double>(std::min(steps_per_refresh_, steps_ - step_)) * dem_step_;
  }

 private:
  double dem_step_;
  std::int64_t steps_;
  std::int64_t steps_per_refresh_ = 1;
  std::int64_t step_ = 0;
};

}  // namespace dust::run
