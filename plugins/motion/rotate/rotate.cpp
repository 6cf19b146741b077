// SPDX-License-Identifier: Apache-2.0
#include "../course.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>
#include <limits>

namespace {

namespace sdk = dust::sdk;

class Rotate final : public sdk::Motion {
 public:
  struct Parameters : dust::model::CourseParameters {
    sdk::Vec3 pivot;
    sdk::Vec3 spin_axis;
    double spin = 0.0;
    double turn = std::numeric_limits<double>::infinity();
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::pivot, "pivot", sdk::dimension::length, "A point of the axis.")
        .symbol("p");
    s.vector(&Parameters::spin_axis, "spin_axis", sdk::dimension::none,
             "Direction of the axis, right-handed; its length does not matter.")
        .symbol("a");
    s.number(&Parameters::spin, "spin", sdk::dimension::angular_velocity,
             "Angular velocity; negative turns the other way.")
        .symbol("omega");
    dust::model::declare_start(s);
    dust::model::declare_stop(s);
    s.number(&Parameters::turn, "turn", sdk::dimension::angle, "Angle after which it stops.")
        .above(0)
        .optional();
    dust::model::declare_ramp(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "rotate",
            .version = "1.0",
            .summary = "A body that turns about a fixed axis, until a time or an angle.",
            .equation = R"(x = p + R(a, \varphi) (x_0 - p),\ \tau = \min(t, t_{stop}) - t_0,\ )"
                        R"(\varphi = \omega \tau^2/(2 r)\ (\tau < r),\ )"
                        R"(\omega (\tau - r/2)\ (\tau \ge r),\ )"
                        R"(|\varphi| \le \varphi_{turn})",
            .source = "kinematics; own derivation"};
  }

  explicit Rotate(const Parameters& p)
      : course_(p.course(std::abs(p.spin), p.turn)),
        sign_(p.spin < 0.0 ? -1.0 : 1.0),
        pivot_(p.pivot) {
    if (!(norm(p.spin_axis) > 0.0)) throw sdk::ParameterError("spin_axis has no direction");
    if (p.spin == 0.0) throw sdk::ParameterError("spin is zero: nothing would move");
    axis_ = p.spin_axis / norm(p.spin_axis);
  }
  [[nodiscard]] double largest_speed() const override { return 0.0; }
  [[nodiscard]] double largest_angular_velocity() const override { return course_.speed; }
  [[nodiscard]] bool moves_body() const override { return true; }
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    sdk::RigidPose pose;
    pose.pivot = pivot_;
    pose.axis = axis_;
    pose.angle = sign_ * course_.way(time);
    pose.angular_velocity = sign_ * course_.speed_at(time);
    return pose;
  }

 private:
  dust::model::Course course_;
  double sign_;
  sdk::Vec3 pivot_;
  sdk::Vec3 axis_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Rotate>(); }
