// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/pressure/continuity.hpp"

namespace dust::fluid {

/// The velocity that drag acted on in a fluid step: the mean over sub-steps and stages. Drag took
/// the momentum coefficient * drag velocity * step from the fluid.
class DragVelocity {
 public:
  explicit DragVelocity(const Grid& grid) : grid_(grid), sum_(grid) {}

  /// Nothing yet; whether there is drag in this step.
  void begin(bool has_drag);
  /// Of a stage of weight `share` of the whole fluid step.
  void add_stage(const Geometry& geometry, const FaceField& stage, double share);
  /// What the pressure of the last projection, over `step` [s], adds.
  void add_pressure(const Geometry& geometry, const Continuity& continuity,
                    const FaceProperties& properties, double step, const FaceField& drag,
                    double share);
  /// Fills the halos.
  void end(const Sides& sides) { sides.fill_velocity(sum_); }

  [[nodiscard]] const FaceField& field() const { return sum_; }
  /// Whether the last step had drag.
  [[nodiscard]] bool is_set() const { return is_set_; }

 private:
  const Grid& grid_;
  FaceField sum_;
  bool is_set_ = false;
};

}  // namespace dust::fluid
