// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_class.hpp"

namespace dust::airborne {

/// Friction velocity [m/s] of a smooth wall from the speed [m/s] of the gas along it at a distance
/// [m]: u+ = y+ up to y+ = 11.81, u+ = 8.3 y+^(1/7) beyond. Werner and Wengle, Turbulent Shear
/// Flows 8 (1993) 155; `viscosity` [m2/s] kinematic; docs/theory/dust.md, eq. (19).
[[nodiscard]] double friction_velocity(double speed, double distance, double viscosity);

/// Velocity [m/s] at which turbulence, Brownian motion and settling bring dust to a smooth wall,
///   v = w / (1 - exp(-w I / u_*)),
/// `settling` w [m/s] that towards the wall (negative: away from it), I the integral over the layer
/// at the wall: Lai and Nazaroff, J. Aerosol Sci. 31 (2000) 463, doi:10.1016/S0021-8502(99)00536-4;
/// of walls that face up, stand and face down one formula. No inertia: dust whose response time
/// tau u_*^2 / nu is below about 1; docs/theory/dust.md, eq. (21).
[[nodiscard]] double deposition_velocity(const DustClass& dust, double settling,
                                         double friction_velocity, double viscosity);

}  // namespace dust::airborne
