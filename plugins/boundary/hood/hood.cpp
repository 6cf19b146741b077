// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/side_flow.hpp>

#include <algorithm>
#include <array>

namespace {

namespace sdk = dust::sdk;
using sdk::Vec3;

class Hood final : public sdk::BoundaryCondition {
 public:
  struct Parameters : sdk::CourseParameters {
    double flow = 0.0;
    Vec3 min;
    Vec3 max;
    std::string around = "no_slip";
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::flow, "flow", dim::volume_flow,
             "Volume flow of the fluid out of the domain; negative: a blown opening.")
        .symbol("Q");
    s.vector(&Parameters::min, "min", dim::length,
             "Lower corner of the opening; along the side's normal anything.");
    s.vector(&Parameters::max, "max", dim::length, "Upper corner of the opening.");
    s.text(&Parameters::around, "around", "What the rest of the side is.")
        .one_of({"no_slip", "slip"})
        .optional();
    sdk::declare_course(s, "flow");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "hood",
        .version = "1.0",
        .summary = "Wall with a rectangular opening that sucks a given volume flow.",
        .equation =
            R"(Q = -\sum_f A_f c_f\, \varepsilon u_n,\quad \varepsilon u_n \text{ uniform over the opening},\quad u_n = 0 \text{ elsewhere})",
        .source = "Dirichlet condition; docs/theory/fluid.md, section 4"};
  }

  explicit Hood(const Parameters& p) : p_(p), over_time_(p.over_time()) {}

  [[nodiscard]] sdk::SideRules rules() const override {
    return sdk::flow_rules(p_.around == "slip" ? sdk::SideRule::gradient : sdk::SideRule::fixed);
  }
  [[nodiscard]] bool needs_flow() const override { return true; }

  void evaluate(const sdk::SideBatch& batch) const override {
    check_place(batch);
    sdk::set_at_rest(batch);
    const double flow = p_.flow * over_time_(batch.time);
    sdk::set_volume_flow(batch, -flow, [&](std::size_t n) { return covered(batch, n); });
  }

 private:
  /// Share of the face round point n that the opening covers.
  [[nodiscard]] double covered(const sdk::SideBatch& batch, std::size_t n) const {
    const std::array<double, 3> place{batch.position.x[n], batch.position.y[n],
                                      batch.position.z[n]};
    double share = 1.0;
    for (int d = 0; d < 3; ++d) {
      if (d == sdk::axis_of(batch.normal)) continue;
      const double low = place[static_cast<std::size_t>(d)] - 0.5 * batch.spacing[d];
      const double high = low + batch.spacing[d];
      share *=
          std::max(0.0, std::min(high, p_.max[d]) - std::max(low, p_.min[d])) / batch.spacing[d];
    }
    return share;
  }
  void check_place(const sdk::SideBatch& batch) const {
    for (int d = 0; d < 3; ++d) {
      if (d == sdk::axis_of(batch.normal)) continue;
      const char axis = "xyz"[d];
      if (!(p_.max[d] > p_.min[d])) {
        throw sdk::ParameterError(std::string("hood: the opening has no width along ") + axis +
                                  ": 'max' must lie above 'min'");
      }
      const double rounding = 1e-9 * (batch.high[d] - batch.low[d]);
      if (p_.min[d] < batch.low[d] - rounding || p_.max[d] > batch.high[d] + rounding) {
        throw sdk::ParameterError(std::string("hood: the opening reaches beyond the side along ") +
                                  axis);
      }
    }
  }

  Parameters p_;
  sdk::Table over_time_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Hood>(); }
