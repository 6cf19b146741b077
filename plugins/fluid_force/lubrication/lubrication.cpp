// SPDX-License-Identifier: Apache-2.0
#include "lubrication.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::lubrication;
namespace sdk = dust::sdk;

class Lubrication final : public sdk::FluidForce {
 public:
  struct Parameters {
    double smallest_gap = 1e-3;
    double reach = 1.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::smallest_gap, "smallest_gap", sdk::dimension::none,
             "Gap over the grain's radius at which the force stops growing: its roughness.")
        .symbol("delta_0")
        .above(0)
        .at_most(0.1)
        .optional();
    s.number(&Parameters::reach, "reach", sdk::dimension::none,
             "Gap over the grain's radius beyond which it does not act.")
        .above(0.1)
        .at_most(10)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "lubrication",
        .version = "1.0",
        .summary = "Fluid squeezed from between a grain and a wall resists their approach.",
        .equation =
            R"(f = -6 \pi \mu R\, (\lambda(\delta) - \lambda(\delta_r))\, n\, (u_p - u_w) \cdot n,\ \lambda - 1 = \frac{7 \delta + 2}{6 \delta^2 + 2 \delta},\ \delta = h / R)",
        .source =
            "Brenner, Chem. Eng. Sci. 16 (1961) 242-251, doi:10.1016/0009-2509(61)80035-3; Bevan, "
            "Prieve, J. Chem. Phys. 113 (2000) 1228-1236, doi:10.1063/1.481900"};
  }
  explicit Lubrication(const Parameters& p) : p_(p) {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.resistance[g] = formula::resistance(batch.viscosity[g], 0.5 * batch.diameter[g],
                                                batch.gap[g], p_.smallest_gap, p_.reach);
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override {
    return {.wall_reach = 0.5 * p_.reach};
  }
  [[nodiscard]] sdk::FluidForceReaction reaction() const override {
    return sdk::FluidForceReaction::wall;
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Lubrication>(); }
