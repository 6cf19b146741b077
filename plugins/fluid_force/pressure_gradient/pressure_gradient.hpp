// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere.hpp"
#include "dust/sdk/vec3.hpp"

namespace dust::model::pressure_gradient {

/// Force of a pressure gradient [Pa/m] on a sphere of `diameter` [m], \f$ f = -V_p \nabla p \f$
/// [N].
inline sdk::Vec3 force(double diameter, sdk::Vec3 gradient) {
  return -sdk::sphere_volume(diameter) * gradient;
}

/// Gradient of the hydrostatic pressure [Pa/m] of a fluid at rest: rho_f g.
inline sdk::Vec3 hydrostatic_gradient(double density, sdk::Vec3 gravity) {
  return density * gravity;
}

}  // namespace dust::model::pressure_gradient
