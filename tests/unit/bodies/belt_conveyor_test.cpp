// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/local_axes.hpp"
#include "bodies/shape.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "unit/bodies/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace {

using dust::bodies::Shape;
using dust::bodies::SurfacePoint;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::make_shape;

constexpr double k_pi = std::numbers::pi;

// A belt of 1 m on rolls at 35 degrees, from (-8, 0) to the head at the origin, along +x.
constexpr double k_radius = 0.3;
constexpr double k_thickness = 0.02;
constexpr double k_width = 1.0;
constexpr double k_angle = 35.0 * k_pi / 180.0;
constexpr double k_centre = 0.38;
constexpr double k_bend = 0.12;
constexpr double k_transition = 1.6;
constexpr double k_rise = 0.05;

std::map<std::string, Value> troughed() {
  return {{"head", Vec3{}},           {"tail", Vec3{-8, 0, 0}}, {"radius", k_radius},
          {"thickness", k_thickness}, {"width", k_width},       {"trough_angle", k_angle},
          {"centre_roll", k_centre},  {"bend_radius", k_bend},  {"transition", k_transition},
          {"pulley_rise", k_rise}};
}

/// The middle of the carrying run, told a second time: a walk along the section, bend by bend, of
/// the length of half the belt. At `x` before the head pulley.
Vec3 walk(double x, double across) {
  const double t = std::clamp(-x / k_transition, 0.0, 1.0);
  const double blend = 3 * t * t - 2 * t * t * t;
  const double slope = std::tan(k_angle / 2) * blend;  // of half the trough angle
  const double angle = 2 * std::atan(slope);
  const double tangent = k_bend * std::tan(k_angle / 2);
  const double arc = angle > 0 ? tangent / slope * angle : 2 * tangent;  // length of the bend
  const double flat = k_centre / 2 - tangent;
  double y = 0, z = k_radius + k_thickness / 2 - k_rise * blend;
  const double way = std::abs(across);
  constexpr int k_steps = 4000;
  for (int n = 0; n < k_steps; ++n) {
    const double w = (n + 0.5) * way / k_steps;
    const double turned = angle * std::clamp((w - flat) / arc, 0.0, 1.0);
    y += std::cos(turned) * way / k_steps;
    z += std::sin(turned) * way / k_steps;
  }
  return {x, across < 0 ? -y : y, z};
}

}  // namespace

TEST_CASE("a troughed belt shall lie where its rolls put it, in the transition too") {
  const auto belt = make_shape("belt_conveyor", troughed());
  for (const double x : {-4.0, -1.6, -1.3, -0.8, -0.3, -0.05}) {
    for (const double across : {0.0, 0.1, -0.16, 0.2, 0.24, -0.35, 0.45, 0.4999}) {
      CAPTURE(x);
      CAPTURE(across);
      // Half a thickness from its middle surface on either face; the walk ends within 1e-7.
      const Vec3 middle = walk(x, across);
      CHECK(std::abs(belt->nearest(middle).distance + k_thickness / 2) < 1e-6);
    }
  }
  // The belt keeps its width: beyond it there is the rounded edge, then air.
  const Vec3 edge = walk(-0.8, 0.5);
  const Vec3 before = walk(-0.8, 0.49);
  const Vec3 out = (edge - before) / norm(edge - before);
  CHECK(belt->nearest(edge + 0.5 * k_thickness * out).distance ==
        approx(0.0).epsilon(1e-6).scale(1.0));
  // A chord of 10 mm stands for the direction there.
  CHECK(belt->nearest(edge + 1.5 * k_thickness * out).distance ==
        approx(k_thickness).epsilon(2e-4));
}

TEST_CASE("the distance to a troughed belt shall be that of brute force, its normal the gradient") {
  const auto belt = make_shape("belt_conveyor", troughed());
  std::vector<Vec3> middle;
  constexpr double k_spacing = 0.02;
  for (double across = -0.5; across < 0.501; across += k_spacing) {
    for (double x = -3.0; x <= 0.0; x += k_spacing) middle.push_back(walk(x, across));
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p{-2.5 + 2.4 * unit(random), -0.7 + 1.4 * unit(random), 0.2 + 0.7 * unit(random)};
    CAPTURE(p.x);
    CAPTURE(p.y);
    CAPTURE(p.z);
    const SurfacePoint s = belt->nearest(p);
    double brute = std::numeric_limits<double>::infinity();
    for (const Vec3& q : middle) brute = std::min(brute, norm(p - q));
    // Nearer than any of the points, by less than their spacing; other faces may be nearer still.
    CHECK(s.distance + k_thickness / 2 <= brute + 1e-6);
    if (p.z > 0.35) CHECK(brute <= s.distance + k_thickness / 2 + k_spacing);
    CHECK(norm(s.normal) == approx(1.0).epsilon(1e-12));
    const Vec3 foot = p - s.distance * s.normal;
    CHECK(std::abs(belt->nearest(foot).distance) < 1e-9);
    constexpr double k_step = 1e-6;
    CHECK(belt->nearest(p + k_step * s.normal).distance - s.distance ==
          approx(k_step).epsilon(1e-4));
  }
}

TEST_CASE("a belt shall run along itself at its speed on every face, in any direction in plan") {
  const Vec3 along{std::cos(0.7), std::sin(0.7), 0.0};
  const Vec3 aside{-std::sin(0.7), std::cos(0.7), 0.0};
  const Vec3 head{1.0, 2.0, 3.0};
  auto values = troughed();
  values["head"] = head;
  values["tail"] = head - 8.0 * along;
  const auto belt = make_shape("belt_conveyor", values);
  const auto direction = [&](Vec3 local) {
    const Vec3 p = head + local.x * along + local.y * aside + Vec3{0, 0, local.z};
    const SurfacePoint s = belt->nearest(p);
    const Vec3 axis = belt->local_axes()->lateral_axis_at(p - s.distance * s.normal, s.normal);
    const Vec3 c = cross(axis, s.normal);  // where motion: belt runs to
    CHECK(norm(c) == approx(1.0).epsilon(1e-9));
    CHECK(std::abs(dot(c, s.normal)) < 1e-9);
    return c;
  };
  const Vec3 wing = walk(-4.0, 0.4);
  for (const Vec3& over : {Vec3{-4, 0, 0.4}, wing + Vec3{0, -0.02, 0.04}, wing - Vec3{0, 0, 0.03},
                           wing + Vec3{0, 0.3, 0.2}}) {
    CHECK(norm(direction(over) - along) < 1e-9);  // carrying run: above, under, at its edge
  }
  CHECK(norm(direction({0.4, 0.1, 0.0}) - Vec3{0, 0, -1}) < 1e-9);  // down the head pulley
  CHECK(norm(direction({-4, 0.2, -0.4}) + along) < 1e-9);           // return run
  CHECK(norm(direction({-8.4, 0.1, 0.0}) - Vec3{0, 0, 1}) < 1e-9);  // up the tail pulley
  // In the transition a line of the belt goes down and outwards to the pulley.
  const Vec3 falling = direction(walk(-0.8, 0.45) + Vec3{0, -0.01, 0.02});
  const Vec3 line = walk(-0.799, 0.45) - walk(-0.801, 0.45);
  CHECK(dot(falling, aside) == approx(line.y / norm(line)).epsilon(0.02));
  CHECK(falling.z == approx(line.z / norm(line)).epsilon(0.02));
}

TEST_CASE("a belt's surface shall be smooth from its trough over the pulley to its return run") {
  const auto belt = make_shape("belt_conveyor", troughed());
  for (const double y : {0.0, 0.2, 0.4}) {
    CAPTURE(y);
    // A ball of 50 mm that is moved along just out of touch of the carrying run.
    SurfacePoint last = belt->nearest({-2.5, y, 0.6});
    double z = 0.6;
    for (double x = -2.5; x < 0.25; x += 1e-3) {
      for (int n = 0; n < 40; ++n) z -= belt->nearest({x, y, z}).distance - 0.05;
      const SurfacePoint s = belt->nearest({x, y, z});
      CHECK(s.distance == approx(0.05).epsilon(1e-6));
      // It bends by at most one millimetre's worth of its least radius.
      if (x > -2.5) CHECK(norm(s.normal - last.normal) < 1e-3 / 0.2);
      last = s;
    }
  }
}

TEST_CASE("a load by ISO 5048 and CEMA shall find its section on a troughed belt") {
  // Usable width b = 0.9 B - 0.05 m; above the line between its ends a parabola of the surcharge
  // angle, below it the trough, here of sharp rolls: both in closed form.
  auto values = troughed();
  values.erase("bend_radius");
  for (const double angle : {20.0, 35.0, 45.0}) {
    CAPTURE(angle);
    const double trough = angle * k_pi / 180.0;
    values["trough_angle"] = trough;
    const auto belt = make_shape("belt_conveyor", values);
    const double surcharge = 20.0 * k_pi / 180.0;
    const double usable = 0.9 * k_width - 0.05;
    const double wing = 0.5 * (usable - k_centre);
    const double width = k_centre + 2 * wing * std::cos(trough);
    const double upper = width * width * std::tan(surcharge) / 6;
    const double lower = (k_centre + wing * std::cos(trough)) * wing * std::sin(trough);
    const auto top = [&](double y) {
      double z = 0.6;
      for (int n = 0; n < 60; ++n) z -= belt->nearest({-4.0, y, z}).distance;
      return z;
    };
    constexpr int k_strips = 200;
    const double edge = top(0.5 * width);
    double area = 0.0;
    for (int n = 0; n < k_strips; ++n) {
      const double y = width * ((n + 0.5) / k_strips - 0.5);
      const double heap = std::tan(surcharge) * (0.25 * width - y * y / width);
      area += (edge + heap - top(y)) * width / k_strips;
    }
    // The bends change it by one or two per cent.
    CHECK(area == approx(upper + lower).epsilon(0.03));
  }
}

TEST_CASE("drawn faces of a belt shall lie on it and look outwards") {
  const auto belt = make_shape("belt_conveyor", troughed());
  const auto t = belt->triangles({-3, -1, -1}, {1, 1, 1}, 0.1);
  REQUIRE(t.size() > 300);
  double farthest = 0.0;
  int inwards = 0;
  int skipped = 0;
  for (std::size_t n = 0; n + 2 < t.size(); n += 3) {
    // Where the belt runs on to the pulley its underside goes on inside.
    bool is_in_pulley = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double distance = belt->nearest(t[n + c]).distance;
      is_in_pulley = is_in_pulley || (distance < 0.0 &&
                                      std::hypot(t[n + c].x, t[n + c].z) < k_radius + k_thickness);
      // Tips of the rounded edge are drawn square to the section: a hundredth of a millimetre off.
      if (!is_in_pulley) CHECK(std::abs(distance) < 1e-5);
      farthest = std::max(farthest, -t[n + c].x);
    }
    const Vec3 normal = cross(t[n + 1] - t[n], t[n + 2] - t[n]);
    const Vec3 middle = (t[n] + t[n + 1] + t[n + 2]) / 3.0;
    const SurfacePoint s = belt->nearest(middle + (0.005 / norm(normal)) * normal);
    if (!is_in_pulley && !(dot(s.normal, normal) > 0.7 * norm(normal))) ++inwards;
    skipped += is_in_pulley ? 1 : 0;
  }
  CHECK(inwards == 0);
  CHECK(skipped < static_cast<int>(t.size()) / 3 / 4);
  CHECK(farthest == approx(3.0).epsilon(1e-12));  // cut off beside the box
}

TEST_CASE("the nips of a belt shall be inside its loop at its pulleys, and nowhere else") {
  const auto belt = make_shape("belt_conveyor", troughed());
  constexpr double k_grain = 0.02;  // radius
  const double inner = k_radius;    // from the axis to the inner face of the return run
  const auto nip = [&](Vec3 point) { return belt->nip_at(point, k_grain); };
  // A grain on the return run touches the pulley's rim where both distances are its radius.
  const double rim = k_radius + k_thickness + k_grain;
  const double touching = std::sqrt(rim * rim - (inner - k_grain) * (inner - k_grain));
  const Vec3 at_tail{-8 + touching, 0, -(inner - k_grain)};
  CHECK(belt->nearest(at_tail).distance == approx(k_grain).epsilon(1e-9));
  CHECK(nip(at_tail) == "the nip of the tail pulley");
  CHECK(nip(at_tail + Vec3{0.9 * k_grain, 0.49, 0}) == "the nip of the tail pulley");
  CHECK(nip({-touching, 0, inner - k_grain}) == "the nip of the head pulley");
  // Deep in the wedge, its centre within the belt.
  CHECK(nip({-8 + 0.1, 0, -inner - 0.01}) == "the nip of the tail pulley");
  // Farther off on the return run, beside it, below it, round the pulley, on the load's side.
  CHECK(nip(at_tail + Vec3{1.1 * k_grain, 0, 0}).empty());
  CHECK(nip(at_tail + Vec3{0, 0.51, 0}).empty());
  CHECK(nip({-8 + 0.1, 0, -(inner + k_thickness + k_grain)}).empty());
  CHECK(nip({-8 - 0.1, 0, -(inner - k_grain)}).empty());
  for (const double x : {-7.9, -8 + touching, -touching, -0.1}) {
    const double top = walk(x > -4 ? x : -8 - x, 0.0).z;
    CHECK(nip({x, 0, top + k_thickness / 2 + 0.001}).empty());
  }
  CHECK(make_shape("box", {{"min", Vec3{}}, {"max", Vec3{1, 1, 1}}})->nip_at({}, 0.1).empty());
}

TEST_CASE("a belt whose parts do not fit shall be refused") {
  const auto refused = [](const char* key, const Value& value) {
    auto values = troughed();
    values[key] = value;
    try {
      make_shape("belt_conveyor", values);
    } catch (const dust::sdk::ParameterError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(refused("centre_roll", 1.2) == "centre_roll is not shorter than the width");
  CHECK(refused("bend_radius", 2.0) == "bend_radius is too large for the rolls");
  CHECK(
      refused("transition", 5.0).starts_with("both transitions, 5 m and 5 m, do not fit between"));
  CHECK(refused("transition", 5.0).ends_with(" apart: make them shorter"));
  CHECK(refused("tail", Vec3{}) == "head and tail are the same point");
  CHECK(refused("up", Vec3{-1, 0, 0}) == "up is along the belt");
  CHECK(refused("sag", 0.02) == "sag needs the idler_spacing");
}

TEST_CASE("a sagging belt shall lie on both pulleys, wherever the idlers are wanted") {
  for (const double spacing : {1.0, 1.25, 1.7, 30.0}) {
    CAPTURE(spacing);
    auto values = troughed();
    values["tail"] = Vec3{-12, 0, 0};
    values["sag"] = 0.03;
    values["idler_spacing"] = spacing;
    const auto belt = make_shape("belt_conveyor", values);
    const double top = k_radius + k_thickness;
    for (const double end : {-12.0, 0.0}) {
      CHECK(belt->nearest({end, 0, top + 0.01}).distance == approx(0.01).epsilon(1e-6));
      // Smoothly from run to pulley.
      for (const double x : {end - 1e-4, end + 1e-4}) {
        const auto near = belt->nearest({x, 0, top + 0.01});
        CHECK(std::abs(near.distance - 0.01) < 1e-6);
        CHECK(near.normal.z > 1.0 - 1e-6);
      }
    }
  }
}
