// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_class.hpp"

namespace dust::airborne {

/// Share [-] of the dust in the way of a sphere that hits it, by inertia alone:
///   eta = (St / (St + 1/4))^2, 0 up to St = 1/24,
/// St = tau w / D, tau = rho_p d^2 C_c / (18 mu) the dust's response time, w the speed of the gas
/// relative to the sphere of diameter D. Potential flow, points of Stokes' drag: Langmuir, J.
/// Meteor. 5 (1948) 175, who has K = 2 St, (K / (K + 1/2))^2 and the limit K = 1/12. Within 0.02 of
/// the trajectories from St = 0.25 on; docs/theory/dust.md, eq. (17).
[[nodiscard]] double impaction_efficiency(double stokes);

/// Volume of gas [m3/s] that a sphere of this diameter [m] and speed [m/s] relative to the gas
/// clears of the dust: speed pi/4 D^2 eta.
[[nodiscard]] double cleared_flow(const DustClass& dust, double diameter, double speed);

}  // namespace dust::airborne
