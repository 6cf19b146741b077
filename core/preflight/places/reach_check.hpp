// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Looks at how far laws act beyond touch: refuses a domain so narrow between periodic sides that
/// two grains would act on each other through both at once, warns of a law that reaches farther
/// than the smallest grain is thick (a volume of liquid in the wrong unit).
void check_reach(const scenario::Setup& setup, const ParticleModels& models,
                 scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
