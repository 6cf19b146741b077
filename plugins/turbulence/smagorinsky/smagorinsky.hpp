// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace dust::model::smagorinsky {

/// Constant of the logarithmic layer at a wall.
inline constexpr double k_karman = 0.41;

/// Eddy viscosity [Pa s], \f$ \mu_t = \rho\, l^2 |S| \f$, \f$ l = \min(C_s \Delta, 0.41 d) \f$:
/// coefficient C_s [-], filter width Delta and distance d from the wall [m], strain rate [1/s],
/// density [kg/m3].
/// Source: Smagorinsky (1963) 10.1175/1520-0493(1963)091<0099:GCEWTP>2.3.CO;2.
inline double eddy_viscosity(double coefficient, double filter_width, double wall_distance,
                             double strain_rate, double density) {
  const double length = std::min(coefficient * filter_width, k_karman * wall_distance);
  return density * length * length * strain_rate;
}

}  // namespace dust::model::smagorinsky
