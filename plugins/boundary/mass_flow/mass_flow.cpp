// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/side_flow.hpp>

namespace {

namespace sdk = dust::sdk;

class MassFlow final : public sdk::BoundaryCondition {
 public:
  struct Parameters : sdk::CourseParameters {
    double flow = 0.0;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::flow, "flow", dim::mass_flow,
             "Mass flow of the fluid into the domain; negative: out of it.")
        .symbol("\\dot m");
    sdk::declare_course(s, "flow");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "mass_flow",
        .version = "1.0",
        .summary =
            "Inlet or outlet with a given mass flow of the fluid through the open part of the "
            "side.",
        .equation =
            R"(\dot m = \sum_f A_f \rho \varepsilon u_n,\quad \varepsilon u_n \text{ uniform},\quad u_t = 0)",
        .source = "Dirichlet condition; docs/theory/fluid.md, section 4"};
  }

  explicit MassFlow(const Parameters& p) : flow_(p.flow), over_time_(p.over_time()) {}

  [[nodiscard]] sdk::SideRules rules() const override { return sdk::flow_rules(); }
  [[nodiscard]] bool needs_flow() const override { return true; }

  void evaluate(const sdk::SideBatch& batch) const override {
    sdk::set_at_rest(batch);
    const double flow = flow_ * over_time_(batch.time);
    if (batch.area == nullptr) return;
    double mass = 0.0;  // per superficial speed
    double area = 0.0;
    for (std::size_t n = 0; n < batch.count; ++n) {
      mass += batch.density[n] * batch.area[n];
      area += batch.area[n];
    }
    if (!(area > 0.0)) mass = area = 1.0;  // refused below
    sdk::set_volume_flow(batch, flow * area / mass, [](std::size_t) { return 1.0; });
  }

 private:
  double flow_;
  sdk::Table over_time_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MassFlow>(); }
