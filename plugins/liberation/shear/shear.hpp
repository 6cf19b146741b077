// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::model::shear {

/// Threshold friction velocity [m/s] of dry dust of diameter d [m] and density rho_p in a gas of
/// density rho_f [kg/m3], with the cohesion gamma [kg/s2]:
///   u_t^2 = A (rho_p/rho_f g d + gamma/(rho_f d)), A = 0.0123.
/// Shao and Lu, J. Geophys. Res. 105 (2000) 22437, doi:10.1029/2000JD900304, eq. (24); 10 um to 2
/// mm; docs/theory/dust.md, eq. (15).
inline double threshold(double diameter, double density, double gas_density, double cohesion,
                        double gravity) {
  constexpr double k_a = 0.0123;
  return std::sqrt(
      k_a * (density / gas_density * gravity * diameter + cohesion / (gas_density * diameter)));
}

/// By what moisture raises it [-]: sqrt(1 + 1.21 (w - w')^0.68) above w', 1 below; w, w' in
/// percent. Fecan, Marticorena and Bergametti, Ann. Geophysicae 17 (1999) 149, eq. (14).
inline double raised_by_moisture(double moisture, double held_moisture) {
  const double above = 100.0 * std::max(0.0, moisture - held_moisture);
  return std::sqrt(1.0 + 1.21 * std::pow(above, 0.68));
}

/// Flux [kg/(m2 s)] off a surface at the friction velocity u [m/s] above the threshold u_t,
///   F = alpha rho_f/g u^3 (1 - u_t^2/u^2); 0 below,
/// alpha [1/m] times what the wind drives along per width, in the usual form; of that and alpha:
/// Marticorena and Bergametti, J. Geophys. Res. 100 (1995) 16415, doi:10.1029/95JD00690;
/// docs/theory/dust.md, eq. (14).
inline double flux(double friction_velocity, double threshold_velocity, double gas_density,
                   double coefficient, double gravity) {
  const double u = friction_velocity;
  if (!(u > threshold_velocity)) return 0.0;
  const double ratio = threshold_velocity / u;
  return coefficient * gas_density / gravity * u * u * u * (1.0 - ratio * ratio);
}

/// Dust [kg] that comes off a load m [kg] of a class where the wind asks for x [kg] of a fresh
/// grain whose classes together carried m_0: each class gives by what is left of it,
///   dm = m (1 - exp(-x / m_0)).
inline double released(double load, double fresh_load, double asked) {
  return load > 0.0 ? -load * std::expm1(-asked / fresh_load) : 0.0;
}

}  // namespace dust::model::shear
