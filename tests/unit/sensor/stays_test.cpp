// SPDX-License-Identifier: Apache-2.0
// Sensors of grains that come into a box and leave it: residence time and blockage.
#include "unit/sensor/coverage.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/stays.hpp"
#include "sensor/blockage/blockage.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

constexpr double k_class_width = 0.011;  ///< of the classes that quantiles come from
const Vec3 k_min{0.1, 0.0, 0.0};
const Vec3 k_max{0.2, 0.011, 0.35};

Grain at(Vec3 place, Vec3 velocity, double mass) {
  Grain g;
  g.before = g.now = place;
  g.velocity = velocity;
  g.mass = mass;
  return g;
}

void move_on(SyntheticScene& world) {
  for (Grain& g : world.grains) {
    g.before = g.now;
    g.now = g.now + world.interval * g.velocity;
  }
}

/// 200 grains of 2 g in a row along x, 3.7 mm apart, that run at 2 m/s through the box.
SyntheticScene row_of_grains() {
  SyntheticScene world;
  for (int n = 0; n < 200; ++n) {
    world.grains.push_back(at({0.0963 - 3.7e-3 * n, 0.005, 0.1}, {2.0, 0, 0}, 2e-3));
  }
  return world;
}

}  // namespace

TEST_CASE("the part of a path in a box shall be cut by its faces") {
  const auto part = [](Vec3 before, Vec3 now) {
    return sdk::part_in_box({before, now}, {0, 0, 0}, {1, 1, 1});
  };
  CHECK(part({-1, 0.5, 0.5}, {3, 0.5, 0.5}).from == test::approx(0.25));
  CHECK(part({-1, 0.5, 0.5}, {3, 0.5, 0.5}).to == test::approx(0.5));
  CHECK(part({0.5, 0.5, 0.5}, {0.5, 0.5, 2.5}).from == 0.0);
  CHECK(part({0.5, 0.5, 0.5}, {0.5, 0.5, 2.5}).to == test::approx(0.25));
  CHECK(part({-1, 1.5, 0.5}, {3, 1.5, 0.5}).is_none());
  CHECK(part({-1, 0.5, 0.5}, {-0.5, 0.5, 0.5}).is_none());
  // Past a corner: inside in x until 0.5, in y from 0.6 on.
  CHECK(part({0.5, -0.6, 0.5}, {1.5, 0.4, 0.5}).is_none());
  CHECK(part({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}).from == 0.0);
  CHECK(part({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}).to == 1.0);
}

TEST_CASE("in plug flow every grain shall stay the length over the speed") {
  const auto sensor = load_sensor("residence_time").make({{"min", k_min}, {"max", k_max}});
  SyntheticScene world = row_of_grains();
  for (int s = 0; s < 600; ++s) {
    move_on(world);
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  // Places fall between the samples, 2 mm apart: only straight paths between them give 50 ms.
  CHECK(figures["mean"] == test::approx(0.05).epsilon(1e-9));
  CHECK(figures["standard_deviation"] < 1e-8);
  CHECK(figures["grains"] == 200.0);
  for (const char* name : {"fastest_5_percent", "median", "percent_95"}) {
    CHECK(figures[name] == test::approx(0.05).epsilon(k_class_width));
  }
  CHECK(figures["longest_inside"] == 0.0);
  CHECK(figures["mass_flow_out"] == test::approx(200 * 2e-3 / 0.6).epsilon(1e-9));
  // All came and went while it was looked at; samples of 1 ms see 50 ms to half a sample.
  CHECK(figures["holdup_over_flow"] == test::approx(0.05).epsilon(0.02));
}

TEST_CASE(
    "grains that are in the box when a sensor begins shall not have come in, nor have an age") {
  SyntheticScene world = row_of_grains();
  for (int s = 0; s < 100; ++s) move_on(world);  // the row has come, its head is past the box
  const auto held = static_cast<double>(
      std::count_if(world.grains.begin(), world.grains.end(),
                    [](const Grain& g) { return g.now.x >= k_min.x && g.now.x < k_max.x; }));
  REQUIRE(held > 20.0);
  std::map<std::string, sdk::Value> from_birth{{"min", k_min}, {"max", k_max}};
  from_birth["from"] = std::string("birth");
  const auto times = load_sensor("residence_time").make({{"min", k_min}, {"max", k_max}});
  const auto ages = load_sensor("residence_time").make(from_birth);
  const auto region = load_sensor("blockage").make({{"min", k_min}, {"max", k_max}});
  for (auto* sensor : {times.get(), ages.get(), region.get()}) begin(*sensor, world);
  for (int s = 0; s < 100; ++s) {
    move_on(world);
    for (auto* sensor : {times.get(), ages.get(), region.get()}) {
      SyntheticScene same = world;
      step(*sensor, same);
    }
    world.time += world.interval;
  }
  CHECK(summary_of(*times)["mean"] == test::approx(0.05).epsilon(1e-9));
  // All are older than the sensor: of none it is known when it was born.
  CHECK(is_of_nothing(summary_of(*ages).at("mean")));
  const Figures flows = summary_of(*region);
  // 0.2 m of the row have come and gone, to a grain of 2 g.
  CHECK(std::abs(0.1 * flows["inflow"] - 2e-3 * 0.2 / 3.7e-3) < 2e-3);
  CHECK(std::abs(0.1 * flows["outflow"] - 2e-3 * 0.2 / 3.7e-3) < 2e-3);
}

TEST_CASE("a box that nothing has left yet shall have no residence time") {
  const auto sensor = load_sensor("residence_time").make({{"min", k_min}, {"max", k_max}});
  SyntheticScene world;
  world.grains.push_back(at({0.15, 0.005, 0.1}, {0, 0, 0}, 1e-3));
  for (int s = 0; s < 30; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  for (const char* name : {"mean", "standard_deviation", "fastest_5_percent", "median",
                           "percent_95", "holdup_over_flow"}) {
    CAPTURE(name);
    CHECK(is_of_nothing(figures.at(name)));
  }
  CHECK(figures["mass_flow_out"] == 0.0);
  CHECK(figures["grains"] == 0.0);
}

TEST_CASE("an ideally mixed vessel shall have exponential residence times") {
  const auto sensor = load_sensor("residence_time").make({{"min", k_min}, {"max", k_max}});
  constexpr double k_tau = 0.02;
  constexpr int k_grains = 4000;
  SyntheticScene world;
  Dice dice(3);
  std::vector<double> leaves;
  for (int n = 0; n < k_grains; ++n) {
    world.grains.push_back(at({0.15, 0.005, 0.1}, {0, 0, 0}, 1e-3));
    leaves.push_back(-k_tau * std::log(dice.uniform()));
  }
  // A grain that is to leave within an interval does so at that moment: half a box further.
  for (int s = 0; s < 400; ++s) {
    for (int n = 0; n < k_grains; ++n) {
      Grain& g = world.grains[static_cast<std::size_t>(n)];
      g.before = g.now;
      const double share = leaves[static_cast<std::size_t>(n)] / world.interval - s;
      if (share < 0.0 || share >= 1.0 || g.now.x > 0.2) continue;
      g.before.x = 0.2 - 0.05 * share;  // meets the face after `share` of the way
      g.now = {0.2 + 0.05 * (1.0 - share), 0.005, 0.1};
    }
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["grains"] > k_grains - 5.0);
  const auto agrees = [&](const char* name, double truth) {
    const Figure& f = figures.at(name);
    CAPTURE(name);
    CHECK(f.uncertainty > 0.0);
    CHECK(f.uncertainty < 0.1 * truth);
    CHECK(std::abs(f.value - truth) < 3.0 * f.uncertainty + 0.5 * k_class_width * truth);
  };
  agrees("mean", k_tau);
  agrees("median", k_tau * std::log(2.0));
  agrees("percent_95", k_tau * std::log(20.0));
  agrees("fastest_5_percent", -k_tau * std::log(0.95));
  CHECK(figures["standard_deviation"] == test::approx(k_tau).epsilon(0.06));
}

TEST_CASE("a time from birth shall hold the way to the box as well") {
  // Born at x = 0.05 within the first interval, 2 m/s: 25 ms to the box, 50 ms through it.
  const auto run = [](const std::string& from, bool has_box) {
    std::map<std::string, sdk::Value> values = {{"from", from}};
    if (has_box) {
      values["min"] = k_min;
      values["max"] = k_max;
    }
    const auto sensor = load_sensor("residence_time").make(values);
    SyntheticScene world;
    world.grains = {at({0.05, 0.005, 0.1}, {2, 0, 0}, 1e-3)};
    for (int s = 0; s < 120; ++s) {
      move_on(world);
      if (s == 110) world.grains.clear();  // it leaves the domain within this interval
      step(*sensor, world);
    }
    return summary_of(*sensor)["mean"];
  };
  CHECK(run("entering", true) == test::approx(0.05).epsilon(1e-9));
  CHECK(run("birth", true) == test::approx(0.075).epsilon(1e-9));
  CHECK(run("entering", false) == test::approx(0.1105).epsilon(1e-9));
}

TEST_CASE("in the whole domain a time shall end where a grain crosses an open side") {
  SyntheticScene world;
  // Dust that is pressed into the bottom with its centre now and then comes back out of it.
  world.grains.push_back(at({0.1, 0.005, 1e-4}, {}, 2e-3));
  world.grains.push_back(at({0.0507, 0.005, 0.1}, {2.0, 0, 0}, 1e-3));
  auto sensor = load_sensor("residence_time").make({});
  for (int s = 0; s < 200; ++s) {
    // What is beyond a side at the end of a step is gone before the next one.
    const bool is_leaving = world.grains.back().now.x > world.domain_max.x;
    if (is_leaving) world.grains.pop_back();
    move_on(world);
    world.grains.front().now.z = s % 3 == 0 ? -1e-5 : 1e-4;
    if (is_leaving) {
      MemoryArchive archive;
      sensor->save(archive);
      sensor = load_sensor("residence_time").make({});
      sensor->load(archive);
    }
    step(*sensor, world);
    const bool is_inside = world.grains.size() > 1 && world.grains.back().now.x < 0.33;
    if (s % 3 != 0) CHECK(series_of(*sensor)["mass_inside"] == (is_inside ? 3e-3 : 2e-3));
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["grains"] == 1.0);
  CHECK(figures["mean"] == test::approx((0.33 - 0.0507) / 2.0).epsilon(1e-9));
  CHECK(figures["longest_inside"] == test::approx(0.2).epsilon(1e-9));
}

TEST_CASE("what left before the means begin shall not count, what is still inside shall be told") {
  const auto sensor =
      load_sensor("residence_time").make({{"min", k_min}, {"max", k_max}, {"steady_after", 0.2}});
  SyntheticScene world = row_of_grains();
  world.grains.push_back(at({0.15, 0.005, 0.3}, {0, 0, 0}, 1.0));  // stays
  for (int s = 0; s < 600; ++s) {
    move_on(world);
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  // The first is at the far face after (0.2 - 0.0963) / 2 s, one more every 1.85 ms.
  const double before = std::floor((0.2 - 0.10370 / 2.0) / 1.85e-3) + 1.0;
  CHECK(figures["grains"] == 200.0 - before);
  CHECK(figures["longest_inside"] == test::approx(0.6).epsilon(1e-9));
  CHECK(figures["mean"] == test::approx(0.05).epsilon(1e-9));
  CHECK(figures["holdup_over_flow"] > 10.0 * figures["mean"]);  // 1 kg that never leaves
}

TEST_CASE("a region that keeps every fourth grain shall be told to fill by a quarter") {
  const auto sensor =
      load_sensor("blockage")
          .make({{"min", k_min}, {"max", k_max}, {"largest_mass", 0.1}, {"steady_after", 0.1}});
  SyntheticScene world;
  for (int n = 0; n < 1200; ++n) {
    world.grains.push_back(at({0.0995 - 1e-3 * n, 0.005, 0.1}, {2.0, 0, 0}, 1e-3));
  }
  std::vector<double> above_limit;
  for (int s = 0; s < 500; ++s) {
    move_on(world);
    double held = 0.0;
    for (std::size_t n = 0; n < world.grains.size(); ++n) {
      Grain& g = world.grains[n];
      if (n % 4 == 0 && g.now.x > 0.15) g.velocity = {};
      if (g.now.x >= 0.1 && g.now.x < 0.2) held += g.mass;
    }
    step(*sensor, world);
    if (held > 0.1) above_limit.push_back(world.time);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["inflow"] == test::approx(2.0).epsilon(1e-9));  // 2 grains of 1 g per ms
  CHECK(figures["outflow"] == test::approx(1.5).epsilon(0.01));
  CHECK(figures["growth"] == test::approx(0.5).epsilon(0.01));
  CHECK(figures["growth_over_inflow"] == test::approx(0.25).epsilon(0.01));
  CHECK(figures["is_filling"] == 1.0);
  REQUIRE(!above_limit.empty());
  CHECK(figures["first_beyond_largest_mass"] == test::approx(above_limit.front()).epsilon(1e-12));
  CHECK(figures["time_beyond_largest_mass"] ==
        test::approx(1e-3 * static_cast<double>(above_limit.size())).epsilon(1e-9));
  // The grains come and go in groups of four.
  CHECK(figures["mass_held_at_end"] > figures["mass_held_largest"] - 4e-3);
}

TEST_CASE("a region that lets all pass shall not be told to fill") {
  const auto sensor =
      load_sensor("blockage").make({{"min", k_min}, {"max", k_max}, {"steady_after", 0.1}});
  SyntheticScene world;
  for (int n = 0; n < 1200; ++n) {
    world.grains.push_back(at({0.0995 - 1e-3 * n, 0.005, 0.1}, {2.0, 0, 0}, 1e-3));
  }
  for (int s = 0; s < 500; ++s) {
    move_on(world);
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["inflow"] == test::approx(figures["outflow"]).epsilon(1e-9));
  CHECK(std::abs(figures["growth"]) < 1e-6);
  CHECK(figures["is_filling"] == 0.0);
  CHECK(is_of_nothing(figures.at("first_beyond_largest_mass")));
}

TEST_CASE("the error of a trend shall cover the truth as often as it says") {
  constexpr double k_slope = 0.7;
  Coverage coverage;
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    std::vector<double> t(400);
    std::iota(t.begin(), t.end(), 0.0);
    std::vector<double> y;
    double memory = 0.0;  // noise that lasts a few samples, a tenth of a block
    for (const double time : t) {
      memory = 0.5 * memory + dice.normal();
      y.push_back(5.0 + k_slope * time + 20.0 * memory);
    }
    const auto trend = model::blockage::trend(t, y, 0.0);
    coverage.add({.value = trend.slope, .uncertainty = trend.error}, k_slope);
  }
  CHECK(coverage.without_error == 0);
  CHECK(coverage.one() > k_one_low);
  CHECK(coverage.one() < k_one_high);
  CHECK(coverage.two() > k_two_low);
}

TEST_CASE("a trend shall look at nothing before it begins") {
  std::vector<double> t(100);
  std::iota(t.begin(), t.end(), 0.0);
  std::vector<double> y(t);
  for (std::size_t n = 0; n < 50; ++n) y[n] = 1000.0;
  CHECK(model::blockage::trend(t, y, 50.0).slope == test::approx(1.0).epsilon(1e-12));
  CHECK(model::blockage::trend(t, y, 99.0).error < 0.0);
}
