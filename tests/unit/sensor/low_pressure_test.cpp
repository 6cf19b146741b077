// SPDX-License-Identifier: Apache-2.0
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;

namespace {

const SensorKind& kind() {
  static const SensorKind loaded = load_sensor("low_pressure");
  return loaded;
}

struct Well {
  int i, j, k;
  double depth;
};

/// A sum of Gaussian wells 4 cells wide.
void dig(World& world, const std::vector<Well>& wells) {
  for (int k = 0; k < world.count[2]; ++k) {
    for (int j = 0; j < world.count[1]; ++j) {
      for (int i = 0; i < world.count[0]; ++i) {
        double p = 0.0;
        for (const Well& w : wells) {
          const double r2 = std::pow(i - w.i, 2) + std::pow(j - w.j, 2) + std::pow(k - w.k, 2);
          p -= w.depth * std::exp(-r2 / 32.0);
        }
        world.pressure_at(i, j, k) = static_cast<float>(p);
      }
    }
  }
}

/// The mean of 27 cells over a well of this shape: exp(-r2/32) averaged over -1, 0, 1 per
/// direction.
double smoothed_share() {
  const double per_direction = (1.0 + 2.0 * std::exp(-1.0 / 32.0)) / 3.0;
  return std::pow(per_direction, 3);
}

}  // namespace

TEST_CASE("wells of pressure shall be found in place, depth and order") {
  const auto sensor = kind().make({{"count", std::int64_t{3}}});
  World world;
  world.set_cells(60, 20, 40);
  dig(world, {{12, 10, 20, 0.3}, {45, 10, 10, 0.5}});
  for (int s = 0; s < 100; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["found"] == 2.0);
  CHECK(figures["place_1/x"] == doctest::Approx(0.0455).epsilon(1e-12));
  CHECK(figures["place_1/y"] == doctest::Approx(0.0105).epsilon(1e-12));
  CHECK(figures["place_1/z"] == doctest::Approx(0.0105).epsilon(1e-12));
  // Floats carry 7 digits.
  CHECK(figures["place_1/depth"] == doctest::Approx(0.5 * smoothed_share()).epsilon(1e-6));
  CHECK(figures["place_1/pressure_over_density"] ==
        doctest::Approx(-0.5 * smoothed_share() / 1.2).epsilon(1e-6));
  CHECK(figures["place_2/x"] == doctest::Approx(0.0125).epsilon(1e-12));
  CHECK(figures["place_2/depth"] == doctest::Approx(0.3 * smoothed_share()).epsilon(1e-6));
  CHECK(figures["place_3/depth"] == 0.0);
  CHECK(figures.at("place_1/depth").uncertainty < 1e-9);
  CHECK(series_of(*sensor)["lowest_pressure"] == doctest::Approx(-0.5).epsilon(1e-6));
}

TEST_CASE("solid cells and neighbours of deeper wells shall not be reported") {
  const auto sensor = kind().make({{"count", std::int64_t{5}}, {"separation", 0.015}});
  World world;
  world.set_cells(60, 3, 40);
  // Fourteen cells of 1 mm from the deepest one, and a well inside a body.
  dig(world, {{20, 1, 20, 0.5}, {34, 1, 20, 0.4}});
  world.pressure_at(50, 1, 30) = -9.0f;
  world.open_fraction[50 + 60 * (1 + 3 * 30)] = 0.0f;
  step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["found"] == 1.0);
  CHECK(figures["place_1/x"] == doctest::Approx(0.0205).epsilon(1e-9));
  CHECK(series_of(*sensor)["lowest_pressure"] > -1.0);
  const auto nearer = kind().make({{"count", std::int64_t{5}}, {"separation", 0.005}});
  world.time = 0.0;
  step(*nearer, world);
  CHECK(summary_of(*nearer)["found"] == 2.0);
}

TEST_CASE("pressure before the averaging shall not count") {
  const auto sensor = kind().make({{"averaging_after", 0.05}});
  World world;
  world.set_cells(20, 3, 20);
  dig(world, {{5, 1, 5, 9.0}});
  for (int s = 0; s < 50; ++s) step(*sensor, world);
  dig(world, {{14, 1, 14, 0.25}});
  for (int s = 0; s < 50; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["found"] == 1.0);
  CHECK(figures["place_1/x"] == doctest::Approx(0.0145).epsilon(1e-9));
}

TEST_CASE("the error of a depth shall cover the truth at its rate") {
  Coverage coverage;
  World world;
  world.set_cells(9, 3, 9);
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    const auto sensor = kind().make({{"count", std::int64_t{1}}});
    world.time = 0.0;
    for (int s = 0; s < 400; ++s) {
      // The whole well rises and falls: no cell overtakes another, so that the minimum stays put.
      dig(world, {{4, 1, 4, 1.0 + 0.3 * dice.normal()}});
      step(*sensor, world);
    }
    coverage.add(summary_of(*sensor).at("place_1/depth"), smoothed_share());
  }
  CHECK(coverage.without_error == 0);
  CHECK(coverage.one() > k_one_low);
  CHECK(coverage.one() < k_one_high);
  CHECK(coverage.two() > k_two_low);
}
