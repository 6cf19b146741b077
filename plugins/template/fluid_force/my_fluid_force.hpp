// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sphere.hpp>
#include <dust/sdk/vec3.hpp>

namespace my_fluid_force {

/// Lift of a sphere in a weak shear at high Re [N],
/// \f$ f = C_L \rho_f V_p\, w \times \omega \f$: coefficient C_L [-], density of the fluid [kg/m3],
/// diameter [m], slip w [m/s], vorticity [1/s].
/// Source: Auton, J. Fluid Mech. 183 (1987) 199-218.
inline dust::sdk::Vec3 force(double coefficient, double density, double diameter,
                             dust::sdk::Vec3 slip, dust::sdk::Vec3 vorticity) {
  return (coefficient * density * dust::sdk::sphere_volume(diameter)) * cross(slip, vorticity);
}

}  // namespace my_fluid_force
