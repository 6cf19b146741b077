// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::ergun {

/// Drag on a grain of a packed bed over its Stokes drag [-], f_d = 3 pi mu D F w:
/// \f$ F = \frac{1}{18} \left( 150 \frac{1 - \varepsilon}{\varepsilon}
///                            + 1.75 \frac{Re}{\varepsilon} \right) \f$,
/// Re = eps rho_f |w| D / mu >= 0, eps in (0, 1].
/// Source: Ergun (1952), Chem. Eng. Prog. 48, 89, divided by the grains of a unit volume.
/// Limits: fitted to eps <= 0.8; outside it extrapolates and falls below the drag of one sphere.
constexpr double factor(double reynolds, double void_fraction) {
  return (150.0 * (1.0 - void_fraction) + 1.75 * reynolds) / (18.0 * void_fraction);
}

}  // namespace dust::model::ergun
