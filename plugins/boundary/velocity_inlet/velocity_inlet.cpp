// SPDX-License-Identifier: Apache-2.0
#include "velocity_inlet.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/side_flow.hpp>
#include <dust/sdk/table.hpp>

#include <algorithm>
#include <array>

namespace {

namespace formula = dust::model::velocity_inlet;
namespace sdk = dust::sdk;

class VelocityInlet final : public sdk::BoundaryCondition {
 public:
  struct Parameters : sdk::CourseParameters {
    double speed = 0.0;
    std::string measure;
    std::string profile = "uniform";
    std::vector<std::string> across;
    std::vector<double> positions;
    std::vector<double> shares;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::speed, "speed", dim::velocity,
             "Speed into the domain, mean over the side; negative: out of it.")
        .symbol("U");
    s.text(&Parameters::measure, "measure",
           "Whether speed is the volume flow per area (superficial) or that of the fluid between "
           "the grains (interstitial).")
        .one_of({"superficial", "interstitial"});
    s.text(&Parameters::profile, "profile", "How the speed varies over the side.")
        .symbol("f")
        .one_of({"uniform", "parabolic", "table"})
        .optional();
    s.texts(&Parameters::across, "across",
            "Axes over which a parabolic or table profile varies: x, y, z along the side.")
        .one_of({"x", "y", "z"})
        .optional();
    s.numbers(&Parameters::positions, "positions", dim::length,
              "Coordinates along the one axis of a table profile.")
        .optional();
    s.numbers(&Parameters::shares, "shares", dim::none,
              "Speed at each of positions, in parts of speed.")
        .optional();
    sdk::declare_course(s, "speed");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "velocity_inlet",
        .version = "1.0",
        .summary =
            "Inlet with a speed normal to the side, a profile over it and a course in "
            "time.",
        .equation =
            R"(\varepsilon u_n = U f(s)\, g(t) \text{ (superficial)},\quad u_n = U f(s)\, g(t) \text{ (interstitial)},\quad u_t = 0)",
        .source = "Dirichlet condition; docs/theory/fluid.md, section 4"};
  }

  explicit VelocityInlet(const Parameters& p)
      : speed_(p.speed),
        is_superficial_(p.measure == "superficial"),
        is_parabolic_(p.profile == "parabolic"),
        over_place_(p.positions, p.shares, "positions", "shares"),
        over_time_(p.over_time()) {
    for (const std::string& axis : p.across)
      varies_[static_cast<std::size_t>(axis[0] - 'x')] = true;
    const bool is_table = p.profile == "table";
    if (p.profile == "uniform" && !p.across.empty()) {
      throw sdk::ParameterError(
          "a uniform profile varies across nothing: drop across, or make it "
          "parabolic or a table");
    }
    if (p.profile != "uniform" && p.across.empty()) {
      throw sdk::ParameterError("a " + p.profile +
                                " profile needs across, the axes it varies over");
    }
    if (is_table != !over_place_.is_empty()) {
      throw sdk::ParameterError(is_table ? "a table profile needs positions and shares"
                                         : "positions and shares belong to profile: table");
    }
    if (is_table && p.across.size() != 1) {
      throw sdk::ParameterError("a table profile varies over one axis: give one in across");
    }
  }

  [[nodiscard]] sdk::SideRules rules() const override { return sdk::flow_rules(); }
  [[nodiscard]] bool needs_flow() const override { return true; }

  void evaluate(const sdk::SideBatch& batch) const override {
    const int normal = sdk::axis_of(batch.normal);
    if (varies_[static_cast<std::size_t>(normal)]) {
      throw sdk::ParameterError(std::string("velocity_inlet: across names ") + "xyz"[normal] +
                                ", the normal of the side; a profile varies along the side");
    }
    sdk::set_at_rest(batch);
    if (batch.area == nullptr) return;
    const double now = speed_ * over_time_(batch.time);
    sdk::set_superficial(batch, [&](std::size_t n) {
      const double u = now * shape(batch, n);
      return is_superficial_ ? u : u * batch.void_fraction[n];
    });
  }

 private:
  [[nodiscard]] double shape(const sdk::SideBatch& batch, std::size_t n) const {
    const std::array<const double*, 3> place{batch.position.x, batch.position.y, batch.position.z};
    double factor = 1.0;
    for (int d = 0; d < 3; ++d) {
      const auto e = static_cast<std::size_t>(d);
      if (!varies_[e]) continue;
      if (!is_parabolic_) return over_place_(place[e][n]);
      const double width = batch.high[d] - batch.low[d];
      factor *=
          formula::parabola_mean((place[e][n] - batch.low[d]) / width, batch.spacing[d] / width);
    }
    return factor;
  }

  double speed_;
  bool is_superficial_;
  bool is_parabolic_;
  std::array<bool, 3> varies_{false, false, false};
  sdk::Table over_place_;
  sdk::Table over_time_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<VelocityInlet>(); }
