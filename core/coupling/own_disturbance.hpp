// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace dust::coupling {

/// Closed forms for what a single grain does to the fluid it is coupled to, so that it can be taken
/// off again. Derivations, figures and limits: docs/theory/own_disturbance.md. The grain's force is
/// spread over a ball of radius `a` [m] (k_trilinear_radius cells for the eight faces around a
/// small grain), moving with the slip `w` through the fluid; Re_a = rho w a / mu.
namespace own_disturbance {

/// Radius of the ball that takes up as much momentum from a slow fluid as the eight faces with
/// trilinear weights do on the mean over all places in a cell, in edges of a cubic cell [-]: the
/// discrete Stokes flow answers a unit force with 0.0847 / (mu h), the ball with 1 / (5 pi mu a).
inline constexpr double k_trilinear_radius = 0.7515;
/// Inverse of the volume [1/cells] over which the force of those eight faces counts at the grain
/// where the force by pressure and stress is read, the two faces of its cell: 1/2 (3/4)^2.
inline constexpr double k_trilinear_density = 0.28125;

/// Mean velocity [m/s] of the fluid in the ball per unit force on it [1/(N s/m) = s/kg],
/// \f$ G = \frac{1}{5\pi\mu a} \left[1 + Re_a \left(\frac{5}{16} +
///   \left(\frac{16}{45} - \frac{5}{16}\right) \frac{Re_a}{Re_a + 5/2}\right)\right]^{-1} \f$.
/// Both limits are those of Oseen's flow around the ball; between them 0.5 % of its integral.
inline double mobility(double radius, double viscosity, double reynolds) {
  const double inertia = 5.0 / 16.0 + (16.0 / 45.0 - 5.0 / 16.0) * reynolds / (reynolds + 2.5);
  return 1.0 / (5.0 * std::numbers::pi * viscosity * radius * (1.0 + reynolds * inertia));
}

/// Part of the force density in the ball that pressure and viscous stress balance there [-], 1 in
/// Stokes flow, 1/3 at large Re_a, where the rest accelerates what flows through. Within 0.04 of
/// Oseen's flow.
inline double stress_share(double reynolds) {
  const double solenoidal = 1.0 / (1.0 + 0.11 * reynolds * reynolds / (reynolds + 1.0));
  return (1.0 + 2.0 * solenoidal) / 3.0;
}

/// Time [s] in which the disturbance builds up, T = (3/2) G rho (4/3) pi a^3: the force first
/// accelerates 3/2 of the ball's fluid.
inline double build_up_time(double radius, double density, double mobility_of_ball) {
  return 2.0 * std::numbers::pi * radius * radius * radius * density * mobility_of_ball;
}

/// How much more solids than the mean there are around a grain because it is there, over its own
/// volume [-]: 1 for a lone grain, nearly 0 in a packing, where a place that one grain leaves
/// another takes. The compressibility of hard spheres after Carnahan and Starling, J. Chem. Phys.
/// 51 (1969) 635, \f$ S = (1-\phi)^4 / [(1+2\phi)^2 + \phi^3 (\phi - 4)] \f$, `solids` phi of the
/// others [-].
inline double excess_of_one(double solids) {
  if (!(solids > 0.0)) return 1.0;
  const double left = (1.0 - solids) * (1.0 - solids);
  const double packing = 1.0 + 2.0 * solids;
  return left * left / (packing * packing + solids * solids * solids * (solids - 4.0));
}

}  // namespace own_disturbance
}  // namespace dust::coupling
