// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace my_turbulence {

inline constexpr double k_karman = 0.41;

/// Eddy viscosity of a mixing length [Pa s], \f$ \mu_t = \rho\, l^2 |S| \f$, l the given length or,
/// nearer to a wall, 0.41 of the distance [m]; density [kg/m3], |S| the strain rate [1/s].
/// Source: Prandtl, Z. angew. Math. Mech. 5 (1925) 136-139.
inline double eddy_viscosity(double density, double mixing_length, double wall_distance,
                             double strain_rate) {
  const double length = std::min(mixing_length, k_karman * wall_distance);
  return density * length * length * strain_rate;
}

}  // namespace my_turbulence
