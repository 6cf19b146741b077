// SPDX-License-Identifier: Apache-2.0
// What an engineer asks of a transfer point: load, stream, spillage, wear.
#include "unit/sensor/coverage.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

Grain at(Vec3 place, Vec3 velocity, double mass = 1e-6) {
  Grain g;
  g.before = g.now = place;
  g.velocity = velocity;
  g.mass = mass;
  return g;
}

/// A world in which a grain goes by `interval` x velocity from sample to sample.
void move_on(SyntheticScene& world) {
  for (Grain& g : world.grains) {
    g.before = g.now;
    g.now = g.now + world.interval * g.velocity;
  }
}

}  // namespace

TEST_CASE("a strip beside the middle of a belt shall be off centre by what it lies aside") {
  // A belt towards (0.6, 0.8), 2 m/s; grains every 10 mm along it, 30 and 50 mm to the left.
  const Vec3 along{0.6, 0.8, 0.0};
  const Vec3 left{-0.8, 0.6, 0.0};
  const auto sensor = load_sensor("belt_load")
                          .make({{"point", Vec3{0.1, 0.1, 0.1}},
                                 {"direction", along},
                                 {"length", 0.5},
                                 {"width", 0.4},
                                 {"height", 0.1},
                                 {"belt_speed", 2.5}});
  SyntheticScene world;
  for (int n = 0; n < 50; ++n) {
    for (const double aside : {0.03, 0.05}) {
      world.grains.push_back(
          at(Vec3{0.1, 0.1, 0.12} + (0.01 * (n + 0.5)) * along + aside * left, 2.0 * along, 0.02));
    }
  }
  // Beside the belt, above its load, before and after the stretch.
  for (const Vec3 off : {0.25 * left, Vec3{0, 0, 0.11}, -0.3 * along, 0.3 * along}) {
    world.grains.push_back(at(Vec3{0.1, 0.1, 0.11} + 0.25 * along + off, 2.0 * along, 5.0));
  }
  for (int s = 0; s < 10; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["mass_per_length"] == test::approx(100 * 0.02 / 0.5).epsilon(1e-12));
  CHECK(figures["mass_flow"] == test::approx(100 * 0.02 / 0.5 * 2.0).epsilon(1e-12));
  CHECK(figures["off_centre"] == test::approx(0.04).epsilon(1e-12));
  CHECK(figures["half_width"] == test::approx(0.01 * std::sqrt(3.0)).epsilon(1e-9));
  CHECK(figures["speed"] == test::approx(2.0).epsilon(1e-12));
  CHECK(figures["speed_over_belt_speed"] == test::approx(0.8).epsilon(1e-12));
}

TEST_CASE("a belt without load and an opening that nothing passes shall have no place and speed") {
  const auto belt = load_sensor("belt_load")
                        .make({{"point", Vec3{0, 0, 0}},
                               {"direction", Vec3{1, 0, 0}},
                               {"length", 1.0},
                               {"width", 1.0},
                               {"height", 0.1},
                               {"belt_speed", 2.0}});
  const auto opening = load_sensor("stream_section")
                           .make({{"point", Vec3{0, 0, 0.1}},
                                  {"normal", Vec3{0, 0, -1}},
                                  {"min", Vec3{0, 0, 0.1}},
                                  {"max", Vec3{0.33, 0.011, 0.1}},
                                  {"bulk_density", 1600.0},
                                  {"belt_velocity", Vec3{3.0, 0, 0}}});
  SyntheticScene world;
  for (int s = 0; s < 10; ++s) {
    step(*belt, world);
    step(*opening, world);
  }
  const Figures load = summary_of(*belt);
  CHECK(load["mass_per_length"] == 0.0);
  for (const char* name : {"off_centre", "half_width", "speed", "speed_over_belt_speed"}) {
    CAPTURE(name);
    CHECK(is_of_nothing(load.at(name)));
  }
  CHECK(is_of_nothing(series_of(*belt).at("speed")));
  const Figures stream = summary_of(*opening);
  CHECK(stream["mass_flow"] == 0.0);
  for (const char* name : {"velocity_x", "speed", "angle", "fill_ratio", "impact_pressure",
                           "speed_along_belt", "speed_along_belt_over_belt_speed"}) {
    CAPTURE(name);
    CHECK(is_of_nothing(stream.at(name)));
  }
}

TEST_CASE("samples without load shall not pull the place of the load to the middle") {
  const auto sensor = load_sensor("belt_load")
                          .make({{"point", Vec3{0, 0, 0}},
                                 {"direction", Vec3{1, 0, 0}},
                                 {"length", 1.0},
                                 {"width", 1.0},
                                 {"height", 0.1}});
  SyntheticScene world;
  for (int s = 0; s < 10; ++s) step(*sensor, world);
  world.grains = {at({0.5, 0.2, 0.05}, {1, 0, 0}, 3.0)};
  for (int s = 0; s < 10; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["mass_per_length"] == test::approx(1.5).epsilon(1e-12));
  CHECK(figures["off_centre"] == test::approx(0.2).epsilon(1e-12));
  CHECK(figures["speed"] == test::approx(1.0).epsilon(1e-12));
}

TEST_CASE("a stream through an opening shall have its velocity, angle, fill and pressure") {
  // A curtain of 20 x 10 grains of 1 g, 1 mm apart in height, at (1.5, 0, -2) m/s: each sample of 1
  // ms 2 layers pass.
  const auto sensor = load_sensor("stream_section")
                          .make({{"point", Vec3{0, 0, 0.1}},
                                 {"normal", Vec3{0, 0, -1}},
                                 {"min", Vec3{0, 0, 0.1}},
                                 {"max", Vec3{0.33, 0.011, 0.1}},
                                 {"bulk_density", 1600.0},
                                 {"belt_velocity", Vec3{3.0, 0, 0}}});
  SyntheticScene world;
  for (int layer = 0; layer < 60; ++layer) {
    for (int n = 0; n < 20; ++n) {
      world.grains.push_back(
          at({0.005 + 0.005 * n, 0.005, 0.1005 + 1e-3 * layer}, {1.5, 0, -2}, 1e-3));
    }
  }
  for (int s = 0; s < 20; ++s) {
    move_on(world);
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  const double flow = 20 * 1e-3 * 2.0 / 1e-3;
  CHECK(figures["mass_flow"] == test::approx(flow).epsilon(1e-9));
  CHECK(figures["velocity_x"] == test::approx(1.5).epsilon(1e-12));
  CHECK(figures["velocity_z"] == test::approx(-2.0).epsilon(1e-12));
  CHECK(figures["speed"] == test::approx(2.5).epsilon(1e-12));
  CHECK(figures["angle"] == test::approx(std::atan(2.0 / 1.5)).epsilon(1e-12));
  CHECK(figures["fill_ratio"] == test::approx(flow / (1600 * 2.0 * 0.33 * 0.011)).epsilon(1e-9));
  CHECK(figures["impact_pressure"] == test::approx(1600 * 4.0).epsilon(1e-12));
  CHECK(figures["speed_along_belt_over_belt_speed"] == test::approx(0.5).epsilon(1e-12));
}

TEST_CASE(
    "a stream that falls shall have the velocity it has at the opening, however seldom seen") {
  for (const double interval : {1e-3, 5e-3, 10e-3}) {
    CAPTURE(interval);
    const auto sensor = load_sensor("stream_section")
                            .make({{"point", Vec3{0, 0, 0.1}},
                                   {"normal", Vec3{0, 0, -1}},
                                   {"min", Vec3{0, 0, 0.1}},
                                   {"max", Vec3{0.33, 0.011, 0.1}},
                                   {"bulk_density", 1600.0}});
    SyntheticScene world;
    world.interval = interval;
    // Falls 100 mm from 0.5 m/s to the opening.
    const double exact = std::sqrt(0.25 + 2.0 * 9.81 * 0.1);
    const auto drop_at = [](double time) { return 0.5 * time + 0.5 * 9.81 * time * time; };
    world.grains = {at({0.1, 0.005, 0.2}, {0, 0, -0.5}, 1e-3)};
    Grain& g = world.grains[0];
    g.force = {0, 0, -9.81e-3};
    for (int n = 1; n <= 200; ++n) {
      g.before = g.now;
      g.now.z = 0.2 - drop_at(n * interval);
      g.velocity.z = -0.5 - 9.81 * n * interval;
      step(*sensor, world);
      if (g.now.z < 0.1) break;
    }
    // Where between two samples, to second order.
    const double size = 9.81 * interval * interval * 9.81 / exact;
    CHECK(std::abs(summary_of(*sensor)["speed"] - exact) < size);
  }
}

TEST_CASE("errors of a stream's velocity, angle, fill and pressure shall hold the truth as often") {
  // Some 4 grains per sample; heavy ones are faster along x, which mean and error have to see.
  constexpr double k_density = 1600.0, k_area = 0.33 * 0.011;
  const Vec3 velocity{0.5 * 1.25 + 0.25 * 0.5 + 1.25 * 0.5 + 0.5 / 3.0, 0, -2.25};  // by mass
  const std::vector<std::string> names{"mass_flow",  "velocity_x",      "speed",           "angle",
                                       "fill_ratio", "impact_pressure", "speed_along_belt"};
  std::vector<Coverage> coverage(names.size());
  for (int run = 0; run < k_runs; ++run) {
    const auto sensor = load_sensor("stream_section")
                            .make({{"point", Vec3{0, 0, 0.1}},
                                   {"normal", Vec3{0, 0, -1}},
                                   {"min", Vec3{0, 0, 0.1}},
                                   {"max", Vec3{0.33, 0.011, 0.1}},
                                   {"bulk_density", k_density},
                                   {"belt_velocity", Vec3{3.0, 0, -1.0}}});
    Dice dice(run);
    SyntheticScene world;
    for (int s = 0; s < 320; ++s) {
      world.grains.clear();
      for (int n = dice.poisson(4.0); n > 0; --n) {
        const double u = dice.uniform();
        world.grains.push_back(at({0.1, 0.005, 0.1 + 1e-6},
                                  {1.25 + 0.5 * u, 0, -2.0 - 0.5 * dice.uniform()},
                                  1e-3 * (0.5 + u)));
      }
      move_on(world);
      step(*sensor, world);
    }
    const double flow = 4e-3 / world.interval;
    const std::vector<double> truth{flow,
                                    velocity.x,
                                    norm(velocity),
                                    std::atan2(-velocity.z, velocity.x),
                                    flow / (k_density * -velocity.z * k_area),
                                    k_density * velocity.z * velocity.z,
                                    dot(velocity, Vec3{3.0, 0, -1.0}) / std::sqrt(10.0)};
    const Figures figures = summary_of(*sensor);
    for (std::size_t n = 0; n < names.size(); ++n) coverage[n].add(figures.at(names[n]), truth[n]);
  }
  for (std::size_t n = 0; n < names.size(); ++n) {
    CAPTURE(names[n]);
    // One run in some hundreds looks by chance as if it had not settled.
    CHECK(coverage[n].without_error <= 3);
    CHECK(coverage[n].one() > k_one_low);
    CHECK(coverage[n].one() < k_one_high);
    CHECK(coverage[n].two() > k_two_low);
  }
}

TEST_CASE("what falls through the level shall count once, per hour and per tonne") {
  const auto sensor =
      load_sensor("spillage")
          .make(
              {{"min", Vec3{0, 0, 0.1}}, {"max", Vec3{0.2, 0.011, 0.1}}, {"steady_after", 0.005}});
  SyntheticScene world;
  // One grain of 1 g per millisecond; one rises, one falls beside.
  for (int n = 0; n < 20; ++n) {
    world.grains.push_back(at({0.1, 0.005, 0.1005 + 1e-3 * n}, {0, 0, -1}, 1e-3));
  }
  world.grains.push_back(at({0.1, 0.005, 0.0905}, {0, 0, 1}, 1.0));
  world.grains.push_back(at({0.25, 0.005, 0.1105}, {0, 0, -1}, 1.0));
  for (int s = 0; s < 15; ++s) {
    move_on(world);
    world.emitted_mass += 0.5;
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["mass"] == test::approx(15e-3).epsilon(1e-9));
  CHECK(figures["grains"] == test::approx(10.0));
  CHECK(figures["rate"] == test::approx(3600.0).epsilon(1e-9));
  CHECK(figures["grams_per_tonne"] == test::approx(1e6 * 1e-3 / 0.5).epsilon(1e-9));
  // Ten counts: an error of one in the root of ten.
  CHECK(figures.at("rate").uncertainty == test::approx(3600.0 / std::sqrt(10.0)).epsilon(1e-9));
}

TEST_CASE("down shall be where gravity pulls, and a level across nothing be refused") {
  const auto mass_of = [](Vec3 gravity, Vec3 velocity) {
    const auto sensor =
        load_sensor("spillage").make({{"min", Vec3{0, 0.005, 0}}, {"max", Vec3{0.2, 0.005, 0.2}}});
    SyntheticScene world;
    world.gravity = gravity;
    world.grains.push_back(at({0.1, 0.0051, 0.1}, velocity, 1e-3));
    world.grains.push_back(at({0.1, 0.0049, 0.1}, -1.0 * velocity, 2e-3));
    move_on(world);
    step(*sensor, world);
    return summary_of(*sensor)["mass"];
  };
  CHECK(mass_of({0, -9.81, 0}, {0, -1, 0}) == test::approx(1e-3));
  CHECK(mass_of({0, 9.81, 0}, {0, -1, 0}) == test::approx(2e-3));
  CHECK(mass_of({1, -9.81, 1}, {0, -1, 0}) == test::approx(1e-3));
  CHECK_THROWS_AS(mass_of({0, 0, -9.81}, {0, -1, 0}), sdk::ModelError);
  const auto sensor = load_sensor("spillage");
  for (const Vec3 max :
       {Vec3{0.2, 0.01, 0.1}, Vec3{0.2, 0, 0}, Vec3{0, 0, 0}, Vec3{-0.1, 0.01, 0}}) {
    CHECK_THROWS_AS(sensor.make({{"min", Vec3{}}, {"max", max}}), sdk::ParameterError);
  }
}

TEST_CASE("spillage of a feed that has ended or changes shall have no amount per tonne") {
  const auto per_tonne = [](double steady_after, int begin, int end) {
    const auto sensor = load_sensor("spillage")
                            .make({{"min", Vec3{0, 0, 0.1}},
                                   {"max", Vec3{0.2, 0.011, 0.1}},
                                   {"steady_after", steady_after}});
    SyntheticScene world;
    for (int s = 0; s < 400; ++s) {
      world.grains.assign(1, at({0.1, 0.005, 0.1005}, {0, 0, -1}, 1e-3));
      move_on(world);
      if (s >= begin && s < end) world.emitted_mass += 0.5;
      step(*sensor, world);
    }
    return summary_of(*sensor).at("grams_per_tonne");
  };
  CHECK(per_tonne(0.1, 0, 400).value == test::approx(2000.0).epsilon(1e-9));
  CHECK(per_tonne(0.1, 0, 400).uncertainty > 0.0);
  // Of a batch, counted from its release on, all is known: 400 g of 50 kg.
  CHECK(per_tonne(0.0, 0, 100).value == test::approx(8000.0).epsilon(1e-9));
  for (const auto& [begin, end] : {std::pair{0, 50}, std::pair{0, 300}, std::pair{200, 400}}) {
    const Figure figure = per_tonne(0.1, begin, end);
    CHECK(std::isnan(figure.value));
    CHECK(figure.uncertainty == sdk::k_feed_not_even);
  }
}

TEST_CASE("what falls through the level on its way to a periodic side shall count once") {
  SyntheticScene world;
  // As the columns have it: from beyond the side through which it comes in again; it has passed
  // the level a quarter of a millimetre before the side it left by.
  Grain g = at({0.0005, 0.005, 0.0993}, {1, 0, -1}, 1e-3);
  g.before = {-0.0005, 0.005, 0.1003};
  world.grains = {g};
  const auto mass_between = [&](double low, double high) {
    const auto sensor =
        load_sensor("spillage").make({{"min", Vec3{low, 0, 0.1}}, {"max", Vec3{high, 0.011, 0.1}}});
    step(*sensor, world);
    return summary_of(*sensor)["mass"];
  };
  CHECK(mass_between(0.0, world.domain_max.x) == test::approx(1e-3).epsilon(1e-12));
  CHECK(mass_between(0.2, world.domain_max.x) == test::approx(1e-3).epsilon(1e-12));
  CHECK(mass_between(0.0, 0.2) == 0.0);
}

namespace {

constexpr double k_wear_coefficient = 2e-3;
constexpr double k_hardness = 4e9;

/// Looks at cubes of 10 mm in a box of 300 x 10 x 100 mm.
auto wear_sensor(std::map<std::string, sdk::Value> values = {}) {
  values.insert({{"min", Vec3{0, 0, 0.05}},
                 {"max", Vec3{0.3, 0.01, 0.15}},
                 {"cell", 0.01},
                 {"coefficient", k_wear_coefficient},
                 {"hardness", k_hardness}});
  return load_sensor("wear").make(values);
}

/// A belt and a chute of two plates.
SyntheticScene transfer_point() {
  SyntheticScene world;
  world.walls = {{.name = "belt"}, {.name = "hood", .group = "chute"}, {.name = "lip"}};
  return world;
}

}  // namespace

TEST_CASE("what slides on a liner shall wear it as Archard's closed form says") {
  const auto sensor = wear_sensor();
  SyntheticScene world = transfer_point();
  // 90 N that slide at 2.5 m/s for 20 samples of 1 ms, with a friction of 36 N; something outside
  // the box.
  const double press = 90.0;
  const double slip = 2.5;
  const double dt = world.interval;
  world.slidings = {{.wall = 1,
                     .place = {0.105, 0.005, 0.105},
                     .impulse = press * dt,
                     .sliding = press * slip * dt,
                     .friction = 36.0 * slip * dt},
                    {.wall = 1, .place = {0.105, 0.005, 0.155}, .impulse = 1.0, .sliding = 1.0}};
  for (int s = 0; s < 20; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  const double worn = k_wear_coefficient * press * slip / k_hardness;  // [m3/s]
  CHECK(figures["volume_rate"] == test::approx(worn).epsilon(1e-9));
  CHECK(figures["volume"] == test::approx(worn * 0.02).epsilon(1e-9));
  CHECK(figures["normal_force"] == test::approx(press).epsilon(1e-9));
  CHECK(figures["friction_power"] == test::approx(36.0 * slip).epsilon(1e-9));
  CHECK(figures["depth_rate_largest/value"] == test::approx(worn / 1e-4).epsilon(1e-9));
  CHECK(figures["pressure_largest/value"] == test::approx(press / 1e-4).epsilon(1e-9));
  CHECK(figures["depth_rate_largest/x"] == test::approx(0.105).epsilon(1e-9));
  CHECK(figures["depth_rate_largest/z"] == test::approx(0.105).epsilon(1e-9));
}

TEST_CASE("wear shall be that of the walls named alone, by body or by group") {
  const auto worn = [](const std::vector<std::string>& walls) {
    const auto sensor = wear_sensor({{"walls", walls}});
    SyntheticScene world = transfer_point();
    for (std::int32_t wall = 0; wall < 3; ++wall) {
      world.slidings.push_back({.wall = wall,
                                .place = {0.1, 0.005, 0.1},
                                .impulse = world.interval,
                                .sliding = world.interval * std::pow(10.0, wall)});
    }
    step(*sensor, world);
    return summary_of(*sensor)["volume_rate"] * k_hardness / k_wear_coefficient;
  };
  CHECK(worn({"belt"}) == test::approx(1.0).epsilon(1e-9));
  CHECK(worn({"chute"}) == test::approx(10.0).epsilon(1e-9));
  CHECK(worn({"hood", "lip"}) == test::approx(110.0).epsilon(1e-9));
  CHECK(worn({}) == test::approx(111.0).epsilon(1e-9));
  CHECK(worn({"top"}) == 0.0);
}

TEST_CASE("the largest depth rate shall have the error of its own place") {
  const auto sensor = wear_sensor();
  SyntheticScene world = transfer_point();
  // The first place wears evenly; the second, touched later, in blows: 0 or 2 by the throw of a
  // coin, with a mean near 1 and a deviation of 1 from sample to sample.
  Dice dice(7);
  double sum = 0.0, squares = 0.0;
  constexpr int k_samples = 3200;
  for (int s = 0; s < k_samples; ++s) {
    const double blow = dice.normal() < 0.0 ? 0.0 : 2.0;
    sum += blow;
    squares += blow * blow;
    world.slidings = {{.wall = 0, .place = {0.015, 0.005, 0.1}, .impulse = 1e-3, .sliding = 1e-4}};
    if (blow > 0.0) {
      world.slidings.push_back(
          {.wall = 1, .place = {0.105, 0.005, 0.1}, .impulse = 1e-3, .sliding = blow * 1e-3});
    }
    step(*sensor, world);
  }
  const auto largest = summary_of(*sensor).at("depth_rate_largest/value");
  const double unit = k_wear_coefficient / k_hardness / 1e-4;  // [m/s] of a W
  const double mean = sum / k_samples;
  CHECK(largest.value == test::approx(unit * mean).epsilon(1e-9));
  const double scatter = std::sqrt((squares / k_samples - mean * mean) / k_samples);
  CHECK(largest.uncertainty > 0.6 * unit * scatter);
  CHECK(largest.uncertainty < 2.0 * unit * scatter);
  const auto pressure = summary_of(*sensor).at("pressure_largest/value");
  CHECK(pressure.uncertainty >= 0.0);
}

TEST_CASE("where nothing wears there shall be no place of the largest") {
  const auto idle = wear_sensor();
  SyntheticScene world = transfer_point();
  step(*idle, world);
  CHECK(summary_of(*idle)["depth_rate_largest/value"] == 0.0);
  CHECK(is_of_nothing(summary_of(*idle).at("depth_rate_largest/x")));
}
