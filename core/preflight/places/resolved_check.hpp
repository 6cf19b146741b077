// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of bodies thinner than a cell where spheres are resolved: their markers act on the fluid
/// behind such a body.
void check_resolved_at_thin_bodies(const scenario::Setup& setup, const ParticleModels& models,
                                   scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
