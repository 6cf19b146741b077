// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Vec3;

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
const Vec3 k_centre{0.05, 0.04, 0.01};

/// A bed on a jittered level grid of 0.6 mm, filled from z = 0 up to `height(x, y)`.
SyntheticScene bed(const std::function<double(double, double)>& height, double noise = 0.0,
                   int seed = 1) {
  Dice dice(seed);
  SyntheticScene world;
  world.class_diameters = {600e-6};
  for (double x = 0.0; x < 0.1; x += 0.6e-3) {
    for (double y = 0.0; y < 0.08; y += 0.6e-3) {
      const Vec3 place{x + 0.2e-3 * dice.uniform(), y + 0.2e-3 * dice.uniform(), 0.0};
      double top = height(place.x, place.y);
      if (noise > 0.0) top += noise * dice.normal();
      for (double z = top; z > std::max(0.0, top - 2e-3); z -= 0.7e-3) {
        Grain g;
        g.now = g.before = place + Vec3{0, 0, z - 0.3e-3};
        g.diameter = 600e-6;
        world.grains.push_back(g);
      }
    }
  }
  return world;
}

double radius(double x, double y) { return std::hypot(x - k_centre.x, y - k_centre.y); }

Figure measured(SyntheticScene world, std::map<std::string, dust::sdk::Value> parameters) {
  const auto sensor = load_sensor("angle_of_repose").make(parameters);
  step(*sensor, world);
  return summary_of(*sensor).at("angle");
}

}  // namespace

// Surfaces made of the grains' tops are exact planes and cones: the fit finds them to rounding of
// the places (the cells' highest grains lie on the surface, whichever they are).
constexpr double k_exact = 1e-6;

TEST_CASE(
    "an exact cone shall be measured with its angle and no scatter, at any height of its foot") {
  for (const double angle : {20.0, 33.0, 41.6}) {
    const auto cone =
        bed([&](double x, double y) { return 30e-3 - std::tan(angle * k_degree) * radius(x, y); });
    const auto f = measured(cone, {{"centre", k_centre}});
    CHECK(f.value == approx(angle).epsilon(k_exact));
    CHECK(f.uncertainty < 1e-4);
  }
}

TEST_CASE("a place without a heap shall have no angle") {
  const auto f = measured(SyntheticScene{}, {{"centre", k_centre}});
  CHECK(is_of_nothing(f));
}

TEST_CASE("a rounded tip and a spread foot shall not count") {
  const auto heap = bed([&](double x, double y) {
    const double line = 30e-3 - std::tan(33 * k_degree) * radius(x, y);
    return std::min(27e-3, std::max(line, 3e-3));
  });
  CHECK(measured(heap, {{"centre", k_centre}, {"from_share", 0.2}, {"to_share", 0.8}}).value ==
        approx(33.0).epsilon(1e-3));
}

TEST_CASE("a slope and a crater shall be measured, also with gravity along another axis") {
  const auto slope =
      bed([](double x, double) { return 40e-3 - std::tan(35.9 * k_degree) * 0.6 * x; });
  const double angle = std::atan(0.6 * std::tan(35.9 * k_degree)) / k_degree;
  CHECK(measured(slope, {{"form", std::string("planar")}}).value == approx(angle).epsilon(k_exact));
  const auto crater =
      bed([](double x, double y) { return 1e-3 + std::tan(41 * k_degree) * radius(x, y); });
  CHECK(measured(crater, {{"form", std::string("crater")}, {"centre", k_centre}}).value ==
        approx(41.0).epsilon(k_exact));
  // The same crater is no cone.
  CHECK(measured(crater, {{"centre", k_centre}}).value == 0.0);
  SyntheticScene turned = slope;
  turned.gravity = {-9.81, 0, 0};
  for (Grain& g : turned.grains) g.now = {g.now.z, g.now.x, g.now.y};
  CHECK(measured(turned, {{"form", std::string("planar")}, {"direction", Vec3{0, 1, 0}}}).value ==
        approx(angle).epsilon(k_exact));
}

TEST_CASE("the uncertainty of an angle shall be that of repeated heaps") {
  Coverage coverage;
  constexpr int k_heaps = 60;
  for (int run = 0; run < k_heaps; ++run) {
    // Heights scatter by half a grain, as those of a real surface.
    const auto cone =
        bed([](double x, double y) { return 30e-3 - std::tan(33 * k_degree) * radius(x, y); },
            0.3e-3, run);
    coverage.add(measured(cone, {{"centre", k_centre}}), 33.0);
  }
  CHECK(coverage.without_error == 0);
  // 60 runs scatter by 6 and 3 %: three of these below 67 and 93 % (t of 7 degrees).
  CHECK(coverage.one() > 0.49);
  CHECK(coverage.two() > 0.84);
}
