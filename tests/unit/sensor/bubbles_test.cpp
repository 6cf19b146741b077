// SPDX-License-Identifier: Apache-2.0
// Bubbles of known place, size and speed.
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

constexpr double k_dense = 0.45;
constexpr double k_radius = 6.2e-3;

/// 20 x 20 x 60 cells of 1 mm: dense below 50 mm, empty above.
SyntheticScene bed() {
  SyntheticScene world;
  world.domain_max = {0.02, 0.02, 0.06};
  set_cells(world, 20, 20, 60);
  world.interval = 1e-3;
  return world;
}
/// Spheres of nothing but air in the bed; the void fraction of a cell on a border is smeared over
/// one cell, as grains smear it.
void blow(SyntheticScene& world, const std::vector<Vec3>& centres, double radius = k_radius) {
  for_cells(world, [&](std::size_t c, Vec3 x) {
    double share = x.z > 0.05 ? 1.0 : 0.0;
    for (const Vec3& centre : centres) {
      share = std::max(share, std::clamp(0.5 + (radius - norm(x - centre)) / 1e-3, 0.0, 1.0));
    }
    world.void_fraction[c] = static_cast<float>(k_dense + (1.0 - k_dense) * share);
  });
}
std::unique_ptr<sdk::Sensor> sensor(std::map<std::string, sdk::Value> more = {}) {
  more.insert({{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.02, 0.02, 0.055}}, {"threshold", 0.725}});
  return load_sensor("bubbles").make(more);
}
// A sphere of 12 cells across, made of whole cells.
constexpr double k_cells = 0.03;

}  // namespace

TEST_CASE("bubbles shall have the number, size and speed of the spheres there are") {
  SyntheticScene world = bed();
  const auto bubbles = sensor();
  constexpr double k_speed = 0.25;
  for (int n = 0; n < 50; ++n) {
    const double rise = k_speed * world.interval * n;
    blow(world, {{0.01, 0.01, 0.012 + rise}, {0.01, 0.01, 0.030 + rise}});
    step(*bubbles, world);
  }
  const Figures figures = summary_of(*bubbles);
  CHECK(figures["number"] == test::approx(2.0));
  CHECK(figures["diameter"] == test::approx(2 * k_radius).epsilon(k_cells));
  const double volume = 2 * 4.0 / 3.0 * std::numbers::pi * std::pow(k_radius, 3);
  CHECK(figures["volume_share"] ==
        test::approx(volume / (0.02 * 0.02 * 0.055)).epsilon(3 * k_cells));
  CHECK(figures["rise_velocity"] == test::approx(k_speed).epsilon(0.02));
}

TEST_CASE("bubbles shall leave out the space over the bed, and those too small") {
  SyntheticScene world = bed();
  blow(world, {{0.01, 0.01, 0.044}, {0.01, 0.01, 0.02}});  // the upper one breaks the surface
  const auto all = sensor();
  step(*all, world);
  CHECK(series_of(*all)["number"] == test::approx(1.0));
  const auto large = sensor({{"smallest", 0.014}});
  step(*large, world);
  CHECK(series_of(*large)["number"] == test::approx(0.0));
  CHECK(is_of_nothing(series_of(*large).at("diameter")));
  CHECK(is_of_nothing(summary_of(*large).at("diameter")));
  // Downwards, the bottom is the open end: the bubble in the bed and the space above both count.
  const auto down = sensor({{"direction", Vec3{0, 0, -1}}});
  step(*down, world);
  CHECK(series_of(*down)["number"] == test::approx(2.0));
}

TEST_CASE("bubbles that merge shall not count as one that jumps") {
  SyntheticScene world = bed();
  const auto bubbles = sensor();
  blow(world, {{0.006, 0.01, 0.015}, {0.014, 0.01, 0.03}}, 5e-3);
  step(*bubbles, world);
  blow(world, {{0.006, 0.01, 0.016}, {0.0125, 0.01, 0.022}}, 5e-3);  // they touch now
  step(*bubbles, world);
  CHECK(series_of(*bubbles)["number"] == test::approx(1.0));
  CHECK(is_of_nothing(series_of(*bubbles).at("rise_velocity")));
}

TEST_CASE("bubbles shall refuse a box without inside and a slanted direction") {
  CHECK_THROWS(load_sensor("bubbles").make({{"min", Vec3{0, 0, 1}}, {"max", Vec3{1, 1, 1}}}));
  SyntheticScene world = bed();
  blow(world, {});
  const auto slanted = sensor({{"direction", Vec3{1, 0, 1}}});
  CHECK_THROWS(step(*slanted, world));
}
