// SPDX-License-Identifier: Apache-2.0
#include "sensor/size_distribution/size_distribution.hpp"

#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Vec3;
namespace formula = dust::model::size_distribution;

TEST_CASE("shares by number and mass and the Sauter diameter shall be those of the grains there") {
  const auto sensor = load_sensor("size_distribution")
                          .make({{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.1, 0.011, 0.35}}});
  SyntheticScene world;
  const auto add = [&](int count, double d, double x, double weight = 1.0) {
    for (int n = 0; n < count; ++n) {
      Grain g;
      g.now = {x, 0.005, 0.1};
      g.diameter = d;
      g.mass = 1e3 * d * d * d;
      g.weight = weight;
      world.grains.push_back(g);
    }
  };
  add(30, 300e-6, 0.05);
  add(10, 600e-6, 0.05);
  add(20, 10e-6, 0.05, 0.5);
  add(50, 600e-6, 0.2);  // outside
  step(*sensor, world);
  const Figures f = summary_of(*sensor);
  CHECK(f["class_300_um/number_fraction"] == approx(0.6).epsilon(1e-12));
  CHECK(f["class_10_um/number_fraction"] == approx(0.2).epsilon(1e-12));
  const double cubes = 30 * 27.0 + 10 * 216.0 + 10 * 1e-3;
  CHECK(f["class_600_um/mass_fraction"] == approx(2160.0 / cubes).epsilon(1e-12));
  const double squares = 30 * 9.0 + 10 * 36.0 + 10 * 1e-2;
  CHECK(f["sauter_diameter"] == approx(100e-6 * cubes / squares).epsilon(1e-9));
}

TEST_CASE("no grains shall have no sizes") {
  const auto sensor = load_sensor("size_distribution").make({});
  SyntheticScene world;
  step(*sensor, world);
  CHECK(is_of_nothing(summary_of(*sensor).at("sauter_diameter")));
  CHECK(is_of_nothing(series_of(*sensor).at("d_50")));
}

TEST_CASE("quantiles shall be those of the sum interpolated between the classes") {
  const double d[] = {1.0, 2.0, 3.0};
  const double a[] = {1.0, 2.0, 1.0};  // sums at the classes: 1/8, 1/2, 7/8
  CHECK(formula::quantile(d, a, 0.5) == approx(2.0).epsilon(1e-14));
  CHECK(formula::quantile(d, a, 0.3125) == approx(1.5).epsilon(1e-14));
  CHECK(formula::quantile(d, a, 0.05) == 1.0);
  CHECK(formula::quantile(d, a, 0.99) == 3.0);
}
