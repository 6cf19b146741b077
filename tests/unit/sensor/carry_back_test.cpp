// SPDX-License-Identifier: Apache-2.0
#include "unit/sensor/coverage.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

const SensorKind& kind() {
  static const SensorKind loaded = load_sensor("carry_back");
  return loaded;
}

const std::map<std::string, sdk::Value> k_layer = {
    {"min", Vec3{0, 0, 0.112}}, {"max", Vec3{0.08, 0.011, 0.116}}, {"faster_than", 0.1}};

Grain riding(Vec3 place, Vec3 velocity) {
  Grain g;
  g.before = g.now = place;
  g.velocity = velocity;
  g.diameter = 10e-6;
  g.mass = 1e-12;
  return g;
}

}  // namespace

TEST_CASE("evenly spaced riders shall carry spacing, mass and speed back exactly") {
  const auto sensor = kind().make(k_layer);
  SyntheticScene world;
  // One grain of 1e-12 kg per millimetre at 0.8 m/s: 800 grains/s.
  for (int i = 0; i < 80; ++i) {
    world.grains.push_back(riding({0.001 * (i + 0.5), 0.005, 0.115}, {-0.8, 0, 0}));
  }
  for (int s = 0; s < 20; ++s) {
    world.emitted_mass += 6e-6;
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["number_flow"] == test::approx(800.0).epsilon(1e-12));
  CHECK(figures["mass_flow"] == test::approx(800e-12).epsilon(1e-12));
  CHECK(figures["mean_number"] == test::approx(80.0).epsilon(1e-12));
  CHECK(figures["class_10_um/mass_flow"] == test::approx(800e-12).epsilon(1e-12));
  CHECK(figures["class_300_um/mass_flow"] == 0.0);
  // 6 g/s emitted.
  CHECK(figures["grams_per_tonne"] == test::approx(1e6 * 800e-12 / 6e-3).epsilon(1e-9));
}

TEST_CASE("what is carried back after the feed has ended shall have no amount per tonne") {
  auto parameters = k_layer;
  parameters["steady_after"] = 0.01;
  const auto sensor = kind().make(parameters);
  SyntheticScene world;
  world.grains = {riding({0.04, 0.005, 0.115}, {-0.8, 0, 0})};
  for (int s = 0; s < 40; ++s) {
    if (s < 5) world.emitted_mass += 6e-6;
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["mass_flow"] > 0.0);
  CHECK(std::isnan(figures["grams_per_tonne"]));
  CHECK(figures.at("grams_per_tonne").uncertainty == sdk::k_feed_not_even);
}

TEST_CASE("grains that do not ride shall not count") {
  const auto sensor = kind().make(k_layer);
  SyntheticScene world;
  world.grains = {riding({0.04, 0.005, 0.115}, {0, 0, 0}),      // at rest
                  riding({0.04, 0.005, 0.115}, {0.8, 0, 0}),    // forward
                  riding({0.04, 0.005, 0.115}, {-0.05, 0, 0}),  // drifts
                  riding({0.04, 0.005, 0.115}, {0, 0, -2}),     // falls
                  riding({0.04, 0.005, 0.120}, {-0.8, 0, 0}),   // above the layer
                  riding({0.10, 0.005, 0.115}, {-0.8, 0, 0})};  // beside it
  step(*sensor, world);
  CHECK(series_of(*sensor)["mass_flow"] == 0.0);
  CHECK(series_of(*sensor)["mass"] == 0.0);
}

TEST_CASE("emission before the steady part shall not dilute what is carried back") {
  auto parameters = k_layer;
  parameters["steady_after"] = 0.01;
  const auto sensor = kind().make(parameters);
  SyntheticScene world;
  world.grains = {riding({0.04, 0.005, 0.115}, {-0.8, 0, 0})};
  world.emitted_mass = 1.0;
  for (int s = 0; s < 20; ++s) {
    world.emitted_mass += 1e-6;
    step(*sensor, world);
  }
  const double carried = 1e-12 * 0.8 / 0.08 * 0.01;
  CHECK(summary_of(*sensor)["grams_per_tonne"] ==
        test::approx(1e6 * carried / 10e-6).epsilon(1e-6));
}

TEST_CASE("a direction between the axes shall be refused") {
  auto parameters = k_layer;
  parameters["direction"] = Vec3{1, 0, 1};
  CHECK_THROWS_AS((void)kind().make(parameters), sdk::ParameterError);
}
