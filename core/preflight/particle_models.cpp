// SPDX-License-Identifier: Apache-2.0
#include "preflight/particle_models.hpp"

#include <algorithm>

namespace dust::preflight {
namespace {

bodies::BodySet make_bodies(const scenario::Setup& setup, const registry::Registry& registry) {
  bodies::BodySet made;
  for (const auto& spec : setup.bodies) {
    std::vector<std::unique_ptr<sdk::Motion>> motions;
    for (const auto& motion : spec.motions) {
      motions.push_back(registry.create_as<sdk::Motion>(motion));
    }
    made.push_back(bodies::make_body(setup, spec, std::move(motions)));
  }
  return made;
}

template <class Law>
std::unique_ptr<Law> make_law(const scenario::ModelChoice& choice, const sdk::MaterialProperties& i,
                              const sdk::MaterialProperties& j,
                              const registry::Registry& registry) {
  auto law = registry.create_as<Law>(choice);
  registry::ask_at_place(choice, [&] {
    law->prepare(i, j);
    static_cast<void>(law->history_size());
  });
  return law;
}

particles::PairLaws make_laws(const scenario::Setup& setup, const scenario::InteractionSpec& spec,
                              const registry::Registry& registry) {
  particles::PairLaws laws;
  laws.material_i = spec.material_i;
  laws.material_j = spec.material_j;
  const auto& i = setup.materials.at(static_cast<std::size_t>(spec.material_i)).properties;
  const auto& j = setup.materials.at(static_cast<std::size_t>(spec.material_j)).properties;
  laws.contact = make_law<sdk::ContactLaw>(spec.contact, i, j, registry);
  if (spec.rolling) laws.rolling = make_law<sdk::RollingLaw>(*spec.rolling, i, j, registry);
  if (spec.cohesion) laws.cohesion = make_law<sdk::CohesionLaw>(*spec.cohesion, i, j, registry);
  return laws;
}

}  // namespace

ParticleModels make_particle_models(const scenario::Setup& setup,
                                    const registry::Registry& registry) {
  ParticleModels m;
  m.bodies = make_bodies(setup, registry);
  for (const auto& spec : setup.interactions) m.laws.push_back(make_laws(setup, spec, registry));
  std::vector<double> diameters;
  for (const auto& spec : setup.emitters) {
    m.emitters.push_back(registry.create_as<sdk::Emitter>(spec.model));
    const auto own = m.emitters.back()->diameters();
    diameters.insert(diameters.end(), own.begin(), own.end());
    m.release_speed = std::max(m.release_speed, m.emitters.back()->largest_speed());
  }
  set_class_diameters(m, std::move(diameters));
  return m;
}

void set_class_diameters(ParticleModels& models, std::vector<double> diameters) {
  std::sort(diameters.begin(), diameters.end());
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  models.class_diameters = std::move(diameters);
  if (models.class_diameters.empty()) return;
  const double largest = 0.5 * models.class_diameters.back();
  for (bodies::Body& body : models.bodies) body.shape->expect_spheres(largest);
}

}  // namespace dust::preflight
