// SPDX-License-Identifier: Apache-2.0
#include "unit/sensor/coverage.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

const SensorKind& kind() {
  static const SensorKind loaded = load_sensor("plane_flux");
  return loaded;
}

const std::map<std::string, sdk::Value> k_lip = {{"point", Vec3{0.08, 0, 0.2}},
                                                 {"normal", Vec3{1, 0, 0}},
                                                 {"min", Vec3{0.08, 0, 0.2}},
                                                 {"max", Vec3{0.08, 0.011, 0.21}}};

Grain moving(Vec3 before, Vec3 now, double interval) {
  Grain g;
  g.before = before;
  g.now = now;
  g.velocity = (now - before) / interval;
  return g;
}

/// Moves every grain on by its velocity.
void advance(SyntheticScene& world) {
  for (Grain& g : world.grains) {
    g.before = g.now;
    g.now += world.interval * g.velocity;
  }
}

}  // namespace

TEST_CASE("a uniform stream shall give its exact flux through any plane") {
  // Grains 0.5 mm apart at 1 m/s: 2 pass per millisecond, for an upright and an oblique plane.
  for (const Vec3 normal : {Vec3{1, 0, 0}, Vec3{1, 0, 1}, Vec3{3, 1, 2}}) {
    auto parameters = k_lip;
    parameters["point"] = Vec3{0.08, 0.005, 0.205};
    parameters["normal"] = normal;
    parameters["min"] = Vec3{0.05, 0, 0.2};
    parameters["max"] = Vec3{0.11, 0.011, 0.21};
    const auto sensor = kind().make(parameters);
    SyntheticScene world;
    world.domain_max = {10, 1, 1};
    for (int i = 0; i < 300; ++i) {
      Grain g;
      // A quarter of the spacing off: no grain meets the plane at the end of a step.
      g.now = {0.08 - 0.5e-3 * (i + 0.25), 0.005, 0.205};
      g.velocity = {1, 0, 0};
      g.mass = 2e-9;
      g.diameter = i % 2 == 0 ? 300e-6 : 600e-6;
      world.grains.push_back(g);
    }
    for (int s = 0; s < 100; ++s) {
      advance(world);
      step(*sensor, world);
    }
    const Figures figures = summary_of(*sensor);
    CHECK(figures["forward/number_rate"] == test::approx(2000.0).epsilon(1e-9));
    CHECK(figures["net/mass_rate"] == test::approx(4e-6).epsilon(1e-9));
    CHECK(figures["class_300_um/forward/number_rate"] == test::approx(1000.0).epsilon(1e-9));
    CHECK(figures["backward/mass_rate"] == 0.0);
    CHECK(figures.at("backward/mass_rate").uncertainty < 0.0);
    CHECK(figures["forward/mass"] == test::approx(200 * 2e-9).epsilon(1e-9));
    // Perfectly even: far below the 7 % of counting 200 independent grains.
    CHECK(figures.at("forward/number_rate").uncertainty < 1e-6 * 2000.0);
  }
}

TEST_CASE("only passages through the rectangle shall count, each in its direction") {
  const auto sensor = kind().make(k_lip);
  SyntheticScene world;
  const double h = world.interval;
  world.grains = {moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, h),   // forward
                  moving({0.0805, 0.005, 0.205}, {0.0795, 0.005, 0.205}, h),   // backward
                  moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.2049}, h),  // forward
                  moving({0.0795, 0.005, 0.215}, {0.0805, 0.005, 0.215}, h),   // above
                  moving({0.0795, 0.005, 0.2005}, {0.0805, 0.005, 0.199}, h),  // meets it below
                  moving({0.0795, 0.005, 0.1995}, {0.0805, 0.005, 0.201}, h),  // meets it inside
                  moving({0.0780, 0.005, 0.205}, {0.0790, 0.005, 0.205}, h)};  // not yet there
  step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["forward/number_rate"] * h == test::approx(3.0).epsilon(1e-12));
  CHECK(figures["backward/number_rate"] * h == test::approx(1.0).epsilon(1e-12));
  CHECK(figures["net/number_rate"] * h == test::approx(2.0).epsilon(1e-12));
}

TEST_CASE("a way through a periodic side shall count at planes that it passes, at no other") {
  // As the columns have it: from beyond the side through which the grain comes in again.
  SyntheticScene world;
  world.grains = {moving({-0.0005, 0.005, 0.1}, {0.0005, 0.005, 0.1}, world.interval)};
  const auto passages_at = [&](double x) {
    auto parameters = k_lip;
    parameters["point"] = Vec3{x, 0, 0};
    parameters["min"] = Vec3{x, 0, 0};
    parameters["max"] = Vec3{x, 1, 1};
    const auto sensor = kind().make(parameters);
    step(*sensor, world);
    const Figures figures = summary_of(*sensor);
    return std::pair{figures["forward/number_rate"] * world.interval,
                     figures["backward/number_rate"]};
  };
  CHECK(passages_at(0.0002).first == test::approx(1.0).epsilon(1e-12));
  CHECK(passages_at(0.0002).second == 0.0);
  CHECK(passages_at(0.165) == std::pair{0.0, 0.0});
  // What it has passed before it came to the other side, and the side itself.
  CHECK(passages_at(world.domain_max.x - 0.0002).first == test::approx(1.0).epsilon(1e-12));
  CHECK(passages_at(world.domain_max.x).first == test::approx(1.0).epsilon(1e-12));
}

TEST_CASE("rates before the steady part shall not count, masses shall") {
  auto parameters = k_lip;
  parameters["steady_after"] = 0.01;
  const auto sensor = kind().make(parameters);
  SyntheticScene world;
  for (int s = 0; s < 20; ++s) {
    world.grains.clear();
    if (s < 10) {
      world.grains = {moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval)};
    }
    step(*sensor, world);
  }
  CHECK(summary_of(*sensor)["forward/number_rate"] == 0.0);
  CHECK(summary_of(*sensor)["forward/mass"] == test::approx(10 * 1e-9).epsilon(1e-12));
}

TEST_CASE("the error of a rate shall cover the truth at its rate, for weighted grains too") {
  struct Case {
    double per_sample;  ///< real grains
    int copies;
  };
  // Many grains, few grains, and few grains released 20-fold with weight 1/20.
  for (const Case c : {Case{2.0, 1}, Case{0.2, 1}, Case{0.05, 20}}) {
    Coverage coverage;
    double error = 0.0;
    constexpr int k_samples = 320;
    for (int run = 0; run < k_runs; ++run) {
      Dice dice(run);
      const auto sensor = kind().make(k_lip);
      SyntheticScene world;
      for (int s = 0; s < k_samples; ++s) {
        world.grains.clear();
        for (int n = dice.poisson(c.per_sample * c.copies); n > 0; --n) {
          Grain g = moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval);
          g.weight = 1.0 / c.copies;
          world.grains.push_back(g);
        }
        step(*sensor, world);
      }
      const Figure figure = summary_of(*sensor).at("forward/number_rate");
      coverage.add(figure, c.per_sample / world.interval);
      error += figure.uncertainty / k_runs;
    }
    CHECK(coverage.without_error == 0);
    CHECK(coverage.one() > k_one_low);
    // Few grains: the larger of two errors is taken, which may cover more.
    CHECK(coverage.one() < k_one_high + 0.06);
    CHECK(coverage.two() > k_two_low);
    const double expected =
        std::sqrt(c.per_sample / (k_samples * static_cast<double>(c.copies))) / 0.001;
    CHECK(error > 0.93 * expected);
    // Half of all series look as if they remembered, by chance: 17 % in the mean of 20 batches.
    CHECK(error < 1.25 * expected);
  }
}

TEST_CASE("the error of a rate shall cover the truth where grains come in bursts") {
  // Bursts at random times, each of a random number of grains over a while: the counts of a sample
  // are far from independent, those of the bursts are.
  struct Case {
    int bursts;  ///< in the mean
    int grains;  ///< of each, in the mean
    int length;  ///< [samples]
  };
  constexpr int k_samples = 1000;
  for (const Case c : {Case{50, 5, 10}, Case{20, 10, 25}, Case{10, 10, 50}}) {
    Coverage coverage;
    int covered = 0, with_error = 0;
    const double truth = static_cast<double>(c.bursts * c.grains) / k_samples / 0.001;
    for (int run = 0; run < k_runs; ++run) {
      Dice dice(run);
      std::vector<int> counts(k_samples + c.length, 0);
      const double span = static_cast<double>(counts.size());
      for (int b = dice.poisson(c.bursts * span / k_samples); b > 0; --b) {
        const int start = static_cast<int>(span * dice.uniform());
        for (int n = dice.poisson(c.grains); n > 0; --n) {
          const auto at = static_cast<std::size_t>(start + c.length * dice.uniform());
          if (at < counts.size()) ++counts[at];
        }
      }
      const auto sensor = kind().make(k_lip);
      SyntheticScene world;
      for (int s = 0; s < k_samples; ++s) {
        const int count = counts[static_cast<std::size_t>(s + c.length)];
        world.grains.assign(static_cast<std::size_t>(count),
                            moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval));
        step(*sensor, world);
      }
      const Figure figure = summary_of(*sensor).at("forward/number_rate");
      if (figure.uncertainty < 0.0) continue;
      ++with_error;
      covered += std::abs(figure.value - truth) <= 1.96 * figure.uncertainty;
    }
    const double share = static_cast<double>(covered) / with_error;
    MESSAGE(c.bursts << " bursts: 95 % intervals cover " << share << " of " << with_error);
    CHECK(with_error > 0.7 * k_runs);
    CHECK(share > 0.88);
    CHECK(share < 0.99);
  }
}

TEST_CASE("a rate of few grains, or one that has not settled, shall say so instead of an error") {
  SyntheticScene world;
  const auto pass = [&](sdk::Sensor& sensor, int count) {
    world.grains.assign(static_cast<std::size_t>(count),
                        moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval));
    step(sensor, world);
  };
  const auto few = kind().make(k_lip);
  for (int s = 0; s < 320; ++s) pass(*few, s % 17 == 0 ? 1 : 0);
  CHECK(summary_of(*few).at("forward/number_rate").uncertainty == sdk::k_few_grains);
  const auto enough = kind().make(k_lip);
  world.time = 0.0;
  for (int s = 0; s < 320; ++s) pass(*enough, s % 15 == 0 ? 1 : 0);
  CHECK(summary_of(*enough).at("forward/number_rate").uncertainty > 0.0);
  // Dust that arrives in the last quarter.
  const auto late = kind().make(k_lip);
  world.time = 0.0;
  world.emitted_mass = 0.0;
  for (int s = 0; s < 320; ++s) {
    world.emitted_mass += 1e-3;
    pass(*late, s < 240 ? 0 : 1);
  }
  CHECK(summary_of(*late).at("forward/number_rate").uncertainty == sdk::k_not_steady);
  CHECK(summary_of(*late).at("net/grams_per_tonne").uncertainty == sdk::k_not_steady);
}

TEST_CASE("a plane without a normal shall be refused") {
  auto parameters = k_lip;
  parameters["normal"] = Vec3{0, 0, 0};
  CHECK_THROWS_AS((void)kind().make(parameters), sdk::ParameterError);
}

TEST_CASE("a rectangle without area shall be refused") {
  const auto message_of = [](Vec3 max, Vec3 normal) {
    auto parameters = k_lip;
    parameters["max"] = max;
    parameters["normal"] = normal;
    try {
      static_cast<void>(kind().make(parameters));
    } catch (const sdk::ParameterError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const Vec3 along_x{1, 0, 0};
  // From (0.08, 0, 0.2) m: as it is, a point, a line, and a box of which a plane cuts a line out.
  CHECK(message_of({0.08, 0.011, 0.21}, along_x).empty());
  CHECK(message_of({0.09, 0.011, 0.21}, {1, 0, 1}).empty());
  CHECK(message_of({0.08, 0, 0.2}, along_x).find("the opening has no area") != std::string::npos);
  CHECK(message_of({0.08, 0.011, 0.2}, along_x).find("no width along z") != std::string::npos);
  CHECK(message_of({0.08, 0.011, 0.21}, {1, 0, 1}).find("no width along x") != std::string::npos);
}

TEST_CASE("dust through an opening shall count per tonne emitted in the same time") {
  auto parameters = k_lip;
  parameters["steady_after"] = 0.01;
  parameters["finer_than"] = 100e-6;
  const auto sensor = kind().make(parameters);
  SyntheticScene world;
  for (int s = 0; s < 40; ++s) {
    // Two grains of 1 ug and one coarse grain pass per sample, 5 g are emitted; before the steady
    // part ten times as much is emitted.
    world.grains.clear();
    for (int n = 0; n < 3; ++n) {
      world.grains.push_back(
          moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval));
      world.grains.back().diameter = n < 2 ? 10e-6 : 300e-6;
      world.grains.back().mass = 1e-9;
    }
    world.emitted_mass += s < 10 ? 50e-3 : 5e-3;
    step(*sensor, world);
  }
  const Figures figures = summary_of(*sensor);
  // 2 ug per 5 g are 0.4 g per tonne.
  CHECK(figures["net/grams_per_tonne"] == test::approx(0.4).epsilon(1e-9));
  CHECK(figures["class_10_um/net/grams_per_tonne"] == test::approx(0.4).epsilon(1e-9));
  CHECK(figures.at("net/grams_per_tonne").unit == "g/t");
  for (const auto& [name, figure] : figures.all()) {
    CHECK(name.find("class_300") == std::string::npos);
  }
}

TEST_CASE("a feed that begins or ends while dust is counted shall give no amount per tonne") {
  // One grain of 1 ug per sample; 5 g are emitted in those from `begin` to `end`.
  const auto per_tonne = [](double steady_after, int begin, int end) {
    auto parameters = k_lip;
    parameters["steady_after"] = steady_after;
    const auto sensor = kind().make(parameters);
    SyntheticScene world;
    for (int s = 0; s < 400; ++s) {
      world.grains = {moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval)};
      world.grains.back().mass = 1e-9;
      if (s >= begin && s < end) world.emitted_mass += 5e-3;
      step(*sensor, world);
    }
    return summary_of(*sensor).at("net/grams_per_tonne");
  };
  const Figure even = per_tonne(0.1, 0, 400);
  CHECK(even.value == test::approx(0.2).epsilon(1e-9));
  CHECK(even.uncertainty >= 0.0);
  for (const auto& [begin, end] : {std::pair{0, 300}, std::pair{200, 400}, std::pair{0, 360},
                                   std::pair{0, 50}, std::pair{0, 0}}) {
    CAPTURE(end);
    const Figure figure = per_tonne(0.1, begin, end);
    CHECK(std::isnan(figure.value));
    CHECK(figure.uncertainty == sdk::k_feed_not_even);
  }
  // A batch, counted from its release on: 0.4 mg of 0.5 kg.
  CHECK(per_tonne(0.0, 0, 100).value == test::approx(0.8).epsilon(1e-9));
}

TEST_CASE("what was emitted before a sensor begins shall not count as fed while it looks") {
  const auto sensor = kind().make(k_lip);
  SyntheticScene world;
  world.emitted_mass = 3.0;
  begin(*sensor, world);
  for (int s = 0; s < 400; ++s) {
    world.grains = {moving({0.0795, 0.005, 0.205}, {0.0805, 0.005, 0.205}, world.interval)};
    world.grains.back().mass = 1e-9;
    world.emitted_mass += 5e-3;
    step(*sensor, world);
  }
  CHECK(summary_of(*sensor)["net/grams_per_tonne"] == test::approx(0.2).epsilon(1e-9));
}

TEST_CASE("an opening shall say so of its figures, whatever the sensor is called") {
  auto parameters = k_lip;
  parameters["role"] = std::string("opening");
  parameters["finer_than"] = 100e-6;
  SyntheticScene world;
  const auto opening = kind().make(parameters);
  step(*opening, world);
  const Figures figures = summary_of(*opening);
  const auto& net = figures.at("class_10_um/net/grams_per_tonne");
  CHECK(net.role.role == sdk::Role::opening);
  CHECK(net.role.quantity == sdk::Quantity::mass_per_load);
  CHECK(net.role.direction == sdk::Direction::net);
  CHECK(net.role.smallest == 10e-6);
  CHECK(net.role.largest == 10e-6);
  CHECK(net.towards == "emission");
  // What goes to and fro counts towards nothing; the sum is of all sizes taken.
  CHECK(figures.at("forward/grams_per_tonne").towards.empty());
  CHECK(figures.at("net/grams_per_tonne").role.largest == 100e-6);
  CHECK(figures.at("observed_time").role.role == sdk::Role::observed_time);
  const auto passage = kind().make(k_lip);
  step(*passage, world);
  CHECK(summary_of(*passage).at("net/grams_per_tonne").role.role == sdk::Role::passage);
  CHECK(summary_of(*passage).at("net/grams_per_tonne").towards.empty());
}

TEST_CASE("what passes a plane in the net shall be its main figure, unless it is part of a total") {
  SyntheticScene world;
  const auto passage = kind().make(k_lip);
  step(*passage, world);
  const Figures figures = summary_of(*passage);
  CHECK(figures.at("net/mass_rate").towards == "overview");
  CHECK(figures.at("net/mass_rate").role.role == sdk::Role::passage);
  CHECK(figures.at("forward/mass_rate").towards.empty());
  CHECK(figures.at("class_10_um/net/mass_rate").towards.empty());
  auto parameters = k_lip;
  parameters["role"] = std::string("opening");
  const auto opening = kind().make(parameters);
  step(*opening, world);
  CHECK(summary_of(*opening).at("net/mass_rate").towards == "emission");
}
