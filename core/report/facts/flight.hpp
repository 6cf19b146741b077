// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace dust::report {

/// A grain by itself, thrown level.
struct IsolatedGrain {
  double diameter = 0.0;  ///< [m]
  double density = 0.0;   ///< [kg/m3]
  double speed = 0.0;     ///< [m/s] level, at the start
};

/// What it flies through; both 0: nothing.
struct StillAir {
  double density = 0.0;    ///< [kg/m3]
  double viscosity = 0.0;  ///< [Pa s] dynamic
};

/// How far forward [m] a lone grain is at each of the `drops` [m, ascending] below its start:
///   m dv/dt = m g (1 - rho_f / rho_p) - 3 pi mu d (1 + 0.15 Re^0.687) v,  Re = rho_f |v| d / mu
/// (Schiller and Naumann 1935, good to 5 % up to Re 800), by Runge and Kutta's fourth order; the
/// step is 1/50 of the response time rho_p d^2 / (18 mu), so that its error is far below a um. A
/// stream drags the air along and flies farther than a grain of it would alone. `gravity` [m/s2].
[[nodiscard]] std::vector<double> isolated_flight(const IsolatedGrain& grain, const StillAir& air,
                                                  double gravity, std::span<const double> drops);

}  // namespace dust::report
