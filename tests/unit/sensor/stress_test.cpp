// SPDX-License-Identifier: Apache-2.0
#include "sensor/stress/stress.hpp"

#include "support/approx.hpp"
#include "support/sensor_bench.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Value;
using dust::sdk::Vec3;
namespace formula = dust::model::stress;

namespace {

/// One kind of the grains of a gas: so many of them at a time in the mean.
struct Kind {
  double number;
  double mass;
  double weight = 1.0;
};

/// Kinetic pressure of a gas of `kinds`, m times the variance of a velocity 1e-8 J for all, in
/// cells of 1 cm3, over what it is in theory. The grains drift at 1 m/s.
double kinetic_share(const std::vector<Kind>& kinds) {
  constexpr double k_temperature = 1e-8;  // [J]
  constexpr double k_cells = 200.0;
  const auto sensor = load_sensor("stress").make(
      {{"min", Vec3{0, 0, 0}}, {"max", Vec3{2, 0.01, 0.01}}, {"cells", Vec3{k_cells, 1, 1}}});
  SyntheticScene world;
  world.domain_max = {2, 0.01, 0.01};
  Dice dice(1);
  double real_grains = 0.0;  // per cell
  for (const Kind& kind : kinds) real_grains += kind.number * kind.weight;
  for (int sample = 0; sample < 100; ++sample) {
    world.grains.clear();
    for (const Kind& kind : kinds) {
      const double speed = std::sqrt(k_temperature / kind.mass);
      for (double n = 0.0; n < kind.number * k_cells; ++n) {
        Grain g;
        g.now = {2 * dice.uniform(), 5e-3, 5e-3};
        g.velocity = Vec3{1, 0, 0} + speed * Vec3{dice.normal(), dice.normal(), dice.normal()};
        g.mass = kind.mass;
        g.weight = kind.weight;
        world.grains.push_back(g);
      }
    }
    step(*sensor, world);
  }
  return summary_of(*sensor)["pressure"] / (real_grains * k_temperature / 1e-6);
}

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
  // The variance that 8 grains tell of: 8/7 of their mean square about their own mean.
  CHECK(f["xx"] == approx(8.0 / 7.0 * density * 0.01).epsilon(1e-9));
  CHECK(f["yy"] == approx(8.0 / 7.0 * density * 0.04).epsilon(1e-9));
  CHECK(f["zz"] == approx(8.0 / 7.0 * density * 0.09).epsilon(1e-9));
  CHECK(std::abs(f["xy"]) < 1e-9);
}

TEST_CASE("a gas of few grains in a cell shall press with its temperature but for single grains") {
  // 100 samples of 200 cells, three directions: the scatter is below 0.4 % at 5 grains a cell,
  // below 1 % at 1. A share exp(-number) is in cells in which it is alone.
  CHECK(kinetic_share({{5.0, 1e-6}}) == approx(1.0 - std::exp(-5.0)).epsilon(0.015));
  CHECK(kinetic_share({{1.0, 1e-6}}) == approx(1.0 - std::exp(-1.0)).epsilon(0.04));
  // A gas of two masses that differ by a factor of 30, with as much energy in each.
  CHECK(kinetic_share({{3.0, 1e-6}, {3.0, 3e-5}}) == approx(1.0 - std::exp(-6.0)).epsilon(0.015));
}

TEST_CASE("light copies of grains shall press as the grains that they stand for") {
  // Of one mass, half of the real grains as four copies each; a copy alone in its cell is rare.
  CHECK(kinetic_share({{3.0, 1e-6}, {12.0, 1e-6, 0.25}}) == approx(1.0).epsilon(0.015));
}

TEST_CASE("what a cell of few grains loses shall be given back, of a single one nothing") {
  formula::Sample s;
  CHECK(formula::unbiased(s) == 0.0);
  formula::add_grain(1.0, 2e-6, s);
  CHECK(formula::unbiased(s) == 0.0);
  for (int n = 2; n < 6; ++n) {
    formula::add_grain(1.0, n % 2 == 0 ? 5e-6 : 1e-9, s);
    CHECK(formula::unbiased(s) == approx(n / (n - 1.0)).epsilon(1e-12));
  }
  // Two of one mass, one of them for three: 1 - (9 + 1) / 16.
  formula::Sample weighted;
  formula::add_grain(3.0, 1e-6, weighted);
  formula::add_grain(1.0, 1e-6, weighted);
  CHECK(formula::unbiased(weighted) == approx(16.0 / 6.0).epsilon(1e-12));
}
