// SPDX-License-Identifier: Apache-2.0
#include "virtual_mass.hpp"

#include "../acceleration_number.hpp"

#include <dust/sdk/plugin.hpp>

#include <string>

namespace {

namespace formula = dust::model::virtual_mass;
namespace sdk = dust::sdk;

class VirtualMass final : public sdk::FluidForce {
 public:
  struct Parameters {
    double coefficient = 0.5;
    std::string acceleration = "any";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::coefficient, "coefficient", sdk::dimension::none,
             "Mass of fluid taken along over the mass displaced; 0.5 for a lone sphere.")
        .symbol("C_A")
        .at_least(0)
        .at_most(2)
        .optional();
    s.text(&Parameters::acceleration, "acceleration",
           "The coefficient at any acceleration, or growing with the acceleration number as Odar "
           "and Hamilton measured: `coefficient` is that of a motion that has just begun.")
        .one_of({"any", "odar_hamilton"})
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "virtual_mass",
            .version = "1.0",
            .summary = "Inertia of the fluid that an accelerating grain takes along.",
            .equation = R"(f = C_A \rho_f V_p \left(\frac{d u_f}{dt} - \frac{d u_p}{dt}\right))",
            .source =
                "Lamb, Hydrodynamics, 6th ed. (1932), section 92; over the acceleration number "
                "Odar, Hamilton, J. Fluid Mech. 18 (1964) 302-314, "
                "doi:10.1017/S0022112064000210"};
  }
  explicit VirtualMass(const Parameters& p)
      : coefficient_(p.coefficient), is_measured_(p.acceleration == "odar_hamilton") {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double mass =
          formula::added_mass(coefficient_of(batch, g), batch.density[g], batch.diameter[g]);
      batch.added_mass[g] = mass;
      batch.force.set(g, mass * batch.acceleration[g]);
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.acceleration = true}; }
  [[nodiscard]] int history_size() const override {
    return is_measured_ ? dust::model::LastSlip::k_numbers : 0;
  }

 private:
  [[nodiscard]] double coefficient_of(const sdk::FluidForceBatch& batch, std::size_t g) const {
    if (!is_measured_) return coefficient_;
    dust::model::LastSlip last(batch.history + g * dust::model::LastSlip::k_numbers);
    const double number = last.note(batch.diameter[g], batch.slip[g], batch.interval);
    return coefficient_ * dust::model::virtual_mass_factor(number);
  }

  double coefficient_;
  bool is_measured_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<VirtualMass>(); }
