// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <cmath>
#include <cstdint>

namespace dust::run {

/// Counts the fluid steps of a run.
class StepClock {
 public:
  /// [s]
  StepClock(double fluid_step, double end)
      : fluid_step_(fluid_step),
        steps_wanted_(static_cast<std::int64_t>(std::ceil(end / fluid_step - 1e-9))) {}

  [[nodiscard]] double fluid_step() const { return fluid_step_; }  ///< [s]
  [[nodiscard]] double time() const { return static_cast<double>(steps_done_) * fluid_step_; }
  /// [s] as the last step had it, its begin and its length: beside time() by a rounding. What a
  /// resumed run finds anew of the end of that step, it finds at this time.
  [[nodiscard]] double end_of_last_step() const {
    return steps_done_ > 0 ? static_cast<double>(steps_done_ - 1) * fluid_step_ + fluid_step_ : 0.0;
  }
  [[nodiscard]] std::int64_t steps_done() const { return steps_done_; }
  [[nodiscard]] bool is_finished() const { return steps_done_ >= steps_wanted_; }
  void advance() { ++steps_done_; }

  /// Of a run that does not start at 0 s.
  void start_at(std::int64_t steps) { steps_done_ = steps; }

  void save(sdk::ArchiveWriter& archive) const { archive.integer("steps_done", steps_done_); }
  void load(sdk::ArchiveReader& archive) { steps_done_ = archive.integer("steps_done"); }

 private:
  double fluid_step_;
  std::int64_t steps_wanted_;
  std::int64_t steps_done_ = 0;
};

}  // namespace dust::run
