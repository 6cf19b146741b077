// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/side_flow.hpp>
#include <dust/sdk/table.hpp>

namespace {

namespace sdk = dust::sdk;

class StaticPressure final : public sdk::BoundaryCondition {
 public:
  struct Parameters {
    double pressure = 0.0;
    std::vector<double> times;
    std::vector<double> factors;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::pressure, "pressure", dim::pressure,
             "Pressure on the side, without its hydrostatic part.")
        .symbol("p_0");
    s.numbers(&Parameters::times, "times", dim::time, "Times of the factors.").optional();
    s.numbers(&Parameters::factors, "factors", dim::none,
              "What pressure is multiplied by at each of times; straight lines between.")
        .symbol("g")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "static_pressure",
            .version = "1.0",
            .summary = "Open side at a given pressure, passed normal to it either way.",
            .equation = R"(p = p_0\, g(t),\quad \partial u_n/\partial n = 0,\quad u_t = 0)",
            .source = "Dirichlet condition for the pressure; docs/theory/fluid.md, section 4"};
  }

  explicit StaticPressure(const Parameters& p)
      : pressure_(p.pressure), over_time_(p.times, p.factors, "times", "factors") {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return {.normal_velocity = sdk::SideRule::gradient,
            .tangential_velocity = sdk::SideRule::fixed,
            .pressure = sdk::SideRule::fixed};
  }
  void evaluate(const sdk::SideBatch& batch) const override {
    sdk::set_at_rest(batch);
    const double now = pressure_ * over_time_(batch.time);
    for (std::size_t n = 0; n < batch.count; ++n) batch.pressure[n] = now;
  }

 private:
  double pressure_;
  sdk::Table over_time_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<StaticPressure>(); }
