// SPDX-License-Identifier: Apache-2.0
#include "viscous.hpp"

#include "dust/sdk/plugin.hpp"

namespace dust::model::viscous {
namespace {

class Viscous final : public sdk::FluidForce {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    sdk::ModelInfo info;
    info.name = "viscous";
    info.version = "1.0";
    info.summary = "Force of the viscous stress of the flow on the volume of the grain.";
    info.equation = R"(f = V_p \nabla \cdot \tau)";
    info.source =
        "Zhou, Kuang, Chu, Yu, J. Fluid Mech. 661 (2010) 482-510, "
        "doi:10.1017/S002211201000306X, sets I and II";
    return info;
  }
  explicit Viscous(const Parameters&) {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.force.set(g, force(batch.diameter[g], batch.viscous_stress[g]));
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
}  // namespace dust::model::viscous

DUST_PLUGIN(registrar) { registrar.add<dust::model::viscous::Viscous>(); }
