// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model {

/// Largest tangential damper [m*/dt]. Its spin damps a grain at the rate 2.5 sum(gamma_t) / m, and
/// a velocity that is predicted over half a step (Adams-Bashforth) is stable below 1/dt: enough for
/// ten equal neighbours. Beyond it a bed of low restitution would keep on shivering.
inline constexpr double k_max_tangential_damping = 0.05;

}  // namespace dust::model
