// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <span>
#include <vector>

namespace dust::preflight {

/// Looks at where streams let their grains in (those that come at once are placed by the run):
/// refuses an opening outside the domain, in a wall or in a body, warns of one that is partly
/// beyond an open side. `first`: the grains that each emitter proposes first; a sample of them is
/// looked at, bodies as they stand then. What hoods and openings in sides take is told of by
/// check_openings().
void check_release(const scenario::Setup& setup, const scenario::DustSetup& dust,
                   const ParticleModels& models,
                   std::span<const std::vector<sdk::InsertionRequest>> first,
                   scenario::Diagnostics& diagnostics);

/// Whether a body is or may be gone at `time` [s]: of one that goes when the grains rest nobody
/// knows when.
bool may_be_gone(const scenario::BodySpec& body, double time, double fluid_step);

}  // namespace dust::preflight
