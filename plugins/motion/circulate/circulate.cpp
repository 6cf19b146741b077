// SPDX-License-Identifier: Apache-2.0
#include "../course.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>
#include <numbers>

namespace {

namespace sdk = dust::sdk;

class Circulate final : public sdk::Motion {
 public:
  struct Parameters : dust::model::StartParameters {
    sdk::Vec3 head;
    sdk::Vec3 tail;
    double radius = 0.0;
    double speed = 0.0;
    double ahead = 0.0;
    sdk::Vec3 up{0, 0, 1};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::head, "head", sdk::dimension::length,
             "A point of the head pulley's axis, as that of the conveyor.");
    s.vector(&Parameters::tail, "tail", sdk::dimension::length,
             "A point of the tail pulley's axis, beside which the body is drawn, on top.");
    s.number(&Parameters::radius, "radius", sdk::dimension::length,
             "Radius of the path round the pulleys: the conveyor's radius and half its thickness.")
        .symbol("R")
        .above(0);
    s.number(&Parameters::speed, "speed", sdk::dimension::velocity, "Speed of the belt.")
        .symbol("U")
        .above(0);
    s.number(&Parameters::ahead, "ahead", sdk::dimension::length,
             "Way along the belt from where it is drawn to where it is at the start.")
        .symbol("d")
        .optional();
    s.vector(&Parameters::up, "up", sdk::dimension::none,
             "The side that carries; its length does not matter.")
        .optional();
    dust::model::declare_start(s);
    dust::model::declare_ramp(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "circulate",
            .version = "1.0",
            .summary = "A body that goes round two pulleys with the belt: a cleat or a rib.",
            .equation = "s = d + \\int U dt, \\quad x = p + c(s) + R(a, \\varphi(s)) (x_0 - p)",
            .source = "kinematics of an inextensible belt; own derivation"};
  }

  explicit Circulate(const Parameters& p)
      : course_{.speed = p.speed, .start = p.start, .ramp = p.ramp},
        pivot_(p.tail),
        length_(norm(p.head - p.tail)),
        radius_(p.radius),
        ahead_(p.ahead) {
    if (!(length_ > 0.0)) throw sdk::ParameterError("head and tail are the same point");
    along_ = (p.head - p.tail) / length_;
    const sdk::Vec3 across = cross(p.up, along_);
    if (!(norm(across) > 1e-3 * norm(p.up))) throw sdk::ParameterError("up is along the belt");
    axis_ = across / norm(across);
  }
  [[nodiscard]] double largest_speed() const override { return course_.speed; }
  [[nodiscard]] double largest_angular_velocity() const override { return course_.speed / radius_; }
  [[nodiscard]] bool moves_body() const override { return true; }
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    const double half = std::numbers::pi * radius_;
    const double round = 2.0 * (length_ + half);
    double s = std::fmod(ahead_ + course_.way(time), round);
    if (s < 0.0) s += round;
    const double speed = course_.speed_at(time);

    sdk::RigidPose pose;
    pose.pivot = pivot_;
    pose.axis = axis_;
    if (s < length_) {  // carrying run
      pose.shift = s * along_;
      pose.velocity = speed * along_;
    } else if (s < length_ + half) {  // head pulley
      pose.shift = length_ * along_;
      pose.angle = (s - length_) / radius_;
      pose.angular_velocity = speed / radius_;
    } else if (s < 2.0 * length_ + half) {  // return run
      pose.shift = (2.0 * length_ + half - s) * along_;
      pose.angle = std::numbers::pi;
      pose.velocity = -speed * along_;
    } else {  // tail pulley
      pose.angle = std::numbers::pi + (s - 2.0 * length_ - half) / radius_;
      pose.angular_velocity = speed / radius_;
    }
    return pose;
  }

 private:
  dust::model::Course course_;
  sdk::Vec3 pivot_;
  double length_;  ///< [m] between the axes
  double radius_;  ///< [m]
  double ahead_;   ///< [m]
  sdk::Vec3 along_;
  sdk::Vec3 axis_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Circulate>(); }
