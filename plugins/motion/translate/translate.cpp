// SPDX-License-Identifier: Apache-2.0
#include "../course.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>
#include <limits>

namespace {

namespace sdk = dust::sdk;

class Translate final : public sdk::Motion {
 public:
  struct Parameters : dust::model::CourseParameters {
    sdk::Vec3 velocity;
    double travel = std::numeric_limits<double>::infinity();
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", sdk::dimension::velocity,
             "Velocity of the body; it turns with the body's frame.")
        .symbol("u");
    dust::model::declare_start(s);
    dust::model::declare_stop(s);
    s.number(&Parameters::travel, "travel", sdk::dimension::length,
             "Distance after which it stops.")
        .above(0)
        .optional();
    dust::model::declare_ramp(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "translate",
            .version = "1.0",
            .summary = "A body that moves in a straight line, until a time or a distance.",
            .equation = R"(x = x_0 + s\, u/|u|,\ \tau = \min(t, t_{stop}) - t_0,\ )"
                        R"(s = |u| \tau^2/(2 r)\ (\tau < r),\ |u| (\tau - r/2)\ (\tau \ge r),\ )"
                        R"(s \le s_{travel})",
            .source = "kinematics; own derivation"};
  }

  explicit Translate(const Parameters& p) : course_(p.course(norm(p.velocity), p.travel)) {
    if (!(course_.speed > 0.0)) throw sdk::ParameterError("velocity is zero: nothing would move");
    direction_ = p.velocity / course_.speed;
  }
  [[nodiscard]] double largest_speed() const override { return course_.speed; }
  [[nodiscard]] bool moves_body() const override { return true; }
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    sdk::RigidPose pose;
    pose.shift = course_.way(time) * direction_;
    pose.velocity = course_.speed_at(time) * direction_;
    return pose;
  }

 private:
  dust::model::Course course_;
  sdk::Vec3 direction_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Translate>(); }
