// SPDX-License-Identifier: Apache-2.0
// Rules of motions: a bounded velocity of the surface.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::contract {
namespace {

using sdk::Vec3;

constexpr std::size_t k_points = 40;
const double k_times[] = {0.0, 0.0037, 0.013, 0.05, 0.5};

/// Velocities at points round a roll about y, at one time.
std::vector<Vec3> velocities(const sdk::Motion& motion, const TestVariant& variant, double time) {
  std::vector<double> in[6];
  for (std::size_t n = 0; n < k_points; ++n) {
    const double angle = 6.283185307179586 * static_cast<double>(n) / k_points;
    const Vec3 normal{std::sin(angle), 0.0, std::cos(angle)};
    const Vec3 at = Vec3{0.08, 0.001 * static_cast<double>(n % 11), 0.16} + 0.04 * normal;
    for (int d = 0; d < 3; ++d) {
      in[d].push_back(at[d] * variant.units.length);
      in[3 + d].push_back(normal[d]);
    }
  }
  std::vector<double> out[3];
  for (auto& column : out) {
    column.assign(k_points + 1, std::numeric_limits<double>::quiet_NaN());
  }
  const std::size_t size = variant.batch == 0 ? k_points : variant.batch;
  for (std::size_t first = 0; first < k_points; first += size) {
    sdk::SurfaceBatch b;
    b.count = std::min(size, k_points - first);
    b.time = time * variant.units.time;
    b.axis = {0.0, 1.0, 0.0};
    b.position.x = in[0].data() + first;
    b.position.y = in[1].data() + first;
    b.position.z = in[2].data() + first;
    b.normal.x = in[3].data() + first;
    b.normal.y = in[4].data() + first;
    b.normal.z = in[5].data() + first;
    b.velocity.x = out[0].data() + first;
    b.velocity.y = out[1].data() + first;
    b.velocity.z = out[2].data() + first;
    call_hot(variant, [&] { motion.surface_velocity(b); });
  }
  std::vector<Vec3> result;
  for (std::size_t n = 0; n < k_points; ++n) result.push_back({out[0][n], out[1][n], out[2][n]});
  for (const auto& column : out) {
    require(std::isnan(column.back()), "it writes beyond the end of the batch");
  }
  return result;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto motion = make_as<sdk::Motion>(make, variant.units);
  Observations observations;
  for (const double time : k_times) {
    const auto v = velocities(*motion, variant, time);
    for (std::size_t n = 0; n < v.size(); ++n) {
      const std::string point = " of point " + std::to_string(n) + " at " + shown(time) + " s";
      for (int d = 0; d < 3; ++d) {
        observations.push_back(
            {std::string("velocity_") + "xyz"[d] + point, v[n][d], sdk::dimension::velocity});
      }
    }
  }
  for (const double time : k_times) {
    const sdk::RigidPose pose = motion->pose(time * variant.units.time);
    const std::string when = " at " + shown(time) + " s";
    for (int d = 0; d < 3; ++d) {
      const std::string axis = std::string("_") + "xyz"[d] + when;
      observations.push_back({"shift" + axis, pose.shift[d], sdk::dimension::length});
      observations.push_back({"pivot" + axis, pose.pivot[d], sdk::dimension::length});
      observations.push_back({"axis" + axis, pose.axis[d], sdk::dimension::none});
      observations.push_back({"shift_velocity" + axis, pose.velocity[d], sdk::dimension::velocity});
    }
    observations.push_back({"angle" + when, pose.angle, sdk::dimension::none});
    observations.push_back(
        {"angular_velocity" + when, pose.angular_velocity, sdk::dimension::angular_velocity});
  }
  observations.push_back({"moves_body", motion->moves_body() ? 1.0 : 0.0, {}, false});
  observations.push_back({"largest_angular_velocity", motion->largest_angular_velocity(),
                          sdk::dimension::angular_velocity});
  observations.push_back({"largest_speed", motion->largest_speed(), sdk::dimension::velocity});
  return observations;
}

/// Where a body is follows from how fast it moves: the mean of the velocity at both ends of a short
/// time is what it went in it.
void check_pose(const Maker& make) {
  const auto motion = make_as<sdk::Motion>(make);
  if (!motion->moves_body()) {
    // Of a surface that runs, the pose is how far its running parts have come.
    const sdk::RigidPose a = motion->pose(0.0), b = motion->pose(0.5);
    const auto surface = velocities(*motion, {}, 0.25);
    const bool runs =
        std::any_of(surface.begin(), surface.end(), [](const Vec3& v) { return norm(v) > 0.0; });
    require(runs || (norm(b.shift - a.shift) == 0.0 && a.angle == b.angle),
            "its pose changes with time and moves_body() says that it does not: it is never asked "
            "for; give moves_body() as well");
    throw Remark("the body itself stands");
  }
  constexpr double k_step = 1e-6;
  int jumps = 0;
  std::string first;
  for (int n = 0; n < 1000; ++n) {
    const double time = 5e-4 * n;
    const sdk::RigidPose a = motion->pose(time);
    const sdk::RigidPose b = motion->pose(time + k_step);
    require(a.angle == 0.0 || std::abs(norm(a.axis) - 1.0) < 1e-9,
            "the axis of its pose at " + shown(time) + " s is " + shown(norm(a.axis)) +
                " long; expected: 1");
    const Vec3 went = (b.shift - a.shift) / k_step;
    const double turned = (b.angle - a.angle) / k_step;
    const Vec3 reported = 0.5 * (a.velocity + b.velocity);
    const double spun = 0.5 * (a.angular_velocity + b.angular_velocity);
    // Differences of numbers of about 1 lose ten digits.
    const double size = motion->largest_speed() + 1e-6;
    const double rate = motion->largest_angular_velocity() + 1e-6;
    // A motion may set off or stop at once, within one of the steps.
    if (norm(went - reported) <= 1e-3 * size && std::abs(turned - spun) <= 1e-3 * rate) continue;
    if (jumps++ > 0) continue;
    first = "; the first at " + shown(time) + " s: " + shown(norm(went)) + " m/s and " +
            shown(turned) + " rad/s by its places, " + shown(norm(reported)) + " m/s and " +
            shown(spun) + " rad/s by velocity and angular_velocity";
  }
  constexpr int k_stops = 4;
  require(jumps <= k_stops, "in " + std::to_string(jumps) +
                                " of 1000 short times the body goes elsewhere than its " +
                                "velocity says" + first);
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("is where its velocity takes it", [&] { check_pose(make); });
  runner.rule("is never faster than the largest speed it tells", [&] {
    const auto motion = make_as<sdk::Motion>(make);
    const double bound = motion->largest_speed() * (1.0 + 1e-12);
    for (int n = 0; n <= 1000; ++n) {
      const double time = 1e-3 * n;
      const sdk::RigidPose pose = motion->pose(time);
      require(
          norm(pose.velocity) <= bound &&
              std::abs(pose.angular_velocity) <= motion->largest_angular_velocity() * (1.0 + 1e-12),
          "the body is faster at " + shown(time) +
              " s than the largest speed told: " + shown(norm(pose.velocity)) + " m/s and " +
              shown(pose.angular_velocity) + " rad/s, told are " + shown(motion->largest_speed()) +
              " m/s and " + shown(motion->largest_angular_velocity()) + " rad/s");
      for (const Vec3& v : velocities(*motion, {}, time)) {
        require(norm(v) <= bound, shown(norm(v)) + " m/s at " + shown(time) + " s, told are " +
                                      shown(motion->largest_speed()) + " m/s");
      }
    }
  });
}

}  // namespace

Kind motion_kind() {
  return {.observe = observe,
          .batches = {1, 7},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
