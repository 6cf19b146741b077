// SPDX-License-Identifier: Apache-2.0
#include "preflight/placing.hpp"

#include "preflight/emissions.hpp"
#include "preflight/particle_models.hpp"

#include <algorithm>
#include <cstddef>

namespace dust::preflight {

void try_placing(const scenario::Setup& setup, const registry::Registry& registry,
                 const Derived& derived, double begin) {
  // Placed within a second, however tight the region is.
  constexpr double k_quickly_placed = 4e4;
  const auto is_tried = [&](const EmissionNumbers& e) {
    return e.at_once > 0.0 && e.at_once <= k_quickly_placed && e.begin >= begin;
  };
  // Models of large meshes take time to make: not for streams alone.
  if (std::none_of(derived.emissions.begin(), derived.emissions.end(), is_tried)) return;
  const ParticleModels models = make_particle_models(setup, registry);
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    if (is_tried(derived.emissions[n])) proposals(setup, setup.emitters[n], *models.emitters[n]);
  }
}

}  // namespace dust::preflight
