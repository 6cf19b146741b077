// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Refuses suction openings that another body covers wholly, where a run would find no fluid.
/// Bodies that move or are taken away are left to the run.
void check_suction_covers(const scenario::Setup& setup, const ParticleModels& models,
                          scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
