// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model {

/// Largest tangential damper [m*/dt]. Those of a grain's contacts add up: in the densest packing,
/// twelve equal neighbours, they brake a spin that all grains have at the rate 20 gamma_t / m*, and
/// a velocity that is predicted over half a step (Adams-Bashforth) is stable below 1/dt: 0.8 of
/// that is left here. At 0.9 such a bed of restitution 0.5 spins up by itself, and of 0.1 flies
/// apart.
inline constexpr double k_max_tangential_damping = 0.04;

}  // namespace dust::model
