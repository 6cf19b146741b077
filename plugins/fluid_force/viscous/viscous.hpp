// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere.hpp"
#include "dust/sdk/vec3.hpp"

namespace dust::model::viscous {

/// Force of the viscous stress of the undisturbed flow on a sphere of `diameter` [m],
/// \f$ f = V_p \nabla\cdot\tau \f$ [N]; divergence of the stress [N/m3].
inline sdk::Vec3 force(double diameter, sdk::Vec3 stress_divergence) {
  return sdk::sphere_volume(diameter) * stress_divergence;
}

}  // namespace dust::model::viscous
