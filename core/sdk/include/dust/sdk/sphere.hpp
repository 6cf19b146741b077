// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace dust::sdk {

/// Volume of a sphere [m3] of `diameter` [m]: \f$ V = \pi D^3 / 6 \f$.
constexpr double sphere_volume(double diameter) {
  return std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

/// Moment of inertia [kg m2] of a full sphere: \f$ I = \tfrac{2}{5} m R^2 \f$.
constexpr double sphere_inertia(double mass, double radius) { return 0.4 * mass * radius * radius; }

}  // namespace dust::sdk
