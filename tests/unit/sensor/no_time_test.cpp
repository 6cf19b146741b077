// SPDX-License-Identifier: Apache-2.0
// Means over no time: a run that ended before they began.
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

using dust::sdk::Value;
using dust::sdk::Vec3;
using namespace dust::test;

TEST_CASE("means over no time shall be no number") {
  const Value low = Vec3{0, 0, 0};
  const Value high = Vec3{0.1, 0.1, 0.1};
  struct Case {
    std::string sensor;
    std::map<std::string, Value> parameters;
    std::vector<std::string> means;
  };
  const std::vector<Case> cases{
      {"probe",
       {{"from", low}, {"to", high}, {"count", std::int64_t{2}}},
       {"place_1/velocity_x", "place_2/pressure"}},
      {"vorticity", {}, {"mean_x", "mean_y", "mean_z"}},
      {"wear",
       {{"min", low}, {"max", high}, {"cell", 0.01}, {"coefficient", 1e-3}, {"hardness", 4e9}},
       {"depth_rate_largest/value", "pressure_largest/value"}},
      {"blockage",
       {{"min", low}, {"max", high}, {"largest_mass", 1e-6}, {"largest_growth", 1e-9}},
       {"mass_held", "inflow", "outflow"}},
      {"bubbles", {{"min", low}, {"max", high}, {"threshold", 0.9}}, {"number", "volume_share"}},
      {"stress", {{"min", low}, {"max", high}}, {"xx", "yz", "pressure", "bulk_density"}},
      {"spillage", {{"min", low}, {"max", Vec3{0.1, 0.1, 0.0}}}, {"rate", "grams_per_tonne"}},
      {"residence_time", {{"min", low}, {"max", high}}, {"mass_inside", "mass_flow_out"}},
      {"wall_load",
       {{"walls", std::vector<std::string>{"belt"}}},
       {"force", "force_x", "impact_rate"}},
  };
  for (const Case& one : cases) {
    CAPTURE(one.sensor);
    const auto sensor = load_sensor(one.sensor).make(one.parameters);
    const Figures figures = summary_of(*sensor);
    for (const std::string& name : one.means) {
      CAPTURE(name);
      CHECK(std::isnan(figures[name]));
    }
  }
}

TEST_CASE("the number of impacts shall scatter as what stands for many comes at a time") {
  const auto sensor = load_sensor("wall_load").make({{"walls", std::vector<std::string>{"belt"}}});
  SyntheticScene world;
  world.walls.push_back({.name = "belt"});
  for (int n = 0; n < 9; ++n) {
    world.impacts.push_back({.wall = 0, .normal_energy = 1e-6, .weight = 1000.0});
  }
  step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["impacts"] == 9000.0);
  CHECK(figures.at("impacts").uncertainty == dust::test::approx(3000.0));
}

TEST_CASE("the main figure of a load on walls shall be the magnitude of its mean, with its error") {
  const auto sensor = load_sensor("wall_load").make({{"walls", std::vector<std::string>{"belt"}}});
  SyntheticScene world;
  world.walls.push_back({.name = "belt"});
  Dice dice(1);
  for (int s = 0; s < 1024; ++s) {
    world.walls.back().force = {3.0 + 0.1 * dice.normal(), 0.0, -4.0 + 0.1 * dice.normal()};
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["force"] == approx(std::hypot(figures["force_x"], figures["force_z"])));
  // 0.1 N over the root of 1024, in any direction; half of all series seem to remember, by chance.
  const double error = 0.1 / 32.0;
  CHECK(figures.at("force").uncertainty > 0.6 * error);
  CHECK(figures.at("force").uncertainty < 1.8 * error);
  CHECK(figures.at("force").towards == "overview");
  CHECK(figures.at("force_z").towards.empty());
}
