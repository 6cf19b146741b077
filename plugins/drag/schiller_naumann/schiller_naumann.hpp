// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::schiller_naumann {

/// Reynolds number from which the drag coefficient is 0.44 [-].
inline constexpr double k_newton = 1000.0;

/// Drag on a grain over its Stokes drag [-], f_d = 3 pi mu D F w. A law of one sphere: it takes the
/// Reynolds number of the interstitial slip, Re / eps = rho_f |w| D / mu, and no other part of the
/// void fraction. Re / eps from 0 to 2e5; steps up by 0.4 % at 1000.
/// Source: Schiller and Naumann (1933), Z. Ver. Dtsch. Ing. 77, 318.
inline double factor(double reynolds, double void_fraction) {
  const double own = reynolds / void_fraction;
  return own < k_newton ? 1.0 + 0.15 * std::pow(own, 0.687) : 0.44 / 24.0 * own;
}

}  // namespace dust::model::schiller_naumann
