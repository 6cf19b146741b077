// SPDX-License-Identifier: Apache-2.0
#include "run/models.hpp"

namespace dust::run {

Models make_models(const scenario::Setup& setup, const registry::Registry& registry,
                   const scenario::DustSetup& dust) {
  Models m;
  static_cast<preflight::ParticleModels&>(m) = preflight::make_particle_models(setup, registry);
  for (const auto& spec : setup.sensors) {
    m.sensors.push_back(registry.create_as<sdk::Sensor>(spec.model));
  }
  if (setup.fluid) {
    m.sides.emplace(setup, registry);
    if (setup.drag) m.drag = registry.create_as<sdk::DragLaw>(*setup.drag);
    for (const auto& force : setup.fluid_forces) {
      m.fluid_forces.push_back(registry.create_as<sdk::FluidForce>(force));
    }
    if (setup.turbulence) {
      m.turbulence = registry.create_as<sdk::TurbulenceModel>(*setup.turbulence);
    }
    if (setup.voidage) m.voidage = registry.create_as<sdk::VoidageRule>(*setup.voidage);
  }
  if (dust.liberation) {
    m.liberation = registry.create_as<sdk::LiberationLaw>(*dust.liberation);
  }
  return m;
}

}  // namespace dust::run
