// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace dust::model::feed {

/// Mass [kg] of a sphere.
inline double mass(double density, double diameter) {
  return density * std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

/// Solid volume fraction of a stream of `mass_flow` [kg/s] at `speed` [m/s] through `area` [m2]:
/// \f$ \phi = \dot m / (\rho A v) \f$.
inline double solids(double mass_flow, double density, double area, double speed) {
  return mass_flow / (density * area * speed);
}

}  // namespace dust::model::feed
