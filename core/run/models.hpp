// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/drag_law.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "dust/sdk/liberation_law.hpp"
#include "dust/sdk/sensor.hpp"
#include "dust/sdk/turbulence_model.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "preflight/air/side_faces.hpp"
#include "preflight/particle_models.hpp"
#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace dust::run {

/// Every model of a scenario, made once.
struct Models : preflight::ParticleModels {
  std::vector<std::unique_ptr<sdk::Sensor>> sensors;
  std::optional<preflight::SideModelSet> sides;  ///< of the air; none without a fluid
  std::unique_ptr<sdk::DragLaw> drag;
  std::vector<std::unique_ptr<sdk::FluidForce>> fluid_forces;
  std::unique_ptr<sdk::VoidageRule> voidage;
  std::unique_ptr<sdk::TurbulenceModel> turbulence;  ///< null: laminar
  std::unique_ptr<sdk::LiberationLaw> liberation;    ///< null: dust stays on the grains
};

Models make_models(const scenario::Setup& setup, const registry::Registry& registry,
                   const scenario::DustSetup& dust = {});

}  // namespace dust::run
