// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere.hpp"
#include "dust/sdk/vec3.hpp"

namespace dust::model::archimedes {

/// Hydrostatic buoyancy of a sphere [N], \f$ f = -\rho_f V_p g \f$: density of the fluid [kg/m3] >
/// 0, diameter [m], gravity the vector [m/s2].
inline sdk::Vec3 force(double density, double diameter, sdk::Vec3 gravity) {
  return (-density * sdk::sphere_volume(diameter)) * gravity;
}

}  // namespace dust::model::archimedes
