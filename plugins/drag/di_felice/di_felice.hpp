// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::di_felice {

/// Exponent of the void fraction in the force per superficial slip [-]: 3.7 at both ends, least at
/// Re = 10^1.5.
inline double exponent(double reynolds) {
  const double away = 1.5 - std::log10(reynolds);
  return 3.7 - 0.65 * std::exp(-0.5 * away * away);
}

/// Drag on a grain over its Stokes drag [-], f_d = 3 pi mu D F w: F = C_d Re / 24 eps^(1 - xi),
/// C_d = (0.63 + 4.8 / sqrt(Re))^2; Re = eps rho_f |w| D / mu >= 0, eps in (0, 1]. Written without
/// the division by Re, so that Re = 0 gives its limit, 0.96.
/// Source: Di Felice (1994) 10.1016/0301-9322(94)90011-6.
inline double factor(double reynolds, double void_fraction) {
  const double root = 0.63 * std::sqrt(reynolds) + 4.8;
  return root * root / 24.0 * std::pow(void_fraction, 1.0 - exponent(reynolds));
}

}  // namespace dust::model::di_felice
