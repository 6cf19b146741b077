// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cmath>
#include <numbers>

namespace dust::model::magnus {

/// Lift of a spinning sphere at low Re [N], \f$ f = \frac{\pi}{8} D^3 \rho_f\, \Omega \times w \f$:
/// slip w [m/s], Omega the spin of the fluid less that of the grain [rad/s].
/// Source: Rubinow and Keller (1961) 10.1017/S0022112061000640.
inline sdk::Vec3 force(double diameter, double density, sdk::Vec3 spin, sdk::Vec3 slip) {
  return (std::numbers::pi / 8.0 * diameter * diameter * diameter * density) * cross(spin, slip);
}

/// Factor to it at finite Re [-]: C_L / (Re_R / Re) with
/// C_L = 0.45 + (Re_R / Re - 0.45) exp(-0.05684 Re_R^0.4 Re^0.3), Re = rho |w| D / mu > 0,
/// Re_R = rho |Omega| D^2 / mu > 0; measured for 10 < Re < 140, 1 < gamma < 6, where gamma is
/// |Omega| D / (2 |w|), so that Re_R / Re is 2 gamma, and 0.05684 the 0.075 2^-0.4 of gamma^0.4.
/// Source: Oesterle and Bui Dinh (1998) 10.1007/s003480050203.
inline double oesterle_factor(double reynolds, double spin_reynolds) {
  const double ratio = spin_reynolds / reynolds;
  const double decay = std::exp(-0.05684 * std::pow(spin_reynolds, 0.4) * std::pow(reynolds, 0.3));
  return (0.45 + (ratio - 0.45) * decay) / ratio;
}

}  // namespace dust::model::magnus
