// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/grid_shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace my_sensor {

/// Kinetic energy [J] of mass m [kg] at the velocity (x, y, z) [m/s]: \f$ m v^2 / 2 \f$.
inline double kinetic_energy(double mass, double x, double y, double z) {
  return 0.5 * mass * (x * x + y * y + z * z);
}

/// Bins of the histogram: one per power of ten of the energy per mass [J/kg].
constexpr int k_first_decade = -6;
constexpr int k_decades = 9;

/// The bin of an energy per mass > 0 [J/kg]; what is beyond counts in the outermost bins.
inline std::size_t decade(double energy_per_mass) {
  const int bin = static_cast<int>(std::floor(std::log10(energy_per_mass))) - k_first_decade;
  return static_cast<std::size_t>(std::clamp(bin, 0, k_decades - 1));
}

/// Number of the cell of `grid` that holds a place [m]; places beyond count in the outermost cells.
inline std::size_t cell(dust::sdk::Vec3 place, const dust::sdk::GridShape& grid) {
  std::size_t number = 0;
  for (int d = 2; d >= 0; --d) {
    const int n = static_cast<int>((place[d] - grid.origin[d]) / grid.spacing[d]);
    const int count = grid.count[d];
    number = number * static_cast<std::size_t>(count) +
             static_cast<std::size_t>(std::clamp(n, 0, count - 1));
  }
  return number;
}

}  // namespace my_sensor
