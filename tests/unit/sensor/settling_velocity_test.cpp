// SPDX-License-Identifier: Apache-2.0
// A fall whose answer is known.
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

/// Two grains that fall from 50 mm side by side with 2 m/s2, until they hold a speed of 0.2 m/s.
void fall(SyntheticScene& world, sdk::Sensor& sensor, double end, Vec3 down = {0, 0, -1}) {
  while (world.time < end - 1e-9) {
    const double t = world.time + world.interval;
    const double speed = std::min(2.0 * t, 0.2);
    const double way = t < 0.1 ? t * t : 0.01 + 0.2 * (t - 0.1);
    world.grains.clear();
    for (const double x : {0.01, 0.03}) {
      Grain g;
      g.now = Vec3{x, 0.005, 0.05} + way * down;
      g.before = g.now;
      g.velocity = speed * down;
      g.weight = x < 0.02 ? 3.0 : 1.0;
      world.grains.push_back(g);
    }
    step(sensor, world);
  }
}
// Places between samples are linear: curvature times interval squared.
constexpr double k_linear = 1e-4;

}  // namespace

TEST_CASE("settling_velocity shall time levels and take means above the floor only") {
  SyntheticScene world;
  const auto sensor = load_sensor("settling_velocity")
                          .make({{"levels", std::vector<double>{0.045, 0.03, 0.001}},
                                 {"steady_after", 0.1},
                                 {"until", 0.02}});
  fall(world, *sensor, 0.25);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["velocity"] == test::approx(0.2).epsilon(1e-9));
  CHECK(figures["largest/velocity"] == test::approx(0.2).epsilon(1e-9));
  CHECK(figures["largest/time"] == test::approx(0.1).epsilon(0.011));  // a sample
  CHECK(figures["level_45_mm/time"] == test::approx(std::sqrt(0.005)).epsilon(k_linear));
  CHECK(figures["level_45_mm/velocity"] ==
        test::approx(2 * std::sqrt(0.005)).epsilon(10 * k_linear));
  CHECK(figures["level_30_mm/time"] == test::approx(0.15).epsilon(k_linear));
  CHECK(is_of_nothing(figures.at("level_1_mm/time")));  // not passed
  CHECK(is_of_nothing(figures.at("level_1_mm/velocity")));
  CHECK(figures["height_at_end"] == test::approx(0.01).epsilon(k_linear));
}

TEST_CASE("settling_velocity shall not take a bounce for settling") {
  SyntheticScene world;
  const auto sensor = load_sensor("settling_velocity").make({{"until", 0.01}});
  for (const double height : {0.03, 0.02, 0.005, 0.015}) {  // down, and up again
    world.grains.assign(1, {});
    world.grains[0].now = world.grains[0].before = {0, 0, height};
    world.grains[0].velocity = {0, 0, height > 0.012 && height < 0.018 ? 0.5 : -0.2};
    step(*sensor, world);
  }
  CHECK(summary_of(*sensor)["velocity"] == test::approx(0.2));
}

TEST_CASE("settling_velocity without an end of its means shall take them below its base as well") {
  // The base above the grains, as one that is not given where the domain lies below the origin.
  const auto mean_with = [](const std::map<std::string, sdk::Value>& until) {
    auto values = until;
    values["base"] = Vec3{0, 0, 0.1};
    values["steady_after"] = 0.1;
    SyntheticScene world;
    const auto sensor = load_sensor("settling_velocity").make(values);
    fall(world, *sensor, 0.25);
    CHECK(series_of(*sensor)["height"] == test::approx(-0.09).epsilon(k_linear));
    return summary_of(*sensor)["velocity"];
  };
  CHECK(mean_with({}) == test::approx(0.2).epsilon(1e-9));
  CHECK(mean_with({{"until", 0.0}}) == test::approx(0.2).epsilon(1e-9));
}

TEST_CASE("settling_velocity shall follow its direction and begin anew with the grains") {
  SyntheticScene world;
  world.gravity = {0, 0, 0};
  const auto sensor = load_sensor("settling_velocity")
                          .make({{"direction", Vec3{2, 0, 0}},
                                 {"base", Vec3{0.1, 0, 0}},
                                 {"levels", std::vector<double>{0.075}}});
  step(*sensor, world);  // nobody there
  CHECK(is_of_nothing(series_of(*sensor).at("velocity")));
  CHECK(is_of_nothing(summary_of(*sensor).at("velocity")));
  fall(world, *sensor, 0.1, {1, 0, 0});
  // Centre of mass at x = 0.015 first: 0.085 m before the base.
  CHECK(series_of(*sensor)["height"] == test::approx(0.085 - 0.01).epsilon(1e-6));
  CHECK(series_of(*sensor)["velocity"] == test::approx(0.2).epsilon(1e-9));
  const auto lost = load_sensor("settling_velocity").make({});
  world.grains.resize(1);
  CHECK_THROWS(step(*lost, world));  // no gravity, no direction
}
