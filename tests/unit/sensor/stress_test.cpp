// SPDX-License-Identifier: Apache-2.0
#include "sensor/stress/stress.hpp"

#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Value;
using dust::sdk::Vec3;
namespace formula = dust::model::stress;

namespace {

const std::map<std::string, Value> k_box{{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.01, 0.01, 0.02}}};

Figures after_one(SyntheticScene& world, std::map<std::string, Value> parameters) {
  const auto sensor = load_sensor("stress").make(parameters);
  step(*sensor, world);
  return summary_of(*sensor);
}

}  // namespace

TEST_CASE("the share of a line in a box shall be its clipped length") {
  const formula::Point low{0, 0, 0};
  const formula::Point high{1, 1, 1};
  CHECK(formula::share_in_box({0.5, 0.5, 0.5}, {1, 0, 0}, low, high) == 0.5);
  CHECK(formula::share_in_box({-1, -1, -1}, {3, 3, 3}, low, high) == approx(1.0 / 3));
  CHECK(formula::share_in_box({-1, 0.5, 0.5}, {0.5, 0, 0}, low, high) == 0.0);
  CHECK(formula::share_in_box({0.5, 2.0, 0.5}, {1, 0, 0}, low, high) == 0.0);
  formula::Cells cells{low, high, {4, 3, 5}};
  double sum = 0.0;
  cells.along({0.05, 0.9, 0.2}, {0.8, -0.7, 0.6}, [&](std::size_t, double share) { sum += share; });
  CHECK(sum == approx(1.0).epsilon(1e-14));
}

TEST_CASE("chains that carry a force through a box shall press with force per area") {
  // 6 chains of 20 grains along z, each under 2 mN, from floor to lid of the box.
  SyntheticScene world;
  const double d = 1e-3;
  for (int chain = 0; chain < 6; ++chain) {
    for (int n = 0; n < 20; ++n) {
      Grain g;
      g.now = {1e-3 + 1.5e-3 * chain, 5e-3, (n + 0.5) * d};
      const auto i = static_cast<std::int32_t>(world.grains.size());
      world.grains.push_back(g);
      if (n == 0) world.contacts.push_back({i, -1, {0, 0, 2e-3}, {0, 0, -0.5 * d}});
      if (n == 19) {
        world.contacts.push_back({i, -1, {0, 0, -2e-3}, {0, 0, 0.5 * d}});
      } else {
        world.contacts.push_back({i, i + 1, {0, 0, -2e-3}, {0, 0, d}});
      }
    }
  }
  const double expected = 6 * 2e-3 / (0.01 * 0.01);
  const Figures f = after_one(world, k_box);
  CHECK(f["zz"] == approx(expected).epsilon(1e-12));
  CHECK(std::abs(f["xx"]) < 1e-12 * expected);
  CHECK(f["pressure"] == approx(expected / 3).epsilon(1e-12));
  // Any part of the height sees the same, cut through grains or not, in any number of cells.
  auto part = k_box;
  part["min"] = Vec3{0, 0, 3.27e-3};
  part["max"] = Vec3{0.01, 0.01, 11.9e-3};
  part["cells"] = Vec3{2, 3, 7};
  CHECK(after_one(world, part)["zz"] == approx(expected).epsilon(1e-12));
}

TEST_CASE("a contact through a periodic side shall press as one within") {
  SyntheticScene world;
  world.domain_min = {0, 0, 0};
  world.domain_max = {0.01, 0.01, 0.02};
  Grain g;
  g.now = {5e-3, 5e-3, 19.8e-3};
  world.grains.push_back(g);
  g.now = {5e-3, 5e-3, 0.4e-3};
  world.grains.push_back(g);
  world.contacts = {{0, 1, {0, 0, -1.0}, {0, 0, 0.6e-3}}};
  CHECK(after_one(world, k_box)["zz"] ==
        approx(1.0 * 0.6e-3 / (0.01 * 0.01 * 0.02)).epsilon(1e-12));
}

TEST_CASE("an oblique force shall give a symmetric shear stress") {
  SyntheticScene world;
  world.grains.resize(2);
  world.grains[0].now = {4e-3, 5e-3, 5e-3};
  world.grains[1].now = {5e-3, 5e-3, 6e-3};
  world.contacts = {{0, 1, {-3, 0, -1}, {1e-3, 0, 1e-3}}};
  const Figures f = after_one(world, k_box);
  const double volume = 2e-6;
  CHECK(f["xx"] == approx(3e-3 / volume).epsilon(1e-12));
  CHECK(f["zz"] == approx(1e-3 / volume).epsilon(1e-12));
  CHECK(f["xz"] == approx(2e-3 / volume).epsilon(1e-12));
}

TEST_CASE("a gas without contacts shall press with density times variance, drift not counted") {
  SyntheticScene world;
  for (int n = 0; n < 8; ++n) {
    Grain g;
    g.now = {1e-3 * (1 + n), 5e-3, 5e-3};
    const double s[3] = {n % 2 * 2.0 - 1, n / 2 % 2 * 2.0 - 1, n / 4 * 2.0 - 1};
    g.velocity = Vec3{1, 2, 3} + Vec3{0.1 * s[0], 0.2 * s[1], 0.3 * s[2]};
    g.mass = 1e-6;
    world.grains.push_back(g);
  }
  const Figures f = after_one(world, k_box);
  const double density = 8e-6 / 2e-6;
  CHECK(f["bulk_density"] == approx(density).epsilon(1e-12));
  CHECK(f["xx"] == approx(density * 0.01).epsilon(1e-9));
  CHECK(f["yy"] == approx(density * 0.04).epsilon(1e-9));
  CHECK(f["zz"] == approx(density * 0.09).epsilon(1e-9));
  CHECK(std::abs(f["xy"]) < 1e-9);
}
