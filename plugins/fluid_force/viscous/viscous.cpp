// SPDX-License-Identifier: Apache-2.0
#include "viscous.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::viscous;
namespace sdk = dust::sdk;

class Viscous final : public sdk::FluidForce {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {.name = "viscous",
            .version = "1.0",
            .summary = "Force of the viscous stress of the flow on the volume of the grain.",
            .equation = R"(f = V_p \nabla \cdot \tau)",
            .source =
                "Zhou, Kuang, Chu, Yu, J. Fluid Mech. 661 (2010) 482-510, "
                "doi:10.1017/S002211201000306X, sets I and II"};
  }
  explicit Viscous(const Parameters&) {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.force.set(g, formula::force(batch.diameter[g], batch.viscous_stress[g]));
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.stresses = true}; }
  [[nodiscard]] sdk::FluidForceParts takes_over() const override {
    return {.viscous_stress = true};
  }
  [[nodiscard]] sdk::FluidForceReaction reaction() const override {
    return sdk::FluidForceReaction::momentum_set;
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Viscous>(); }
