// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::beetstra {

/// Drag over 3 pi mu D U, U the superficial slip [-]; Re = rho_f U D / mu >= 0, eps in (0, 1].
/// Numerator and denominator of the inertial part carry Re^0.657 and Re^-x: both have a limit at 0.
inline double per_superficial(double reynolds, double void_fraction) {
  const double eps = void_fraction;
  const double solids = 1.0 - eps;
  const double creeping = 10.0 * solids / (eps * eps) + eps * eps * (1.0 + 1.5 * std::sqrt(solids));
  const double over =
      reynolds * (1.0 / eps + 3.0 * solids * eps) + 8.4 * std::pow(reynolds, 1.0 - 0.343);
  const double under =
      1.0 + std::pow(10.0, 3.0 * solids) * std::pow(reynolds, -0.5 * (1.0 + 4.0 * solids));
  return creeping + 0.413 / (24.0 * eps * eps) * over / under;
}

/// Drag on a grain over its Stokes drag [-], f_d = 3 pi mu D F w: F = eps F_B(Re, eps).
/// Source: Beetstra, van der Hoef and Kuipers (2007) 10.1002/aic.11065.
inline double factor(double reynolds, double void_fraction) {
  return void_fraction * per_superficial(reynolds, void_fraction);
}

/// The same for grains of several sizes; `size_ratio` y = D / <D>, <D> the Sauter mean around the
/// grain: F_i = (y + 0.064 y^3) eps F_B(Re / y, eps). The published factor of the whole force of
/// the fluid, eps y + eps_p y^2 + 0.064 eps y^3, holds the pressure gradient's part eps_p y^2,
/// which is a force of its own here; what is left is eps (y + 0.064 y^3).
/// Source: van der Hoef, Beetstra and Kuipers (2005) 10.1017/S0022112004003295.
inline double factor(double reynolds, double void_fraction, double size_ratio) {
  const double y = size_ratio;
  return (y + 0.064 * y * y * y) * factor(reynolds / y, void_fraction);
}

}  // namespace dust::model::beetstra
