// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <cmath>

namespace dust::model::saffman {

/// 6.46 / 4 of Saffman's corrigendum, J. Fluid Mech. 31 (1968) 624.
inline constexpr double k_coefficient = 1.615;

/// Lift of a small sphere in a shear flow at low Re [N],
/// \f$ f = 1.615 D^2 \sqrt{\rho_f \mu / |\omega|}\; w \times \omega \f$: slip w [m/s],
/// vorticity [1/s]; 0 without vorticity.
/// Source: Saffman (1965) 10.1017/S0022112065000824 with its corrigendum (1968).
inline sdk::Vec3 force(double diameter, double density, double viscosity, sdk::Vec3 slip,
                       sdk::Vec3 vorticity) {
  const double size = norm(vorticity);
  if (!(size > 0.0)) return {};
  const double factor = k_coefficient * diameter * diameter * std::sqrt(density * viscosity / size);
  return factor * cross(slip, vorticity);
}

/// Mei's factor to Saffman's lift at finite Re [-]: Re = rho |w| D / mu,
/// beta = D |omega| / (2 |w|); fitted for 0.1 <= Re <= 100 and 0.005 <= beta <= 0.4.
/// Source: Mei (1992) 10.1016/0301-9322(92)90012-6.
inline double mei_factor(double reynolds, double beta) {
  if (reynolds > 40.0) return 0.0524 * std::sqrt(beta * reynolds);
  const double root = 0.3314 * std::sqrt(beta);
  return (1.0 - root) * std::exp(-0.1 * reynolds) + root;
}

}  // namespace dust::model::saffman
