// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Refuses bodies that end at a periodic side: grains that pass through it would miss them on the
/// other one. Bodies are looked at where they are as the run begins.
void check_bodies_at_periodic_sides(const scenario::Setup& setup, const ParticleModels& models,
                                    scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
