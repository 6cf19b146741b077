// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/emitter.hpp"
#include "particles/dem.hpp"
#include "registry/registry.hpp"
#include "setup/setup.hpp"

#include <memory>
#include <vector>

namespace dust::preflight {

/// The models of a scenario that the steps of its grains follow from, made once: by a run, and by
/// whoever asks for its steps before.
struct ParticleModels {
  bodies::BodySet bodies;
  std::vector<particles::PairLaws> laws;
  std::vector<std::unique_ptr<sdk::Emitter>> emitters;
  std::vector<double> class_diameters;  ///< [m] all sizes the emitters may give, ascending
  double release_speed = 0.0;           ///< [m/s] of the fastest grain as it is let in
};

/// The sizes [m] that a run has, in any order; the shapes of its bodies get to know the largest.
void set_class_diameters(ParticleModels& models, std::vector<double> diameters);

ParticleModels make_particle_models(const scenario::Setup& setup,
                                    const registry::Registry& registry);

}  // namespace dust::preflight
