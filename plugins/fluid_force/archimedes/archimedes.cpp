// SPDX-License-Identifier: Apache-2.0
#include "archimedes.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::archimedes;
namespace sdk = dust::sdk;

class Archimedes final : public sdk::FluidForce {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {.name = "archimedes",
            .version = "1.0",
            .summary = "Buoyancy by the hydrostatic pressure of the fluid at the grain.",
            .equation = R"(f = -\rho_f V_p g)",
            .source = "Archimedes, On floating bodies, proposition 6"};
  }
  explicit Archimedes(const Parameters&) {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.force.set(g, formula::force(batch.density[g], batch.diameter[g], batch.gravity));
    }
  }
  [[nodiscard]] sdk::FluidForceParts takes_over() const override { return {.buoyancy = true}; }
  [[nodiscard]] sdk::FluidForceReaction reaction() const override {
    return sdk::FluidForceReaction::momentum_set;
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Archimedes>(); }
