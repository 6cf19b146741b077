// SPDX-License-Identifier: Apache-2.0
// Round cleats: ribs, or a belt whose surface is a wave.
#include "bodies/belt/bar_section.hpp"
#include "bodies/belt/running_parts.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "unit/bodies/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace {

using dust::bodies::BarSection;
using dust::bodies::Body;
using dust::sdk::Motion;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::make_shape;

constexpr double k_pi = std::numbers::pi;
constexpr double k_face = 0.31;  // of the belt's outer face, from the pulley's axis
constexpr double k_length = 4.0;
constexpr double k_height = 0.01;
constexpr double k_speed = 1.5;
constexpr double k_lap = 2 * (k_length + k_pi * 0.3);
constexpr int k_count = 2 * 49;  // even: of 0.1 m, which is asked for, 98.8 go round
constexpr double k_wave = k_lap / k_count;

std::map<std::string, Value> waved() {
  return {{"head", Vec3{}},
          {"tail", Vec3{-k_length, 0, 0}},
          {"radius", 0.29},
          {"thickness", 0.02},
          {"width", 0.8},
          {"cleat_profile", std::string("round")},
          {"cleat_height", k_height},
          {"cleat_thickness", 0.1},
          {"cleat_spacing", 0.1}};
}

std::map<std::string, Value> waved_trough() {
  auto values = waved();
  values.insert({{"trough_angle", 35.0 * k_pi / 180.0},
                 {"centre_roll", 0.3},
                 {"bend_radius", 0.12},
                 {"transition", 1.2},
                 {"pulley_rise", 0.04}});
  return values;
}

Body running(const std::map<std::string, Value>& values) {
  Body body;
  body.shape = make_shape("belt_conveyor", values);
  body.motions.push_back(
      dust::test::ModelLoader::make<Motion>("motion", "belt", {{"speed", k_speed}}));
  return body;
}

/// Radius of the arc through a foot of that length and a crest of that height.
double arc(double length, double height) {
  return (0.25 * length * length + height * height) / (2.0 * height);
}

}  // namespace

TEST_CASE("the distance to a section shall be that of brute force along its outline") {
  constexpr double k_belt = 0.01;  // its face over its middle surface
  for (const double height : {0.004, 0.02, 0.05}) {
    const BarSection section(BarSection::Profile::round, 0.1, height, k_belt);
    const double radius = arc(0.1, height);
    const double centre = k_belt + height - radius;
    std::vector<BarSection::Point> outline;
    for (int n = 0; n <= 40000; ++n) {
      const double angle = 2.0 * k_pi * n / 40000;
      const BarSection::Point p{radius * std::sin(angle), centre + radius * std::cos(angle)};
      if (p.n >= 0.0) outline.push_back(p);
    }
    // Its foot in the middle surface: no surface of the belt's for those above it.
    const double foot = std::sqrt(radius * radius - centre * centre);
    for (int n = 0; n < 400; ++n) {
      const double a = 0.15 * std::sin(0.7 * n);
      const double up = 0.14 * std::fmod(0.618 * n, 1.0) - 0.02;  // below the belt, too
      double brute = std::numeric_limits<double>::max();
      for (const BarSection::Point& p : outline) {
        brute = std::min(brute, std::hypot(p.a - a, p.n - up));
      }
      if (up < 0.0) {
        for (int k = 0; k <= 4000; ++k) {
          brute = std::min(brute, std::hypot((k / 2000.0 - 1.0) * foot - a, up));
        }
      }
      const BarSection::Nearest s = section.nearest(a, up);
      // In the belt nobody asks how deep.
      if (s.distance < 0.0 && up < k_belt) continue;
      CAPTURE(height);
      CAPTURE(a);
      CAPTURE(up);
      CHECK(std::abs(s.distance) < brute + 1e-12);
      CHECK(std::abs(s.distance) > brute - 2.0 * k_pi * radius / 40000);
      CHECK((s.distance < 0.0) == (up > 0.0 && std::hypot(a, up - centre) < radius));
      CHECK(std::hypot(s.along, s.over) == approx(1.0).epsilon(1e-12));
      if (up < 0.0) continue;  // towards its foot, where inside counts from what is outside
      CHECK(std::abs(section.nearest(a - s.distance * s.along, up - s.distance * s.over).distance) <
            1e-12);
    }
    // Its drawing lies on it.
    for (const BarSection::Point& p : section.outline()) {
      CHECK(std::abs(section.nearest(p.a, p.n).distance) < 1e-12);
    }
  }
}

TEST_CASE("round cleats that touch shall make the belt's surface a wave that runs with it") {
  const Body body = running(waved());
  CHECK(body.shape->parts() == 3);
  const double radius = arc(k_wave, k_height);
  for (const double time : {0.0, 0.013, 0.9, 7.3}) {
    CAPTURE(time);
    const auto at = body.placement(time);
    const double crest = std::fmod(k_speed * time, k_wave) - 20 * k_wave;
    const auto height = [&](double x) {  // of the wave over the face
      const double a = std::remainder(x - crest, k_wave);
      return k_height - radius + std::sqrt(radius * radius - a * a);
    };
    CHECK(height(crest + 0.5 * k_wave) == approx(0.0).scale(1.0).epsilon(1e-12));
    for (int n = 0; n < 40; ++n) {
      const double x = crest + 0.0501 * n;
      const Vec3 p{x, 0.1, k_face + height(x)};
      CHECK(std::abs(body.nearest(p, at).distance) < 1e-9);
      const Vec3 v = body.surface_velocity(p, body.nearest(p + Vec3{0, 0, 1e-4}, at).normal, time);
      CHECK(norm(v - Vec3{k_speed, 0, 0}) < 1e-9);
    }
    // A grain in a valley touches a crest on either side, not the belt below.
    const Vec3 valley{crest + 0.5 * k_wave, 0.0, k_face + 0.02};
    const auto one = body.contact(1, valley, 1.0, at);
    const auto other = body.contact(2, valley, 1.0, at);
    CHECK(one.distance == approx(other.distance).epsilon(1e-9));
    CHECK(one.normal.x == approx(-other.normal.x).epsilon(1e-9));
    CHECK(std::abs(one.normal.x) > 0.1);
    CHECK(body.contact(0, valley, 1.0, at).distance > one.distance + 1e-5);
  }
}

TEST_CASE("round cleats shall be met by air as by grains, on belts of any section") {
  for (const auto& values : {waved(), waved_trough()}) {
    const Body body = running(values);
    constexpr double k_step = 1e-6;
    int moved = 0;
    for (const double time : {0.11, 0.2}) {
      const auto at = body.placement(time);
      for (int n = 0; n < 600; ++n) {
        const double a = 0.1 * n;
        const Vec3 p{-2.0 + 2.4 * std::fmod(0.37 * n, 1.0), 0.3 * std::sin(a),
                     0.45 * std::cos(7 * a)};
        const auto s = body.nearest(p, at);
        double least = std::numeric_limits<double>::max();
        for (int part = 0; part < body.shape->parts(); ++part) {
          least = std::min(least, body.contact(part, p, 2.0, at).distance);
          // Lists hold what comes to be touched.
          if (body.contact(part, p, 1.0, at).distance < 0.03) {
            CHECK(body.is_within(part, p, 0.03, at));
          }
        }
        CHECK((s.distance < 0.0) == (least < 0.0));
        if (!(s.distance > 1e-3)) continue;
        CHECK(s.distance == approx(least).epsilon(1e-12));
        // The normal is the gradient, the velocity the rate.
        const Vec3 on = p - s.distance * s.normal;
        CHECK(std::abs(body.nearest(on, at).distance) < 1e-8);
        const double later = body.nearest(p, body.placement(time + k_step)).distance;
        const double earlier = body.nearest(p, body.placement(time - k_step)).distance;
        // Half way between two of them the nearer one changes.
        if (std::abs(earlier + later - 2.0 * s.distance) > 1e-8) continue;
        const double falls = (earlier - later) / (2 * k_step);
        CHECK(falls == approx(dot(body.surface_velocity(on, s.normal, time), s.normal))
                           .scale(1.0)
                           .epsilon(1e-3));
        moved += std::abs(falls) > 0.1 ? 1 : 0;
      }
    }
    CHECK(moved > 50);
  }
}

TEST_CASE("drawn waves shall lie on those that grains touch, and close") {
  for (const auto& values : {waved(), waved_trough()}) {
    const Body body = running(values);
    const auto at = body.placement(0.13);
    const auto t = body.triangles({-3, -1, -1}, {1, 1, 1}, 0.1, at);
    int crests = 0;
    for (const Vec3& p : t) {
      if (p.x > -0.5 || p.z < 0.0) continue;
      for (const int part : {1, 2}) {
        if (std::abs(body.contact(part, p, 1.0, at).distance) < 1e-9) ++crests;
      }
    }
    CHECK(crests > 1000);
    for (std::size_t n = 0; n + 2 < t.size(); n += 3) {
      CHECK(norm(cross(t[n + 1] - t[n], t[n + 2] - t[n])) > 0.0);
    }
  }
}

TEST_CASE("round cleats that cannot be made shall be refused by name") {
  auto high = waved();
  high["cleat_height"] = 0.06;
  CHECK_THROWS_WITH_AS(
      make_shape("belt_conveyor", high),
      "cleat_height is more than half of cleat_thickness: a round cleat would overhang",
      dust::sdk::ParameterError);
  auto without = waved();
  for (const char* key : {"cleat_height", "cleat_thickness", "cleat_spacing"}) without.erase(key);
  CHECK_THROWS_WITH_AS(make_shape("belt_conveyor", without),
                       "cleat_height is 0: cleats need a height", dust::sdk::ParameterError);
  auto dense = waved();
  dense["cleat_spacing"] = 0.08;
  CHECK_THROWS_WITH_AS(make_shape("belt_conveyor", dense),
                       "cleat_spacing is shorter than cleat_thickness", dust::sdk::ParameterError);
}
