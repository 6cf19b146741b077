// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/thin_bodies.hpp"
#include "particles/grain_rows.hpp"

#include <vector>

namespace dust::coupling {

/// The rows with positions in cells of the grains' own sides of bodies thinner than a cell
/// (fluid::ThinBodies): solids and drag of a grain that lies on a sheet do not reach the fluid
/// behind it.
class OwnSides {
 public:
  /// Kept by reference; without it all rows are passed on as they are.
  void use(const fluid::ThinBodies& bodies) { bodies_ = &bodies; }
  [[nodiscard]] const fluid::ThinBodies* bodies() const { return bodies_; }
  /// Valid until the next call.
  [[nodiscard]] particles::GrainRows take(const particles::GrainRows& rows);

 private:
  const fluid::ThinBodies* bodies_ = nullptr;
  std::vector<double> position_;
};

}  // namespace dust::coupling
