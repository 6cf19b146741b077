// SPDX-License-Identifier: Apache-2.0
#include "virtual_mass.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::virtual_mass;
namespace sdk = dust::sdk;

class VirtualMass final : public sdk::FluidForce {
 public:
  struct Parameters {
    double coefficient = 0.5;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::coefficient, "coefficient", sdk::dimension::none,
             "Mass of fluid taken along over the mass displaced; 0.5 for a lone sphere.")
        .symbol("C_A")
        .at_least(0)
        .at_most(2)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "virtual_mass",
            .version = "1.0",
            .summary = "Inertia of the fluid that an accelerating grain takes along.",
            .equation = R"(f = C_A \rho_f V_p \left(\frac{d u_f}{dt} - \frac{d u_p}{dt}\right))",
            .source = "Lamb, Hydrodynamics, 6th ed. (1932), section 92"};
  }
  explicit VirtualMass(const Parameters& p) : p_(p) {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double mass = formula::added_mass(p_.coefficient, batch.density[g], batch.diameter[g]);
      batch.added_mass[g] = mass;
      batch.force.set(g, mass * batch.acceleration[g]);
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.acceleration = true}; }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<VirtualMass>(); }
