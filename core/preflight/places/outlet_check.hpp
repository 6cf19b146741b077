// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of holes of discs and narrow ends of funnels that are narrower than a grain, and of those
/// that look down and are so narrow that grains arch over them, where there are enough for that.
void check_outlets(const scenario::Setup& setup, const ParticleModels& models,
                   scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
