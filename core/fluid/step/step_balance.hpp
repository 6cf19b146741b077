// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/momentum_balance.hpp"
#include "fluid/step/step_void_fraction.hpp"

#include <memory>

namespace dust::fluid {

/// The momentum balance of fluid steps in which it is kept, and the mean pressure over them.
class StepBalance {
 public:
  /// References are kept.
  StepBalance(const Grid& grid, const Geometry& geometry, const FaceProperties& properties)
      : grid_(grid), geometry_(geometry), properties_(properties) {}

  /// Whether it is kept in the step that begins.
  void begin_step(bool is_kept) { is_kept_ = is_kept; }
  /// As MomentumBalance::begin; its own memory is made when it is first kept.
  void begin(const FaceField& u, StepVoidFraction& void_fraction, const FaceField& source,
             double step);
  /// Adds the pressure of a sub-step that is a `share` of the step; `is_first`: nothing was added.
  void add_pressure(const CellField& pressure, double share, bool is_first);

  [[nodiscard]] bool is_kept() const { return is_kept_; }
  /// Null where it is not kept.
  [[nodiscard]] MomentumBalance* kept() { return is_kept_ ? balance_.get() : nullptr; }
  /// [Pa] over the last step in which it was kept.
  [[nodiscard]] CellField& mean_pressure() { return mean_pressure_; }
  [[nodiscard]] const CellField& mean_pressure() const { return mean_pressure_; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  void make();

  const Grid& grid_;
  const Geometry& geometry_;
  const FaceProperties& properties_;
  std::unique_ptr<MomentumBalance> balance_;  ///< once there were particles
  CellField mean_pressure_;
  bool is_kept_ = false;
};

}  // namespace dust::fluid
