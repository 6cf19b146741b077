// SPDX-License-Identifier: Apache-2.0
#include "sensor/discharge/discharge.hpp"

#include "support/approx.hpp"
#include "support/sensor_bench.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Value;
using dust::sdk::Vec3;
namespace formula = dust::model::discharge;

namespace {

const std::map<std::string, Value> k_hole{{"centre", Vec3{0.1, 0.005, 0.1}}, {"hole", 8e-3}};

Grain falling(double x, double time, double crosses_at, double interval) {
  Grain g;
  g.velocity = {0, 0, -0.5};
  g.now = {x, 0.005, 0.1 - 0.5 * (time - crosses_at)};
  g.before = g.now - interval * g.velocity;
  g.diameter = 1e-3;
  g.mass = 2000.0 * std::numbers::pi / 6 * 1e-9;
  return g;
}

}  // namespace

TEST_CASE("a steady discharge shall have its rate, its time, and Beverloo's beside it") {
  auto p = k_hole;
  p["opened_at"] = 0.05;
  const auto sensor = load_sensor("discharge").make(p);
  SyntheticScene world;
  // One grain every 1.25 ms between 0.1 and 0.3 s, in and beside the hole: 800 a second.
  for (int n = 1; n <= 500; ++n) {
    world.grains.clear();
    for (int k = 0; k < 160; ++k) {
      const double at = 0.1 + (k + 0.5) * 1.25e-3;
      if (std::abs(1e-3 * n - at) > 0.05) continue;
      world.grains.push_back(falling(0.1 + 3e-3 * std::sin(k), 1e-3 * n, at, world.interval));
      world.grains.push_back(falling(0.105, 1e-3 * n, at, world.interval));
    }
    step(*sensor, world);
  }
  const Figures f = summary_of(*sensor);
  const double mass = 2000.0 * std::numbers::pi / 6 * 1e-9;
  CHECK(f["number"] == 160.0);
  CHECK(f["mass"] == approx(160 * mass).epsilon(1e-12));
  // The last one crosses at 0.1 + 159.5 * 1.25 ms.
  CHECK(f["duration"] == approx(159 * 1.25e-3).epsilon(1e-9));
  CHECK(f["time"] == approx(0.05 + 159.5 * 1.25e-3).epsilon(1e-9));
  // From 20 to 80 %: 96 grains, one sample of 1 ms is 0.8 grains.
  CHECK(f["number_rate"] == approx(800.0).epsilon(0.02));
  CHECK(f["rate"] == approx(800.0 * mass).epsilon(0.02));
  CHECK(f.at("rate").uncertainty > 0.0);
  const double expected = 0.58 * 0.6 * 2000.0 * std::sqrt(9.81) * std::pow(8e-3 - 1.4e-3, 2.5);
  CHECK(f["beverloo_rate"] == approx(expected).epsilon(1e-9));
  CHECK(f["rate_over_beverloo"] == approx(f["rate"] / expected).epsilon(1e-12));
}

TEST_CASE("Beverloo's correlation shall give the silo's rates within its round numbers") {
  // 4 mm spheres, C 0.58, k 1.4, bulk 1500 kg/m3, solid 2500 kg/m3: 22.5e3 and 7.14e3 a second
  // through 60 and 40 mm, printed with three digits.
  const double grain = 2500.0 * std::numbers::pi / 6 * 64e-9;
  const auto rate = [&](double hole) {
    return formula::beverloo(0.58, 1.4, 1500.0, 9.81, hole, 4e-3) / grain;
  };
  CHECK(rate(0.06) == approx(22.5e3).epsilon(0.005));
  CHECK(rate(0.04) == approx(7.14e3).epsilon(0.005));
  CHECK(rate(5e-3) == 0.0);
}

TEST_CASE("grains that come back through the hole shall be taken off") {
  const auto sensor = load_sensor("discharge").make(k_hole);
  SyntheticScene world;
  Grain down = falling(0.1, 1e-3, 0.5e-3, 1e-3);
  world.grains = {down};
  step(*sensor, world);
  std::swap(world.grains[0].now, world.grains[0].before);
  step(*sensor, world);
  CHECK(summary_of(*sensor)["number"] == 0.0);
  CHECK(is_of_nothing(summary_of(*sensor).at("time")));
  CHECK(is_of_nothing(summary_of(*sensor).at("beverloo_rate")));
}

TEST_CASE("grains that fall back into a hopper through a periodic side shall count at its outlet") {
  // The hole lies in the lower side, by which they leave; the columns have them come in at the top.
  SyntheticScene world;
  Grain g = falling(0.1, 1e-3, 0.4e-3, 1e-3);
  const double top = world.domain_max.z;
  g.now = {0.1, 0.005, top - 0.3e-3};
  g.before = g.now - world.interval * g.velocity;
  REQUIRE(g.before.z > top);
  world.grains = {g};
  const auto number_at = [&](double x, double z) {
    auto p = k_hole;
    p["centre"] = Vec3{x, 0.005, z};
    const auto sensor = load_sensor("discharge").make(p);
    step(*sensor, world);
    return summary_of(*sensor)["number"];
  };
  CHECK(number_at(0.1, 0.0) == 1.0);
  CHECK(number_at(0.1, 0.1e-3) == 1.0);
  CHECK(number_at(0.1, top - 0.1e-3) == 1.0);
  CHECK(number_at(0.1, 0.3e-3) == 0.0);   // above where it was
  CHECK(number_at(0.12, 0.1e-3) == 0.0);  // beside the hole
}

TEST_CASE("a rate from the first of the mass on shall not count the time before that passes") {
  // Nothing for 0.1 s, then two a sample of 1 ms.
  std::vector<double> time;
  std::vector<double> passed;
  for (int n = 1; n <= 300; ++n) {
    time.push_back(1e-3 * n);
    passed.push_back(2.0 * std::max(n - 100, 0));
  }
  for (const double low : {0.0, 0.2}) {
    CAPTURE(low);
    CHECK(formula::middle_rate(time, passed, low, 1.0).value == approx(2000.0).epsilon(1e-9));
  }
  // What passes from the first sample on counts from there: when it began is not known.
  CHECK(formula::middle_rate(std::span(time).subspan(100), std::span(passed).subspan(100), 0.0, 1.0)
            .value == approx(2000.0).epsilon(1e-9));
}

TEST_CASE("the error of a rate shall cover the truth at its frequency for a random stream") {
  Coverage coverage;
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    std::vector<double> time;
    std::vector<double> passed;
    double sum = 0.0;
    for (int n = 1; n <= 2000; ++n) {
      sum += dice.poisson(2.0);
      time.push_back(1e-3 * n);
      passed.push_back(sum);
    }
    const auto rate = formula::middle_rate(time, passed, 0.2, 0.8);
    coverage.add({rate.value, "1/s", rate.error}, 2000.0);
  }
  // Ten parts: Student's t with 9 degrees lies within one standard error in 66 %.
  CHECK(coverage.one() > 0.57);
  CHECK(coverage.one() < k_one_high);
  CHECK(coverage.two() > k_two_low - 0.02);
}
