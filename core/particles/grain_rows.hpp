// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// The grains as the DEM holds them: rows of four doubles in row order. Valid until the next
/// insertion, removal or neighbour rebuild. What else a row holds in its fourth column is asked for
/// by name.
struct GrainRows {
  std::size_t count = 0;
  const double* position = nullptr;  ///< x, y, z [m], radius [m]
  const double* velocity = nullptr;  ///< [m/s] at the same instant, 1 / mass [1/kg]
  const double* rotation = nullptr;  ///< angular velocity [rad/s], radius [m]
  const std::int64_t* id = nullptr;
  const std::int32_t* material = nullptr;
  const double* weight = nullptr;  ///< real grains per computed one

  /// Null where no fluid is declared. Written by the coupling at each refresh: the grain's velocity
  /// relaxes towards (x, y, z) [m/s] at the rate in the fourth column [1/s]: dv/dt = rate (target -
  /// v) + contact + g'.
  double* drag_relaxation = nullptr;
  /// Impulse [N s] a computed grain has received through drag_relaxation since the coupling last
  /// set it to zero: x, y, z, unused. Exactly what changed the grain's momentum.
  double* fluid_impulse = nullptr;

  /// Doubles from one grain's velocity, or rotation, to the next's.
  std::size_t motion_stride = 4;

  /// Null unless kept (Dem::keep_wind). Written with drag_relaxation, which holds all that acts on
  /// the grain: the velocity of the fluid at it [m/s], and K [kg/s] of its drag alone.
  double* wind = nullptr;

  [[nodiscard]] const double* position_of(std::size_t row) const { return position + 4 * row; }
  [[nodiscard]] sdk::Vec3 centre(std::size_t row) const {
    const double* x = position_of(row);
    return {x[0], x[1], x[2]};
  }
  [[nodiscard]] double radius(std::size_t row) const { return position_of(row)[3]; }
  [[nodiscard]] double diameter(std::size_t row) const { return 2.0 * radius(row); }
  [[nodiscard]] const double* velocity_of(std::size_t row) const {
    return velocity + motion_stride * row;
  }
  [[nodiscard]] double inverse_mass(std::size_t row) const { return velocity_of(row)[3]; }
  [[nodiscard]] double mass(std::size_t row) const { return 1.0 / inverse_mass(row); }
  [[nodiscard]] const double* rotation_of(std::size_t row) const {
    return rotation + motion_stride * row;
  }
};

}  // namespace dust::particles
