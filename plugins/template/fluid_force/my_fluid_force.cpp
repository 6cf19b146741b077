// SPDX-License-Identifier: Apache-2.0
#include "my_fluid_force.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_fluid_force;
namespace sdk = dust::sdk;

class MyFluidForce final : public sdk::FluidForce {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double coefficient = 0.5;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::coefficient, "coefficient", sdk::dimension::none,
             "Strength of the lift; 0.5 for an isolated sphere.")
        .symbol("C_L")
        .at_least(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_fluid_force",
            .version = "1.0",
            .summary = "Lift of a grain in a weak shear.",
            .equation = "f = C_L \\rho_f V_p w \\times \\omega",
            .source = "Auton, J. Fluid Mech. 183 (1987) 199-218"};
  }

  explicit MyFluidForce(const Parameters& p) : p_(p) {}

  // 3. What it reads; columns it does not ask for are null.
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.vorticity = true}; }

  // 4. The force on a batch: columns in, columns out; no allocation, no lock.
  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) {
      batch.force.set(n, formula::force(p_.coefficient, batch.density[n], batch.diameter[n],
                                        batch.slip[n], batch.vorticity[n]));
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyFluidForce>(); }
