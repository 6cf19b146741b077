// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::abraham {

/// Reynolds number from which the drag coefficient is 0.44 [-].
inline constexpr double k_newton = 1000.0;

/// Drag on a grain over its Stokes drag [-], f_d = 3 pi mu D F w: C_d = (24 / 9.06^2)
/// (1 + 9.06 / sqrt(Re_p))^2 below Re_p = 1000, 0.44 up to 2e5. A law of one sphere: it takes the
/// Reynolds number of the interstitial slip, Re_p = Re / eps = rho_f |w| D / mu, and no other part
/// of the void fraction. Steps down by 9 % at 1000.
/// Source: Abraham (1970) 10.1063/1.1693218.
inline double factor(double reynolds, double void_fraction) {
  const double own = reynolds / void_fraction;
  if (own >= k_newton) return 0.44 / 24.0 * own;
  const double root = 1.0 + std::sqrt(own) / 9.06;
  return root * root;
}

}  // namespace dust::model::abraham
