// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Above this overlap at rest over R* a pair that sticks is warned of: contact laws hold for small
/// overlaps.
inline constexpr double k_deep_at_rest = 0.1;

/// Looks at cohesive laws with the smallest pair of each: warns where grains pull themselves deeper
/// into each other than k_deep_at_rest, with the stiffness that holds them, and refuses a `volume`
/// of bridges that is larger than such pairs have room for.
void check_cohesion(const scenario::Setup& setup, const ParticleModels& models,
                    const registry::Registry& registry, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
