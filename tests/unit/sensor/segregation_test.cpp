// SPDX-License-Identifier: Apache-2.0
#include "sensor/segregation/segregation.hpp"

#include "support/approx.hpp"
#include "support/sensor_bench.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Vec3;

namespace {

const std::map<std::string, dust::sdk::Value> k_box{{"split", 400e-6},
                                                    {"min", Vec3{0, 0, 0}},
                                                    {"max", Vec3{0.1, 0.01, 0.1}},
                                                    {"cells", Vec3{10, 1, 10}}};

Grain at(Vec3 place, bool is_fine) {
  Grain g;
  g.now = g.before = place;
  g.diameter = is_fine ? 300e-6 : 600e-6;
  return g;
}

}  // namespace

TEST_CASE("separate layers shall have the index 0 and their distance, even mixtures at least 1") {
  SyntheticScene layers;
  SyntheticScene even;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 place{0.1 * ((n % 20) + 0.5) / 20, 0.005, 0.1 * ((n / 20 % 200) + 0.5) / 200};
    layers.grains.push_back(at(place, place.z < 0.05));
    even.grains.push_back(at(place, (n + n / 20) % 2 == 0));
  }
  const auto apart = load_sensor("segregation").make(k_box);
  step(*apart, layers);
  CHECK(series_of(*apart)["mixing_index"] == approx(0.0).scale(1.0).epsilon(1e-12));
  CHECK(series_of(*apart)["centre_shift"] == approx(-0.05).epsilon(1e-9));
  CHECK(series_of(*apart)["fine_number_fraction"] == approx(0.5).epsilon(1e-12));
  // Every cell holds exactly half of each: no variance, better than random.
  const auto mixed = load_sensor("segregation").make(k_box);
  step(*mixed, even);
  const double all = 4000.0;
  CHECK(series_of(*mixed)["mixing_index"] == approx(1.0 / (1.0 - 99.0 / all)).epsilon(1e-9));
}

TEST_CASE("one kind of grains alone shall have no index and no shift, and nothing no share") {
  SyntheticScene world;
  const auto sensor = load_sensor("segregation").make(k_box);
  step(*sensor, world);
  CHECK(is_of_nothing(series_of(*sensor).at("fine_number_fraction")));
  for (int n = 0; n < 400; ++n)
    world.grains.push_back(at({0.1 * (n + 0.5) / 400, 0.005, 0.05}, true));
  step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(is_of_nothing(figures.at("mixing_index")));
  CHECK(is_of_nothing(figures.at("centre_shift")));
  CHECK(figures["fine_number_fraction"] == 1.0);
}

TEST_CASE("the index of random mixtures shall be 1 on average") {
  double mean = 0.0;
  constexpr int k_mixtures = 60;
  for (int run = 0; run < k_mixtures; ++run) {
    Dice dice(run);
    SyntheticScene world;
    for (int n = 0; n < 1000; ++n) {
      const Vec3 place{0.1 * dice.uniform(), 0.01 * dice.uniform(), 0.1 * dice.uniform()};
      world.grains.push_back(at(place, dice.uniform() < 0.3));
    }
    const auto sensor = load_sensor("segregation").make(k_box);
    step(*sensor, world);
    mean += series_of(*sensor)["mixing_index"] / k_mixtures;
  }
  // sigma^2 scatters by sqrt(2/99) of sigma_r^2 = 0.1 sigma_0^2: 0.016 per mixture, 0.002 in 60.
  CHECK(mean == approx(1.0).epsilon(0.008));
}
