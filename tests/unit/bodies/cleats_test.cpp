// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/running_parts.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "unit/bodies/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using dust::bodies::Body;
using dust::sdk::Motion;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::make_shape;

constexpr double k_pi = std::numbers::pi;
constexpr double k_radius = 0.29;
constexpr double k_thickness = 0.02;
constexpr double k_reach = 0.3;  // of the belt's middle surface
constexpr double k_face = 0.31;  // of its outer face
constexpr double k_length = 4.0;
constexpr double k_height = 0.06;
constexpr double k_bar = 0.03;  // thickness of a cleat
constexpr double k_speed = 1.5;
constexpr double k_lap = 2 * (k_length + k_pi * k_reach);
constexpr int k_count = 20;
constexpr double k_pitch = k_lap / k_count;  // 0.494 m; 0.5 m is asked for

std::map<std::string, Value> cleated() {
  return {{"head", Vec3{}},
          {"tail", Vec3{-k_length, 0, 0}},
          {"radius", k_radius},
          {"thickness", k_thickness},
          {"width", 0.8},
          {"cleat_height", k_height},
          {"cleat_thickness", k_bar},
          {"cleat_spacing", 0.5}};
}

/// The same on rolls at 35 degrees, with raised pulleys.
constexpr double k_trough = 35.0 * k_pi / 180.0;
constexpr double k_centre = 0.3;
constexpr double k_bend = 0.12;
constexpr double k_transition = 1.2;
constexpr double k_rise = 0.04;

std::map<std::string, Value> troughed() {
  auto values = cleated();
  values.insert({{"trough_angle", k_trough},
                 {"centre_roll", k_centre},
                 {"bend_radius", k_bend},
                 {"transition", k_transition},
                 {"pulley_rise", k_rise}});
  return values;
}

Body running_belt(double ramp = 0.0, bool is_troughed = false) {
  Body body;
  body.shape = make_shape("belt_conveyor", is_troughed ? troughed() : cleated());
  body.motions.push_back(dust::test::ModelLoader::make<Motion>(
      "motion", "belt", {{"speed", k_speed}, {"ramp", ramp}}));
  return body;
}

}  // namespace

TEST_CASE("cleats shall travel along the carrying run with the belt, as exact boxes") {
  for (const double ramp : {0.0, 0.5}) {
    const Body body = running_belt(ramp);
    CHECK(body.displaces());
    for (const double time : {0.0, 0.05, 0.31, 0.9, 7.3}) {
      CAPTURE(time);
      const auto at = body.placement(time);
      const double run = time < ramp ? 0.5 * k_speed * time * time / ramp  // the ramp's integral
                                     : k_speed * (time - 0.5 * ramp);
      // Cleats were at multiples of the pitch from the head pulley's axis; this one is the first
      // of those before it that is wholly on the run.
      const double x = std::fmod(run, k_pitch) - 3 * k_pitch;
      // On its faces, before and behind; over its top; off its upper edge; in the gap.
      const auto before = body.nearest({x + k_bar / 2 + 0.01, 0.1, k_face + 0.03}, at);
      CHECK(before.distance == approx(0.01).epsilon(1e-9));
      CHECK(norm(before.normal - Vec3{1, 0, 0}) < 1e-9);
      const auto behind = body.nearest({x - k_bar / 2 - 0.01, 0.1, k_face + 0.03}, at);
      CHECK(behind.distance == approx(0.01).epsilon(1e-9));
      CHECK(norm(behind.normal + Vec3{1, 0, 0}) < 1e-9);
      const auto over = body.nearest({x + 0.01, -0.3, k_face + k_height + 0.02}, at);
      CHECK(over.distance == approx(0.02).epsilon(1e-9));
      CHECK(norm(over.normal - Vec3{0, 0, 1}) < 1e-9);
      const auto edge = body.nearest({x + k_bar / 2 + 0.03, 0.0, k_face + k_height + 0.04}, at);
      CHECK(edge.distance == approx(0.05).epsilon(1e-9));
      CHECK(norm(edge.normal - Vec3{0.6, 0, 0.8}) < 1e-9);
      const auto inside = body.nearest({x + k_bar / 2 - 0.004, 0.0, k_face + 0.03}, at);
      CHECK(inside.distance == approx(-0.004).epsilon(1e-9));
      CHECK(body.nearest({x + k_pitch / 2, 0.0, k_face + 0.05}, at).distance ==
            approx(0.05).epsilon(1e-9));
      // A sphere in the corner touches belt and cleat, each with its own part.
      const Vec3 corner{x + k_bar / 2 + 0.02, 0.0, k_face + 0.025};
      CHECK(body.contact(0, corner, 1.0, at).distance == approx(0.025).epsilon(1e-9));
      CHECK(body.contact(1, corner, 1.0, at).distance == approx(0.02).epsilon(1e-9));
      // Face and belt run alike.
      const double speed = time < ramp ? k_speed * time / ramp : k_speed;
      const Vec3 face = body.surface_velocity(corner - Vec3{0.02, 0, 0}, {1, 0, 0}, time);
      CHECK(norm(face - Vec3{speed, 0, 0}) < 1e-12);
      const Vec3 belt = body.surface_velocity(corner - Vec3{0, 0, 0.025}, {0, 0, 1}, time);
      CHECK(norm(belt - Vec3{speed, 0, 0}) < 1e-12);
      CHECK(dust::bodies::normal_speed(body, at, corner - Vec3{0.02, 0, 0}, {1, 0, 0}) ==
            approx(speed).epsilon(1e-12).scale(1.0));
      CHECK(std::abs(dust::bodies::normal_speed(body, at, corner - Vec3{0, 0, 0.025}, {0, 0, 1})) <
            1e-12);
    }
  }
}

TEST_CASE("cleats shall turn about the pulleys and come back below the belt") {
  const Body body = running_belt();
  // The cleat that is over the head pulley's axis at time 0.
  for (const double angle : {0.3, 1.2, 2.5}) {
    CAPTURE(angle);
    const double time = angle * k_reach / k_speed;
    const Vec3 out{std::sin(angle), 0, std::cos(angle)};
    const Vec3 along{std::cos(angle), 0, -std::sin(angle)};
    const double r = k_face + k_height / 2;
    const auto s = body.nearest(r * out + (k_bar / 2 + 0.005) * along, body.placement(time));
    CHECK(s.distance == approx(0.005).epsilon(1e-9));
    CHECK(norm(s.normal - along) < 1e-9);
    // A rigid turn at U / reach.
    const Vec3 p = r * out + k_bar / 2 * along;
    const Vec3 turned = k_speed / k_reach * Vec3{p.z, 0, -p.x};
    CHECK(norm(body.surface_velocity(p, along, time) - turned) < 1e-9);
    CHECK(norm(turned) <= body.largest_speed());
    // The pulley's own face runs at the belt's speed.
    const double beside = angle + 0.5 * k_pitch / k_reach;
    const Vec3 face = k_face * Vec3{std::sin(beside), 0, std::cos(beside)};
    if (beside < k_pi) {
      CHECK(norm(body.surface_velocity(face, face / k_face, time)) ==
            approx(k_speed).epsilon(1e-9));
    }
  }
  // Down it stands on the return run, from there round the tail and up again after a lap.
  const double way = k_pi * k_reach + 1.0;
  const auto down =
      body.nearest({-1.0, 0, -k_face - k_height - 0.02}, body.placement(way / k_speed));
  CHECK(down.distance == approx(0.02).epsilon(1e-9));
  CHECK(down.normal.z == approx(-1.0).epsilon(1e-12));
  CHECK(norm(body.surface_velocity({-1.0, 0, -k_face - k_height}, {0, 0, -1}, way / k_speed) -
             Vec3{-k_speed, 0, 0}) < 1e-12);
  const double up = k_pi * k_reach + k_length + k_pi * k_reach / 2;
  const auto tail =
      body.nearest({-k_length - k_face - k_height - 0.02, 0, 0}, body.placement(up / k_speed));
  CHECK(tail.distance == approx(0.02).epsilon(1e-9));
  for (const Vec3 p : {Vec3{-0.3, 0.1, 0.4}, Vec3{0.4, 0.0, 0.1}}) {
    CHECK(body.nearest(p, body.placement(0.2 + k_lap / k_speed)).distance ==
          approx(body.nearest(p, body.placement(0.2)).distance).epsilon(1e-9));
  }
}

TEST_CASE("a face shall move along its normal as fast as the distance to it falls") {
  // What the air displaces: from the shape at two times, without the velocity. In a turned frame,
  // on the run, over the pulley and below.
  for (const bool is_troughed : {false, true}) {
    Body body = running_belt(0.0, is_troughed);
    body.frame_origin = {1, 2, 3};
    body.frame_axis = {0, 1, 0};
    body.frame_angle = -0.6;
    constexpr double k_step = 1e-6;
    const auto at_rest = body.placement(0.0);
    int moved = 0;
    for (const double time : {0.11, 0.2, 0.27}) {
      for (int n = 0; n < 400; ++n) {
        const double a = 0.1 * n;
        const Vec3 local{-2.0 + 2.5 * std::fmod(0.37 * n, 1.0), 0.3 * std::sin(a),
                         0.42 * std::cos(7 * a)};
        const Vec3 p = at_rest.to_domain(local);
        const auto s = body.nearest(p, body.placement(time));
        if (!(s.distance > 1e-3)) continue;
        const double later = body.nearest(p, body.placement(time + k_step)).distance;
        const double earlier = body.nearest(p, body.placement(time - k_step)).distance;
        const Vec3 v = body.surface_velocity(p - s.distance * s.normal, s.normal, time);
        const double falls = (earlier - later) / (2 * k_step);
        CHECK(falls == approx(dot(v, s.normal)).epsilon(1e-3).scale(1.0));
        moved += std::abs(falls) > 0.5 ? 1 : 0;
      }
    }
    CHECK(moved > 50);
  }
}

TEST_CASE("lists shall hold every grain that cleats come to touch") {
  for (const bool is_troughed : {false, true}) {
    const Body body = running_belt(0.0, is_troughed);
    for (int n = 0; n < 2000; ++n) {
      const double time = 0.0137 * n;
      const auto at = body.placement(time);
      const Vec3 p{-4.5 + 5.0 * std::fmod(0.618 * n, 1.0),
                   is_troughed ? 0.4 * std::sin(0.1 * n) : 0.1, -0.5 + std::fmod(0.414 * n, 1.0)};
      for (int part = 0; part < 2; ++part) {
        if (body.contact(part, p, 1.0, at).distance < 0.03)
          CHECK(body.is_within(part, p, 0.03, at));
      }
    }
  }
}

TEST_CASE("drawn cleats shall lie on those that grains touch") {
  const Body body = running_belt();
  for (const double time : {0.0, 0.13}) {
    const auto at = body.placement(time);
    const auto t = body.triangles({-3, -1, -1}, {1, 1, 1}, 0.1, at);
    int high = 0;
    for (std::size_t n = 0; n + 2 < t.size(); n += 3) {
      const Vec3 middle = (t[n] + t[n + 1] + t[n + 2]) / 3.0;
      if (middle.z < k_face + 0.5 * k_height || middle.x > -0.2) continue;
      ++high;
      const Vec3 normal = cross(t[n + 1] - t[n], t[n + 2] - t[n]);
      const auto s = body.nearest(middle, at);
      CHECK(std::abs(s.distance) < 1e-9);
      CHECK(body.nearest(middle + 1e-4 / norm(normal) * normal, at).distance ==
            approx(1e-4).epsilon(1e-6));
    }
    CHECK(high >= 2 * 6);
  }
}

TEST_CASE("cleats in a trough shall fit its section") {
  const Body body = running_belt(0.0, true);
  const double tangent = k_bend * std::tan(k_trough / 2);
  const double floor = k_reach - k_rise;  // middle surface on the centre roll
  const double top = k_thickness / 2 + k_height;
  for (const double time : {0.0, 0.11}) {
    const auto at = body.placement(time);
    const double x = std::fmod(k_speed * time, k_pitch) - 4 * k_pitch;
    // Over centre and wing, square to either, and over the bend along its radius.
    const Vec3 out{0, -std::sin(k_trough), std::cos(k_trough)};
    const Vec3 up_wing{0, std::cos(k_trough), std::sin(k_trough)};
    const Vec3 on_wing = Vec3{x, k_centre / 2, floor} + 0.15 * up_wing;
    const auto over = [&](Vec3 base, Vec3 normal) {
      const auto s = body.contact(1, base + (top + 0.02) * normal, 1.0, at);
      CHECK(s.distance == approx(0.02).epsilon(1e-9));
      CHECK(norm(s.normal - normal) < 1e-9);
    };
    over({x, 0.05, floor}, {0, 0, 1});
    over(on_wing, out);
    const double half = k_trough / 2;
    const Vec3 turn{0, -std::sin(half), std::cos(half)};
    over(Vec3{x, k_centre / 2 - tangent, floor + k_bend} - k_bend * turn, turn);
    // Before its face, over the wing; a sphere there touches belt and cleat.
    const Vec3 corner = on_wing + Vec3{k_bar / 2 + 0.02, 0, 0} + (k_thickness / 2 + 0.025) * out;
    CHECK(body.contact(1, corner, 1.0, at).distance == approx(0.02).epsilon(1e-9));
    CHECK(norm(body.contact(1, corner, 1.0, at).normal - Vec3{1, 0, 0}) < 1e-9);
    CHECK(body.contact(0, corner, 1.0, at).distance == approx(0.025).epsilon(1e-9));
    // Its end is the belt's: 0.4 m from the middle along the section.
    const double wing = 0.4 - k_centre / 2 + 2 * tangent - k_bend * k_trough;
    const Vec3 end = Vec3{x, k_centre / 2, floor} + wing * up_wing;
    const auto off_edge = body.contact(1, end + 0.03 * up_wing + 0.05 * out, 1.0, at);
    CHECK(off_edge.distance == approx(0.03).epsilon(1e-9));
    CHECK(norm(off_edge.normal - up_wing) < 1e-9);
    const Vec3 v = body.surface_velocity(corner - Vec3{0.02, 0, 0}, {1, 0, 0}, time);
    CHECK(norm(v - Vec3{k_speed, 0, 0}) < 1e-9);
  }
}

TEST_CASE("the distance to cleats in a trough shall be that of brute force, in transitions too") {
  const Body body = running_belt(0.0, true);
  const auto at = body.placement(0.1);
  // Points of the drawn cleats, which another function makes, finely divided.
  std::vector<Vec3> drawn;
  const auto t = body.triangles({-3.9, -1, -1}, {1, 1, 1}, 0.02, at);
  // Of a triangle of the belt's face at most two corners are on a cleat.
  const auto is_cleat = [&](std::size_t n) {
    return std::all_of(
        t.begin() + static_cast<std::ptrdiff_t>(n), t.begin() + static_cast<std::ptrdiff_t>(n) + 3,
        [&](Vec3 p) { return p.z > 0.2 && std::abs(body.contact(1, p, 1.0, at).distance) < 1e-4; });
  };
  for (std::size_t n = 0; n + 2 < t.size(); n += 3) {
    if (!is_cleat(n)) continue;
    for (int i = 0; i <= 6; ++i) {
      for (int j = 0; i + j <= 6; ++j) {
        drawn.push_back(t[n] + i / 6.0 * (t[n + 1] - t[n]) + j / 6.0 * (t[n + 2] - t[n]));
      }
    }
  }
  REQUIRE(drawn.size() > 5000);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p{-3.4 + 3.2 * std::fmod(0.618 * n, 1.0), 0.4 * std::sin(0.7 * n),
                 0.35 + 0.4 * std::fmod(0.414 * n, 1.0)};
    const auto s = body.contact(1, p, 2.0, at);
    if (!(s.distance > 0.005)) continue;
    double brute = 1e9;
    for (const Vec3& q : drawn) brute = std::min(brute, norm(p - q));
    CAPTURE(p.x);
    CAPTURE(p.y);
    CAPTURE(p.z);
    CHECK(s.distance < brute + 1e-4);
    CHECK(brute < s.distance + 0.01);
    CHECK(std::abs(body.contact(1, p - s.distance * s.normal, 2.0, at).distance) < 1e-9);
  }
}

TEST_CASE("cleats that cannot be made shall be refused by name") {
  const auto refused = [](const std::string& key, const Value& value) {
    auto values = cleated();
    values[key] = value;
    try {
      make_shape("belt_conveyor", values);
    } catch (const dust::sdk::ParameterError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(refused("cleat_height", 0.0) == "cleat_height is 0: cleats need a height");
  CHECK(refused("cleat_thickness", 0.0) == "cleat_thickness is 0: cleats need a thickness");
  CHECK(refused("cleat_spacing", 0.0) == "cleat_spacing is 0: cleats need a spacing");
  CHECK(refused("cleat_spacing", 0.03) == "cleat_spacing is not longer than cleat_thickness");
  auto folded = troughed();
  folded["bend_radius"] = 0.065;
  CHECK_THROWS_WITH_AS(
      make_shape("belt_conveyor", folded),
      "cleat_height is not below bend_radius: a cleat would fold where the belt bends",
      dust::sdk::ParameterError);
  CHECK(refused("tail", Vec3{}) == "head and tail are the same point");
  Body body = running_belt();
  CHECK(dust::bodies::motion_conflict(body).empty());
  body.motions.push_back(dust::test::ModelLoader::make<Motion>("motion", "translate",
                                                               {{"velocity", Vec3{0, 0, 0.1}}}));
  CHECK(dust::bodies::motion_conflict(body).starts_with("cleats run on a belt that stays"));
  // Not one bit of a plain belt is of that kind.
  auto plain = cleated();
  for (const char* key : {"cleat_height", "cleat_thickness", "cleat_spacing"}) plain.erase(key);
  body.shape = make_shape("belt_conveyor", plain);
  CHECK(dust::bodies::running_parts(body) == nullptr);
  CHECK(body.shape->parts() == 1);
}
