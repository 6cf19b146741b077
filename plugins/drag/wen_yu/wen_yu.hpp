// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::wen_yu {

/// Drag of a single sphere over its Stokes drag [-]: \f$ C_d Re / 24 \f$ with
/// C_d = 24 (1 + 0.15 Re^0.687) / Re below Re = 1000, 0.44 from there on (a step of 0.4 % there).
/// Source: Schiller and Naumann (1935), Z. Ver. Dtsch. Ing. 77, 318.
inline double single_sphere(double reynolds) {
  return reynolds < 1000.0 ? 1.0 + 0.15 * std::pow(reynolds, 0.687) : 0.44 / 24.0 * reynolds;
}

/// Drag on a grain of a suspension over its Stokes drag [-], f_d = 3 pi mu D F w:
/// \f$ F = \frac{C_d Re}{24} \varepsilon^{-2.65} \f$, Re = eps rho_f |w| D / mu >= 0, eps in (0,
/// 1]. Source: Wen and Yu (1966), Chem. Eng. Prog. Symp. Ser. 62, 100.
inline double factor(double reynolds, double void_fraction) {
  return single_sphere(reynolds) * std::pow(void_fraction, -2.65);
}

}  // namespace dust::model::wen_yu
