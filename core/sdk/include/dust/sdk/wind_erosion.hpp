// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"

#include <cmath>

/// Dust that wind takes off a surface, for whoever asks: grains in the wind and walls under it.
namespace dust::sdk {

struct WindErosion {
  double emission_coefficient = 1e-3;
  double cohesion = 3e-4;
};

/// Parameters of a model that inherits from WindErosion.
template <class P>
void declare_wind_erosion(SchemaOf<P>& s) {
  s.number(&P::emission_coefficient, "emission_coefficient", dimension::none / dimension::length,
           "Dust that leaves a surface per area over what the wind drives along it per width: "
           "1e-4 to 0.1 per metre for soils.")
      .symbol("alpha")
      .above(0)
      .optional();
  s.number(&P::cohesion, "cohesion", dimension::surface_energy,
           "Of dust to its grain in the threshold: 1.65e-4 to 5e-4 kg/s2 for dry soils.")
      .symbol("gamma")
      .at_least(0)
      .optional();
}

namespace wind_erosion {

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

}  // namespace wind_erosion
}  // namespace dust::sdk
