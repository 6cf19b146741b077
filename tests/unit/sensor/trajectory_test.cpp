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
  static const SensorKind loaded = load_sensor("trajectory");
  return loaded;
}

constexpr double k_gravity = 9.81;
/// The error of an edge is skewed (40 of 800 grains lie beyond it): within two standard errors in
/// 91 % of 6000 runs; 300 runs scatter by 1.7 %.
constexpr double k_two_low_edges = 0.86;
const std::map<std::string, sdk::Value> k_stream = {{"from", Vec3{0.08, 0, 0.2}},
                                                    {"drops", std::vector<double>{0.05, 0.14}}};

/// A grain that crosses 0.14 m below A at the distance `place` from A.
Grain falling_at(double place) {
  Grain g;
  g.before = {0.08 + place - 0.0004, 0.005, 0.06 + 0.001};
  g.now = {0.08 + place + 0.0004, 0.005, 0.06 - 0.001};
  g.velocity = {0.8, 0, -2};
  g.force = {0, 0, -g.mass * k_gravity};
  return g;
}

/// Place and velocity of free flight from A at 0.8 m/s along x.
Grain free_flight(Grain g, double since, double interval) {
  const auto place = [&](double t) {
    return Vec3{0.08 + 0.8 * t, 0.005, 0.2 - 0.5 * k_gravity * t * t};
  };
  g.before = place(since - interval);
  g.now = place(since);
  g.velocity = {0.8, 0, -k_gravity * since};
  g.force = {0, 0, -g.mass * k_gravity};
  return g;
}

}  // namespace

TEST_CASE("grains in free flight shall cross on the parabola at the speed of free fall") {
  const auto sensor = kind().make(k_stream);
  SyntheticScene world;
  // Grains leave A all the time; each sample shows those in flight.
  constexpr int k_per_sample = 5;
  for (int s = 0; s < 400; ++s) {
    world.grains.clear();
    for (int n = 0; n < 250 * k_per_sample; ++n) {
      const double since = (n + 0.37) * world.interval / k_per_sample;
      if (since < world.interval) continue;
      world.grains.push_back(free_flight({}, since, world.interval));
    }
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  for (const double drop : {0.05, 0.14}) {
    const std::string name = drop == 0.05 ? "drop_50_mm/" : "drop_140_mm/";
    const double time = std::sqrt(2 * drop / k_gravity);
    // The chord of one step of a parabola: its height differs from the path by at most g h^2/8.
    const double chord = 0.8 * k_gravity * 1e-6 / 8 / (k_gravity * time);
    CHECK(figures[name + "median"] == test::approx(0.8 * time).epsilon(chord / (0.8 * time) * 2));
    CHECK(figures[name + "median_vertical_speed"] == test::approx(k_gravity * time).epsilon(1e-4));
    CHECK(figures[name + "crossings"] == test::approx(400.0 * k_per_sample).epsilon(0.003));
  }
}

TEST_CASE("the quantiles of a normal stream shall be covered by their errors at their rate") {
  const double sigma = 0.004;
  const double z_95 = 1.6448536269514722;
  Coverage median;
  Coverage low;
  Coverage high;
  double error = 0.0;
  constexpr int k_samples = 200;
  constexpr int k_per_sample = 4;
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    const auto sensor = kind().make(k_stream);
    SyntheticScene world;
    for (int s = 0; s < k_samples; ++s) {
      world.grains.clear();
      for (int n = 0; n < k_per_sample; ++n) {
        world.grains.push_back(falling_at(0.12 + sigma * dice.normal()));
      }
      step(*sensor, world);
    }
    const Figures figures = summary_of(*sensor);
    median.add(figures.at("drop_140_mm/median"), 0.12);
    low.add(figures.at("drop_140_mm/quantile_5"), 0.12 - z_95 * sigma);
    high.add(figures.at("drop_140_mm/quantile_95"), 0.12 + z_95 * sigma);
    error += figures.at("drop_140_mm/median").uncertainty / k_runs;
    CHECK(figures["drop_50_mm/crossings"] == 0.0);
    CHECK(is_of_nothing(figures.at("drop_50_mm/median")));
    CHECK(is_of_nothing(figures.at("drop_50_mm/median_vertical_speed")));
    CHECK(is_of_nothing(series_of(*sensor).at("drop_50_mm/mean")));
  }
  for (const Coverage* c : {&median, &low, &high}) {
    CHECK(c->without_error == 0);
    CHECK(c->one() > k_one_low);
    CHECK(c->one() < k_one_high);
    CHECK(c->two() > k_two_low_edges);
  }
  CHECK(median.two() > k_two_low);
  // The median of n normal values: sigma sqrt(pi / 2n).
  const double expected = sigma * std::sqrt(std::numbers::pi / (2.0 * k_samples * k_per_sample));
  CHECK(error == test::approx(expected).epsilon(0.08));
}

TEST_CASE("grains that cross in clusters shall widen the error") {
  double alone = 0.0;
  double clustered = 0.0;
  for (int run = 0; run < 40; ++run) {
    for (const bool is_clustered : {false, true}) {
      Dice dice(run);
      const auto sensor = kind().make(k_stream);
      SyntheticScene world;
      for (int s = 0; s < 200; ++s) {
        world.grains.clear();
        const double shared = dice.normal();
        for (int n = 0; n < 9; ++n) {
          world.grains.push_back(
              falling_at(0.12 + 0.004 * (is_clustered ? shared : dice.normal())));
        }
        step(*sensor, world);
      }
      (is_clustered ? clustered : alone) +=
          summary_of(*sensor).at("drop_140_mm/median").uncertainty / 40;
    }
  }
  // Nine grains at one place tell as much as one.
  CHECK(clustered / alone == test::approx(3.0).epsilon(0.2));
}

TEST_CASE("copies of weight 1/k shall give the same quantiles") {
  const auto single = kind().make(k_stream);
  const auto copied = kind().make(k_stream);
  SyntheticScene world;
  Dice dice(1);
  constexpr int k_copies = 20;
  for (int s = 0; s < 100; ++s) {
    std::vector<Grain> grains;
    for (int n = 0; n < 5; ++n) grains.push_back(falling_at(0.12 + 0.004 * dice.normal()));
    world.grains = grains;
    step(*single, world);
    world.grains.clear();
    for (Grain g : grains) {
      g.weight = 1.0 / k_copies;
      for (int c = 0; c < k_copies; ++c) world.grains.push_back(g);
    }
    world.time -= world.interval;
    step(*copied, world);
  }
  const Figures a = summary_of(*single);
  const Figures b = summary_of(*copied);
  for (const char* name : {"median", "quantile_5", "quantile_95"}) {
    const std::string figure = std::string("drop_140_mm/") + name;
    // Interpolation between neighbours of 500 values moves by less than their distance.
    CHECK(std::abs(a[figure] - b[figure]) < 1e-4);
    CHECK(b.at(figure).uncertainty == test::approx(a.at(figure).uncertainty).epsilon(0.15));
  }
  CHECK(b["drop_140_mm/number"] == test::approx(a["drop_140_mm/number"]).epsilon(1e-12));
  CHECK(b["drop_140_mm/crossings"] == k_copies * a["drop_140_mm/crossings"]);
}

TEST_CASE("figures shall not depend on which axis gravity has") {
  const auto upright = kind().make(k_stream);
  auto parameters = k_stream;
  parameters["from"] = Vec3{0.2, 0.08, 0};
  parameters["along"] = Vec3{0.3, 1, 0};  // only the part across gravity matters
  const auto turned = kind().make(parameters);
  SyntheticScene a;
  SyntheticScene b;
  b.gravity = {-k_gravity, 0, 0};
  b.domain_max = {0.35, 0.33, 0.011};
  const auto turn = [](Vec3 v) { return Vec3{v.z, v.x, v.y}; };
  Dice dice(3);
  for (int s = 0; s < 30; ++s) {
    a.grains = {falling_at(0.12 + 0.01 * dice.normal())};
    Grain g = a.grains[0];
    g.before = turn(g.before);
    g.now = turn(g.now);
    g.velocity = turn(g.velocity);
    g.force = turn(g.force);
    b.grains = {g};
    step(*upright, a);
    step(*turned, b);
  }
  CHECK(summary_of(*turned)["drop_140_mm/crossings"] == 30.0);
  CHECK(summary_of(*turned)["drop_140_mm/median"] ==
        test::approx(summary_of(*upright)["drop_140_mm/median"]).epsilon(1e-12));
}

TEST_CASE("the speed at A shall be that of grains above the belt alone") {
  const auto sensor = kind().make(k_stream);
  SyntheticScene world;
  const auto passing = [](double height, double vertical) {
    Grain g;
    g.before = {0.0796, 0.005, 0.2 + height};
    g.now = {0.0804, 0.005, 0.2 + height};
    g.velocity = {0.8, 0, vertical};
    return g;
  };
  Grain backward = passing(0.001, 5.0);
  std::swap(backward.before, backward.now);
  for (int s = 0; s < 20; ++s) {
    world.grains = {passing(0.0003, 0.01), passing(0.0003, -0.03), passing(0.0006, 0.02), backward,
                    passing(-0.08, 7.0)};
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["at_a/crossings"] == 60.0);
  CHECK(figures["at_a/median_vertical_speed"] == test::approx(0.02).epsilon(1e-12));
}

TEST_CASE("a stream through periodic sides shall cross once, at places in the domain") {
  SyntheticScene world;
  const Vec3 extent = world.domain_max - world.domain_min;
  const auto median_of = [&](Grain g) {
    // As the columns have it: the way ends in the domain and begins beyond a side.
    for (int d = 0; d < 3; ++d) {
      const double shift = g.now[d] < 0.0 ? extent[d] : g.now[d] > extent[d] ? -extent[d] : 0.0;
      g.now[d] += shift;
      g.before[d] += shift;
    }
    auto parameters = k_stream;
    parameters["drops"] = std::vector<double>{0.14, 0.2};
    const auto sensor = kind().make(parameters);
    world.grains = {g};
    for (int s = 0; s < 20; ++s) step(*sensor, world);
    return summary_of(*sensor);
  };
  const double to_end = extent.x - 0.08;
  // It crosses in the middle of its way of 0.8 mm, before and behind the side.
  const Figures before = median_of(falling_at(to_end - 0.0002));
  CHECK(before["drop_140_mm/crossings"] == 20.0);
  CHECK(before["drop_140_mm/median"] == test::approx(to_end - 0.0002).epsilon(1e-9));
  const Figures behind = median_of(falling_at(to_end + 0.0002));
  CHECK(behind["drop_140_mm/crossings"] == 20.0);
  CHECK(behind["drop_140_mm/median"] == test::approx(-0.08 + 0.0002).epsilon(1e-9));
  // Through the lower side, in which the level of the second drop lies.
  Grain low = falling_at(0.1);
  low.before.z -= 0.06;
  low.now.z -= 0.06;
  CHECK(median_of(low)["drop_200_mm/crossings"] == 20.0);
  // Through both at once.
  Grain corner = falling_at(to_end - 0.0002);
  corner.before.z -= 0.06;
  corner.now.z -= 0.06;
  const Figures both = median_of(corner);
  CHECK(both["drop_200_mm/crossings"] == 20.0);
  CHECK(both["drop_200_mm/median"] == test::approx(to_end - 0.0002).epsilon(1e-9));
  // Past A, which is the side itself, above the belt.
  Grain passing;
  passing.before = {-0.0004, 0.005, 0.21};
  passing.now = {0.0004, 0.005, 0.21};
  passing.velocity = {0.8, 0, 0};
  for (const double x : {0.0, 0.0002, extent.x, extent.x - 0.0002}) {
    auto parameters = k_stream;
    parameters["from"] = Vec3{x, 0, 0.2};
    const auto sensor = kind().make(parameters);
    world.grains = {passing};
    step(*sensor, world);
    CHECK(summary_of(*sensor)["at_a/crossings"] == 1.0);
  }
}

TEST_CASE("size classes shall have their own median") {
  const auto sensor = kind().make(k_stream);
  SyntheticScene world;
  for (int s = 0; s < 20; ++s) {
    world.grains = {falling_at(0.11), falling_at(0.13), falling_at(0.13)};
    world.grains[1].diameter = world.grains[2].diameter = 600e-6;
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  CHECK(figures["drop_140_mm/class_300_um/median"] == test::approx(0.11).epsilon(1e-12));
  CHECK(figures["drop_140_mm/class_600_um/median"] == test::approx(0.13).epsilon(1e-12));
}

TEST_CASE("a trajectory without gravity or with unordered drops shall be refused") {
  auto parameters = k_stream;
  parameters["drops"] = std::vector<double>{0.14, 0.05};
  CHECK_THROWS_AS((void)kind().make(parameters), sdk::ParameterError);
  const auto sensor = kind().make(k_stream);
  SyntheticScene world;
  world.gravity = {0, 0, 0};
  CHECK_THROWS_AS(step(*sensor, world), sdk::ModelError);
}
