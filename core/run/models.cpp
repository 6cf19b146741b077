// SPDX-License-Identifier: Apache-2.0
#include "run/models.hpp"

#include <algorithm>

namespace dust::run {

Models make_models(const scenario::Setup& setup, const registry::Registry& registry) {
  Models m;
  for (const auto& spec : setup.bodies) {
    std::vector<std::unique_ptr<sdk::Motion>> motions;
    for (const auto& motion : spec.motions) {
      motions.push_back(registry.create_as<sdk::Motion>(motion));
    }
    m.bodies.push_back(bodies::make_body(setup, spec, std::move(motions)));
  }
  for (const auto& spec : setup.interactions) {
    particles::PairLaws laws;
    laws.material_i = spec.material_i;
    laws.material_j = spec.material_j;
    const auto& i = setup.materials.at(static_cast<std::size_t>(spec.material_i)).properties;
    const auto& j = setup.materials.at(static_cast<std::size_t>(spec.material_j)).properties;
    laws.contact = registry.create_as<sdk::ContactLaw>(spec.contact);
    laws.contact->prepare(i, j);
    if (spec.rolling) {
      laws.rolling = registry.create_as<sdk::RollingLaw>(*spec.rolling);
      laws.rolling->prepare(i, j);
    }
    if (spec.cohesion) {
      laws.cohesion = registry.create_as<sdk::CohesionLaw>(*spec.cohesion);
      laws.cohesion->prepare(i, j);
    }
    m.laws.push_back(std::move(laws));
  }
  for (const auto& spec : setup.emitters) {
    m.emitters.push_back(registry.create_as<sdk::Emitter>(spec.model));
    const auto diameters = m.emitters.back()->diameters();
    m.class_diameters.insert(m.class_diameters.end(), diameters.begin(), diameters.end());
  }
  std::sort(m.class_diameters.begin(), m.class_diameters.end());
  m.class_diameters.erase(std::unique(m.class_diameters.begin(), m.class_diameters.end()),
                          m.class_diameters.end());
  for (const auto& spec : setup.sensors) {
    m.sensors.push_back(registry.create_as<sdk::Sensor>(spec.model));
  }
  if (setup.fluid) {
    for (std::size_t side = 0; side < 6; ++side) {
      if (const auto& air = setup.domain.sides[side].air) {
        m.boundaries[side] = registry.create_as<sdk::BoundaryCondition>(*air);
      }
    }
    if (setup.drag) m.drag = registry.create_as<sdk::DragLaw>(*setup.drag);
    for (const auto& force : setup.fluid_forces) {
      m.fluid_forces.push_back(registry.create_as<sdk::FluidForce>(force));
    }
    if (setup.turbulence) {
      m.turbulence = registry.create_as<sdk::TurbulenceModel>(*setup.turbulence);
    }
    if (setup.voidage) m.voidage = registry.create_as<sdk::VoidageRule>(*setup.voidage);
  }
  return m;
}

}  // namespace dust::run
