// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Refuses bodies that end at a periodic side, where grains that pass through it would miss them on
/// the other one, and bodies that are not the same at both: a slope across them would lift grains
/// or let them drop as they pass. Without grains the air is what finds bodies cut off. Bodies that
/// go to other places are looked at at instants through the run.
void check_bodies_at_periodic_sides(const scenario::Setup& setup, const ParticleModels& models,
                                    scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
