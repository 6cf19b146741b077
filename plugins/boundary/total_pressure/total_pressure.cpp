// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>

namespace {

namespace sdk = dust::sdk;

class TotalPressure final : public sdk::BoundaryCondition {
 public:
  struct Parameters {
    double pressure = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::pressure, "pressure", sdk::dimension::pressure,
             "Pressure of the air at rest far away, without its hydrostatic part.")
        .symbol("p_0")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "total_pressure",
        .version = "1.1",
        .summary =
            "Open side to air at rest at a given pressure: entering air pays its kinetic energy "
            "from it and brings no velocity along the side.",
        .equation =
            R"(p + \tfrac{1}{2}\rho u_n^2 = p_0, \; u_t = 0 \text{ (inflow)}, \quad p = p_0, \; \partial u_t/\partial n = 0 \text{ (outflow)})",
        .source =
            "Bernoulli along the streamlines of entering air; docs/theory/fluid.md, section 4"};
  }

  explicit TotalPressure(const Parameters& p) : p_(p) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::gradient,
            .tangential_velocity = sdk::SideRule::gradient,
            .pressure = sdk::SideRule::pressure};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) batch.pressure[n] = p_.pressure;
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<TotalPressure>(); }
