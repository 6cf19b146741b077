// SPDX-License-Identifier: Apache-2.0
#include "pressure_gradient.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::pressure_gradient;
namespace sdk = dust::sdk;

class PressureGradient final : public sdk::FluidForce {
 public:
  struct Parameters {
    bool hydrostatic = false;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.boolean(&Parameters::hydrostatic, "hydrostatic",
              "Whether the pressure is the whole one, with its hydrostatic part: then the buoyancy "
              "is in it.")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "pressure_gradient",
            .version = "1.0",
            .summary = "Force of the pressure gradient of the flow on the volume of the grain.",
            .equation = R"(f = -V_p \nabla p)",
            .source =
                "Zhou, Kuang, Chu, Yu, J. Fluid Mech. 661 (2010) 482-510, "
                "doi:10.1017/S002211201000306X, sets I and II"};
  }
  explicit PressureGradient(const Parameters& p) : p_(p) {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      sdk::Vec3 gradient = batch.pressure_gradient[g];
      if (p_.hydrostatic)
        gradient += formula::hydrostatic_gradient(batch.density[g], batch.gravity);
      batch.force.set(g, formula::force(batch.diameter[g], gradient));
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.stresses = true}; }
  [[nodiscard]] sdk::FluidForceParts takes_over() const override {
    return {.pressure_gradient = true, .buoyancy = p_.hydrostatic};
  }
  [[nodiscard]] sdk::FluidForceReaction reaction() const override {
    return sdk::FluidForceReaction::momentum_set;
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<PressureGradient>(); }
