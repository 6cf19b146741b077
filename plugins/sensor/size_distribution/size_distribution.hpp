// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <cstddef>
#include <span>

namespace dust::model::size_distribution {

/// Sauter mean diameter [m] \f$ d_{32} = \sum n_i d_i^3 / \sum n_i d_i^2 \f$;
/// sdk::k_no_value for no grains.
inline double sauter(std::span<const double> diameters, std::span<const double> numbers) {
  double cubes = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    squares += numbers[i] * diameters[i] * diameters[i];
    cubes += numbers[i] * diameters[i] * diameters[i] * diameters[i];
  }
  return squares > 0.0 ? cubes / squares : sdk::k_no_value;
}

/// Diameter [m] below which the share `q` of the amounts lies. The share of a class is spread
/// evenly over it, half below and half above its diameter, and the sum is interpolated between the
/// diameters; beyond the first and last class it stays there. sdk::k_no_value for no grains.
inline double quantile(std::span<const double> diameters, std::span<const double> amounts,
                       double q) {
  double sum = 0.0;
  for (const double a : amounts) sum += a;
  if (!(sum > 0.0)) return sdk::k_no_value;
  double below = 0.0;
  double last_share = 0.0;
  double last_diameter = 0.0;
  bool has_last = false;
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    if (!(amounts[i] > 0.0)) continue;
    const double share = (below + 0.5 * amounts[i]) / sum;
    if (q <= share) {
      if (!has_last) return diameters[i];
      return last_diameter +
             (diameters[i] - last_diameter) * (q - last_share) / (share - last_share);
    }
    below += amounts[i];
    last_share = share;
    last_diameter = diameters[i];
    has_last = true;
  }
  return last_diameter;
}

}  // namespace dust::model::size_distribution
