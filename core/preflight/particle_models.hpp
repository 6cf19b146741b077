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

/// The shapes of bodies get to know the largest grain; again where sizes come besides.
void inform_shapes(ParticleModels& models);

ParticleModels make_particle_models(const scenario::Setup& setup,
                                    const registry::Registry& registry);

}  // namespace dust::preflight
