// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere.hpp"

namespace dust::model::virtual_mass {

/// Mass of fluid that an accelerating sphere takes along [kg], \f$ m_a = C_A \rho_f V_p \f$: C_A
/// [-] (0.5 for a lone sphere), density of the fluid [kg/m3], diameter [m]. Source: Lamb,
/// Hydrodynamics, 6th ed. (1932), section 92.
inline double added_mass(double coefficient, double density, double diameter) {
  return coefficient * density * sdk::sphere_volume(diameter);
}

}  // namespace dust::model::virtual_mass
