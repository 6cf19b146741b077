// SPDX-License-Identifier: Apache-2.0
#include "belt.hpp"
#include "../course.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>

namespace {

namespace formula = dust::model::belt;
namespace sdk = dust::sdk;

class Belt final : public sdk::Motion {
 public:
  struct Parameters : dust::model::StartParameters {
    double speed = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::speed, "speed", sdk::dimension::velocity,
             "Speed of the belt; positive carries towards +x on top for a pulley axis along +y.")
        .symbol("U");
    dust::model::declare_start(s);
    dust::model::declare_ramp(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "belt",
            .version = "1.2",
            .summary = "A surface that runs along itself round the body's lateral axis.",
            .equation = "v = U\\, \\min(1, (t - t_0)/r)\\, a \\times n / |a \\times n|",
            .source = "kinematics of an inextensible belt; own derivation"};
  }

  explicit Belt(const Parameters& p)
      : course_{.speed = p.speed, .start = p.start, .ramp = p.ramp} {}
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    const double speed = course_.speed_at(b.time);
    for (std::size_t q = 0; q < b.count; ++q) {
      const auto v = formula::velocity(speed, b.axis.x, b.axis.y, b.axis.z, b.normal.x[q],
                                       b.normal.y[q], b.normal.z[q]);
      b.velocity.set(q, {v.x, v.y, v.z});
    }
  }
  [[nodiscard]] double largest_speed() const override { return std::abs(course_.speed); }
  /// Of the surface, not of the body: how far it has run along itself, and how fast it runs, as x.
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    sdk::RigidPose run;
    run.shift.x = course_.way(time);
    run.velocity.x = course_.speed_at(time);
    return run;
  }

 private:
  dust::model::Course course_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Belt>(); }
