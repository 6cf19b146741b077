// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace dust::model::feed {

/// Number fractions from mass fractions: \f$ n_i \propto f_i / d_i^3 \f$, not normalised.
inline std::vector<double> numbers_from_masses(const std::vector<double>& fractions,
                                               const std::vector<double>& diameters) {
  std::vector<double> numbers(fractions.size());
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    numbers[i] = fractions[i] / (diameters[i] * diameters[i] * diameters[i]);
  }
  return numbers;
}

/// Mass [kg] of a sphere.
inline double mass(double density, double diameter) {
  return density * std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

/// Solid volume fraction of a stream of `mass_flow` [kg/s] at `speed` [m/s] through `area` [m2]:
/// \f$ \phi = \dot m / (\rho A v) \f$.
inline double solids(double mass_flow, double density, double area, double speed) {
  return mass_flow / (density * area * speed);
}

/// Draws the next size so that the counts follow the fractions: class i with a chance proportional
/// to f_i (n + window) - count_i. No class strays from its share by more than f_i times the window.
/// `fractions` add up to 1; `u` in (0, 1).
inline std::size_t draw_class(const std::vector<double>& fractions,
                              const std::vector<long long>& counts, double window, double u) {
  double n = window;
  for (const long long c : counts) n += static_cast<double>(c);
  double sum = 0.0;
  const auto claim = [&](std::size_t i) {
    const double c = fractions[i] * n - static_cast<double>(counts[i]);
    return c > 0.0 ? c : 0.0;
  };
  for (std::size_t i = 0; i < fractions.size(); ++i) sum += claim(i);
  double x = u * sum;
  std::size_t last = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    if (claim(i) <= 0.0) continue;
    last = i;
    x -= claim(i);
    if (x <= 0.0) return i;
  }
  return last;
}

}  // namespace dust::model::feed
