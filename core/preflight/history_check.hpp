// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Refuses pairs of materials whose laws keep more numbers per contact than there is room for, with
/// what dust and the energy account keep beside them.
void check_histories(const scenario::Setup& setup, const scenario::DustSetup& dust,
                     const ParticleModels& models, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
