// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Vec3;

namespace {

Grain moving(Vec3 velocity, Vec3 angular_velocity, double weight = 1.0) {
  Grain g;
  g.velocity = velocity;
  g.angular_velocity = angular_velocity;
  g.diameter = 2e-3;
  g.mass = 1e-6;
  g.weight = weight;
  return g;
}

}  // namespace

TEST_CASE("energies shall be those of full spheres, with their weights") {
  const auto sensor = load_sensor("kinetic_energy").make({});
  SyntheticScene world;
  world.grains = {moving({3, 0, 0}, {0, 100, 0}), moving({0, 0, -1}, {}, 0.5)};
  step(*sensor, world);
  const Figures f = summary_of(*sensor);
  CHECK(f["translation_at_end"] == approx(0.5e-6 * 9 + 0.5 * 0.5e-6).epsilon(1e-14));
  // I = 2/5 m R^2: E = 1/5 m R^2 w^2.
  CHECK(f["rotation_at_end"] == approx(0.2 * 1e-6 * 1e-6 * 1e4).epsilon(1e-14));
  CHECK(f["mean_per_grain"] == approx((4.5e-6 + 0.25e-6 + 0.2e-8) / 1.5).epsilon(1e-14));
}

TEST_CASE("the granular temperature shall be the variance of the velocity, whatever the drift") {
  const auto sensor = load_sensor("kinetic_energy").make({});
  SyntheticScene world;
  for (int n = 0; n < 8; ++n) {
    const double s[3] = {n % 2 * 2.0 - 1, n / 2 % 2 * 2.0 - 1, n / 4 * 2.0 - 1};
    world.grains.push_back(moving(Vec3{5, 0, -7} + Vec3{0.1 * s[0], 0.2 * s[1], 0.3 * s[2]}, {}));
  }
  step(*sensor, world);
  // (0.01 + 0.04 + 0.09) / 3; the difference of 74 and its like leaves 1e-14 of 74.
  CHECK(series_of(*sensor)["granular_temperature"] == approx(0.14 / 3).epsilon(1e-11));
}

TEST_CASE("grains shall count as settled from the last time they became slow") {
  const auto sensor = load_sensor("kinetic_energy").make({{"settled_below", 1e-9}});
  SyntheticScene world;
  world.interval = 0.1;
  for (const double v : {1.0, 0.01, 0.1, 0.01, 0.01}) {  // 5e-11 J and 5e-9 J
    world.grains = {moving({v, 0, 0}, {})};
    step(*sensor, world);
  }
  const auto none = load_sensor("kinetic_energy").make({});
  SyntheticScene empty;
  step(*none, empty);
  CHECK(summary_of(*none)["translation"] == 0.0);
  CHECK(is_of_nothing(summary_of(*none).at("mean_per_grain")));
  CHECK(is_of_nothing(summary_of(*none).at("settled_at")));
  CHECK(summary_of(*sensor)["is_settled"] == 1.0);
  CHECK(summary_of(*sensor)["settled_at"] == approx(0.4).epsilon(1e-14));
}
