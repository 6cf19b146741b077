// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <span>
#include <vector>

namespace dust::preflight {

/// Warns of belts whose top runs away from the head pulley: mostly a speed of the wrong sign, or
/// head and tail in each other's place.
void check_belts(const scenario::Setup& setup, const ParticleModels& models,
                 scenario::Diagnostics& diagnostics);

/// Warns of streams that come in right above a belt and against its way: a belt with head and tail
/// in each other's place, or the feed of another one. `first`: the grains that each emitter
/// proposes first.
void check_feeds_on_belts(const scenario::Setup& setup, const ParticleModels& models,
                          std::span<const std::vector<sdk::InsertionRequest>> first,
                          scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
