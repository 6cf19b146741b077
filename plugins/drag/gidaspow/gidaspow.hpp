// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::gidaspow {

/// Void fraction above which a grain counts as dilute [-].
inline constexpr double k_dilute = 0.8;

/// Ergun's drag of a packed bed over Stokes drag [-].
constexpr double dense(double reynolds, double void_fraction) {
  return (150.0 * (1.0 - void_fraction) + 1.75 * reynolds) / (18.0 * void_fraction);
}

/// Wen and Yu's drag of a suspension over Stokes drag [-].
inline double dilute(double reynolds, double void_fraction) {
  const double single_sphere =
      reynolds < 1000.0 ? 1.0 + 0.15 * std::pow(reynolds, 0.687) : 0.44 / 24.0 * reynolds;
  return single_sphere * std::pow(void_fraction, -2.65);
}

/// Drag on a grain over its Stokes drag [-], f_d = 3 pi mu D F w: Wen and Yu for eps > 0.8, else
/// Ergun; Re = eps rho_f |w| D / mu >= 0, eps in (0, 1]. At 0.8 Ergun's is 2.5 to 73 % more up to
/// Re 100.
/// Source: Gidaspow (1994), Multiphase Flow and Fluidization, chapter 2.
inline double factor(double reynolds, double void_fraction) {
  return void_fraction > k_dilute ? dilute(reynolds, void_fraction)
                                  : dense(reynolds, void_fraction);
}

}  // namespace dust::model::gidaspow
