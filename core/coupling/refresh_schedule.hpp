// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <cstdint>

namespace dust::coupling {

/// How often within a fluid step the drag on the particles is found anew, and how often it was.
class RefreshSchedule {
 public:
  /// [s] and [m], the shortest edge of a cell.
  RefreshSchedule(double fluid_step, double least_spacing);

  /// `fastest`: largest rate of relaxation of a particle [1/s]. At most a quarter of its time, at
  /// most the time in which a particle crosses 1/8 of a cell at 2 m/s, and 1 to 64 per step.
  void begin_step(double fluid_step, double fastest);
  /// One more is done, which holds for `held` [s].
  void note(double held);

  [[nodiscard]] double fluid_step() const { return step_; }  ///< [s]
  [[nodiscard]] double interval() const { return step_ / refreshes_; }
  /// Whether the next one is the first of the fluid step.
  [[nodiscard]] bool is_first() const { return done_ == 0; }
  /// [s] of the last one, 0 = none yet.
  [[nodiscard]] double last_held() const { return last_held_; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  [[nodiscard]] double refreshes_for(double fluid_step, double fastest) const;

  double step_;
  double least_spacing_;
  double refreshes_;       ///< per fluid step
  std::int64_t done_ = 0;  ///< in this fluid step
  double last_held_ = 0.0;
};

}  // namespace dust::coupling
