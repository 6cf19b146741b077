// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::koch_hill {

/// Solids fraction from which the packed form of F_0 holds [-].
inline constexpr double k_packed = 0.4;

/// Drag at vanishing Reynolds number [-] for a solids fraction in [0, 1).
inline double slow(double solids) {
  const double eps = 1.0 - solids;
  if (solids >= k_packed) return 10.0 * solids / (eps * eps * eps);
  if (solids <= 0.0) return 1.0;
  const double over = 1.0 + 3.0 * std::sqrt(0.5 * solids) +
                      135.0 / 64.0 * solids * std::log(solids) + 16.14 * solids;
  const double under =
      1.0 + 0.681 * solids - 8.48 * solids * solids + 8.16 * solids * solids * solids;
  return over / under;
}

/// Growth of the drag with Re / 2 [-].
inline double growth(double solids) {
  return 0.0673 + 0.212 * solids + 0.0232 / std::pow(1.0 - solids, 5);
}

/// Drag on a grain over its Stokes drag [-], f_d = 3 pi mu D F w: F = eps^2 (F_0 + F_3 Re / 2);
/// Re = eps rho_f |w| D / mu >= 0, eps in (0, 1]. 135/64 is a real number (2.109).
/// Source: Koch and Hill (2001) 10.1146/annurev.fluid.33.1.619.
inline double factor(double reynolds, double void_fraction) {
  const double solids = 1.0 - void_fraction;
  return void_fraction * void_fraction * (slow(solids) + 0.5 * growth(solids) * reynolds);
}

}  // namespace dust::model::koch_hill
