// SPDX-License-Identifier: Apache-2.0
// Height and fluidisation of beds whose answer is known.
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

void fill(SyntheticScene& world, double low, double high, int count, double mass, double weight,
          double diameter = 300e-6) {
  for (int n = 0; n < count; ++n) {
    Grain g;
    g.now = {0.01, 0.005, low + (high - low) * (n + 0.5) / count};
    g.before = g.now;
    g.mass = mass;
    g.weight = weight;
    g.diameter = diameter;
    world.grains.push_back(g);
  }
}

}  // namespace

TEST_CASE("bed_height shall be that of a uniform column, by share and by centre") {
  SyntheticScene world;
  fill(world, 0.02, 0.12, 20000, 1e-9, 1.0);
  const auto sensor =
      load_sensor("bed_height").make({{"base", Vec3{0.3, 0, 0.02}}, {"share", 0.9}});
  for (int s = 0; s < 10; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  // To a 4096th of what the grains span.
  CHECK(figures["height"] == test::approx(0.09).epsilon(3e-4));
  CHECK(figures["twice_centre"] == test::approx(0.1).epsilon(1e-6));
  CHECK(figures["height_at_end"] == test::approx(figures["height"]).epsilon(1e-12));
}

TEST_CASE("bed_height shall count masses with weights and look along its direction") {
  SyntheticScene world;
  // A heavy layer of 40 mm under a light one of 60: masses 3 : 1.
  fill(world, 0.0, 0.04, 4000, 1e-9, 3.0);
  fill(world, 0.04, 0.10, 4000, 2e-9, 0.5);
  const auto half = load_sensor("bed_height").make({{"base", Vec3{}}, {"share", 0.5}});
  step(*half, world);
  CHECK(series_of(*half)["height"] == test::approx(0.04 * 0.5 / 0.75).epsilon(1e-3));
  CHECK(series_of(*half)["twice_centre"] ==
        test::approx(2 * (0.75 * 0.02 + 0.25 * 0.07)).epsilon(1e-6));
  for (Grain& g : world.grains) g.now = {g.now.z, 0, -5.0};
  const auto sideways = load_sensor("bed_height")
                            .make({{"base", Vec3{}}, {"share", 1.0}, {"direction", Vec3{2, 0, 0}}});
  step(*sideways, world);
  CHECK(series_of(*sideways)["height"] == test::approx(0.1).epsilon(1e-3));
}

namespace {

/// A bed that costs 2000 Pa/(m/s) until it is fluid at 0.3 m/s, then 600 Pa; it grows from 0.1 m by
/// 0.2 m/(m/s) beyond. Optionally a hump where it locks, noise and swings.
struct Ramp {
  double hump = 0.0;
  double noise = 0.0;
  double swing = 0.0;     ///< of the fluid bed's pressure
  bool compacts = false;  ///< on the way down throughout: its lines of height cross at 0.04 m/s

  [[nodiscard]] double pressure(double u, double random) const {
    double p = u < 0.3 ? 2000.0 * u : 600.0;
    if (u > 0.27 && u < 0.33) p += hump * (1.0 - std::abs(u - 0.3) / 0.03);
    if (u > 0.3) p += swing * 600.0 * (random - 0.5);
    return p + noise * 600.0 * (random - 0.5);
  }
  [[nodiscard]] double height(double u) const {
    if (compacts) return u < 0.3 ? 0.1002 + 0.01 * u : 0.1 + 0.015 * u;
    return 0.1 + 0.2 * std::max(0.0, u - 0.3);
  }
};

Figures run(const Ramp& ramp, const std::vector<double>& velocities, int samples,
            const std::map<std::string, sdk::Value>& more = {}) {
  std::map<std::string, sdk::Value> parameters = {{"from", Vec3{0, 0, 0.0105}},
                                                  {"to", Vec3{0, 0, 0.0305}}};
  parameters.insert(more.begin(), more.end());
  const auto sensor = load_sensor("minimum_fluidisation").make(parameters);
  const sdk::Random random(5, sdk::stream_of("ramp"));
  SyntheticScene world;
  world.domain_max = {0.004, 0.003, 0.04};
  set_cells(world, 4, 3, 40);
  for (float& e : world.void_fraction) e = 0.5f;
  fill(world, 0.0105, 0.1105, 200, 1e-9, 1.0);
  for (int s = 0; s < samples; ++s) {
    const double at = static_cast<double>(s) / (samples - 1) * (velocities.size() - 1);
    const auto low = std::min(velocities.size() - 2, static_cast<std::size_t>(at));
    const double u = velocities[low] + (at - low) * (velocities[low + 1] - velocities[low]);
    const double drop = ramp.pressure(u, random.uniform(static_cast<std::uint64_t>(s), 0));
    for_cells(world, [&](std::size_t c, Vec3 x) {
      world.velocity[2][c] = static_cast<float>(2.0 * u);  // half of it is void
      world.pressure[c] = static_cast<float>(drop * (0.0305 - x.z) / 0.02);
    });
    const double stretch = ramp.height(u) / 0.1;
    for (std::size_t n = 0; n < world.grains.size(); ++n) {
      world.grains[n].now.z = 0.0105 + 0.1 * stretch * (n + 0.5) / world.grains.size();
    }
    step(*sensor, world);
  }
  return summary_of(*sensor);
}

}  // namespace

TEST_CASE("minimum_fluidisation shall find the crossing of the lines, up and down") {
  const Figures figures = run({}, {0.05, 0.6, 0.05}, 4001);
  for (const std::string way : {"rising/", "falling/"}) {
    CAPTURE(way);
    CHECK(figures[way + "by_pressure"] == test::approx(0.3).epsilon(1e-3));
    // The packed bed's height is fitted where it is packed for sure, the fluid one's where fluid.
    CHECK(figures[way + "by_height"] == test::approx(0.3).epsilon(1e-3));
    CHECK(figures[way + "plateau"] == test::approx(600.0).epsilon(1e-4));
  }
}

TEST_CASE("minimum_fluidisation shall not be misled by a hump or by noise") {
  const Figures hump = run({.hump = 120.0}, {0.05, 0.6}, 3000);
  CHECK(hump["rising/by_pressure"] == test::approx(0.3).epsilon(2e-3));
  CHECK(is_of_nothing(hump.at("falling/by_pressure")));
  const Figures noisy = run({.noise = 0.2}, {0.6, 0.05}, 2000);
  const Figure& found = noisy.at("falling/by_pressure");
  CHECK(found.uncertainty > 0.0);
  CHECK(found.uncertainty < 0.01);
  CHECK(std::abs(found.value - 0.3) < 3.0 * found.uncertainty);
}

TEST_CASE("minimum_fluidisation shall not take the swings of a bubbling bed for a packed one") {
  for (const double swing : {0.5, 1.0}) {
    CAPTURE(swing);
    const Figures figures = run({.swing = swing}, {0.6, 0.05}, 4000);
    const Figure& found = figures.at("falling/by_pressure");
    CHECK(std::abs(found.value - 0.3) < 3.0 * found.uncertainty);
    CHECK(found.uncertainty < 0.01);
    CHECK(figures["falling/plateau"] == test::approx(600.0).epsilon(0.02));
  }
}

TEST_CASE("minimum_fluidisation shall say nothing where the ramp does not reach both states") {
  CHECK(is_of_nothing(run({}, {0.05, 0.25}, 1000).at("rising/by_pressure")));
  CHECK(is_of_nothing(run({}, {0.4, 0.6}, 1000).at("rising/by_pressure")));
  CHECK(is_of_nothing(run({}, {0.3, 0.3}, 100).at("rising/by_pressure")));
  CHECK(is_of_nothing(run({}, {0.3, 0.3}, 100).at("rising/plateau")));
}

TEST_CASE("minimum_fluidisation shall not tell of a crossing at velocities it has not seen") {
  const Figures figures = run({.compacts = true}, {0.6, 0.05}, 3000);
  CHECK(is_of_nothing(figures.at("falling/by_height")));
  CHECK(figures["falling/by_pressure"] == test::approx(0.3).epsilon(1e-3));
}
