// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>

namespace {

namespace sdk = dust::sdk;

class ZeroGradient final : public sdk::BoundaryCondition {
 public:
  struct Parameters {
    double pressure = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::pressure, "pressure", sdk::dimension::pressure,
             "Static pressure on the side, without its hydrostatic part.")
        .symbol("p_0")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "zero_gradient",
            .version = "1.0",
            .summary = "Outlet: fully developed flow at a given static pressure.",
            .equation = R"(\partial u/\partial n = 0, \quad p = p_0)",
            .source = "standard outflow condition; docs/theory/fluid.md, section 4"};
  }

  explicit ZeroGradient(const Parameters& p) : p_(p) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::gradient,
            .tangential_velocity = sdk::SideRule::gradient,
            .pressure = sdk::SideRule::fixed};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) batch.pressure[n] = p_.pressure;
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<ZeroGradient>(); }
