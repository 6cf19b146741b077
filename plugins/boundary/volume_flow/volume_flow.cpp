// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/side_flow.hpp>

namespace {

namespace sdk = dust::sdk;

class VolumeFlow final : public sdk::BoundaryCondition {
 public:
  struct Parameters : sdk::CourseParameters {
    double flow = 0.0;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::flow, "flow", dim::volume_flow,
             "Volume flow into the domain; negative: out of it.")
        .symbol("Q");
    sdk::declare_course(s, "flow");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "volume_flow",
        .version = "1.0",
        .summary = "Inlet or outlet with a given volume flow through the open part of the side.",
        .equation =
            R"(Q = \sum_f A_f \varepsilon u_n,\quad \varepsilon u_n \text{ uniform},\quad u_t = 0)",
        .source = "Dirichlet condition; docs/theory/fluid.md, section 4"};
  }

  explicit VolumeFlow(const Parameters& p) : flow_(p.flow), over_time_(p.over_time()) {}

  [[nodiscard]] sdk::SideRules rules() const override { return sdk::flow_rules(); }
  [[nodiscard]] bool needs_flow() const override { return true; }

  void evaluate(const sdk::SideBatch& batch) const override {
    sdk::set_at_rest(batch);
    const double flow = flow_ * over_time_(batch.time);
    sdk::set_volume_flow(batch, flow, [](std::size_t) { return 1.0; });
  }

 private:
  double flow_;
  sdk::Table over_time_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<VolumeFlow>(); }
