// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of belts whose top runs away from the head pulley: mostly a speed of the wrong sign, or
/// head and tail in each other's place.
void check_belts(const scenario::Setup& setup, const ParticleModels& models,
                 scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
