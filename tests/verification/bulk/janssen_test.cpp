// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "verification/bulk/bulk_run.hpp"

#include <numbers>

namespace {

using dust::test::approx;
using dust::test::BulkRun;

constexpr double k_gravity = 9.81;  // [m/s2]
constexpr double k_width = 0.01;    // [m] of the tube

double weight(const BulkRun& run) {
  return k_gravity * run.summary["mass_kg"]["in_domain"].get<double>();
}
/// [N] What floor and tube carry.
double floor_load(const BulkRun& run) { return -run.figure("floor_load", "force_z"); }
double tube_load(const BulkRun& run) { return -run.figure("tube_load", "force_z"); }

/// Middle of each box with a stress sensor, in mm above the floor before it sank.
constexpr int k_places[] = {2, 8, 14, 20, 26, 32};

/// [Pa] Mean vertical stress over the tube's cross-section; the boxes are as wide as the tube.
double stress_at(const BulkRun& run, int place) {
  return 4 / std::numbers::pi * run.figure("at_" + std::to_string(place), "zz");
}

}  // namespace

TEST_CASE("a column between smooth walls shall rest on the floor with its whole weight") {
  const BulkRun run("janssen", {"interactions[1].contact.friction=0", "bodies.floor.start=1 s"});
  // Nothing but collisions stills a column between smooth walls: it swings with a period of 23 ms.
  // A smooth window over six periods lets less than 1e-3 of the swing through.
  const auto time = run.column("time [s]");
  const auto force = run.column("floor_load/force_z [N]");
  double load = 0.0;
  double weights = 0.0;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (time[n] < 0.18) continue;
    const double w = std::pow(std::sin(std::numbers::pi * (time[n] - 0.18) / 0.14), 2);
    load -= w * force[n];
    weights += w;
  }
  CHECK(load / weights == approx(weight(run)).epsilon(0.01));
  // Smooth walls carry nothing upright: their forces are level.
  CHECK(std::abs(tube_load(run)) < 1e-9 * weight(run));
  // The stress grows with the weight above: dp/dz = rho_b g between boxes well inside the bed.
  const double bulk = 4 / std::numbers::pi * run.figure("at_14", "bulk_density");
  const double rise = (stress_at(run, 8) - stress_at(run, 26)) / 18e-3;
  // 5 %: some ten layers of grains in between, of which half a layer counts here or there.
  CHECK(rise == approx(bulk * k_gravity).epsilon(0.05));
}

TEST_CASE("a column between rough walls shall hang on them as Janssen says") {
  const BulkRun run("janssen");
  CHECK(floor_load(run) + tube_load(run) == approx(weight(run)).epsilon(0.01));
  CHECK(floor_load(run) < 0.6 * weight(run));
  // sigma = rho_b g L (1 - exp(-z/L)), z from the free surface; L by least squares.
  const double bulk = 4 / std::numbers::pi * run.figure("at_14", "bulk_density");
  const double area = std::numbers::pi / 4 * k_width * k_width;
  const double top = weight(run) / (bulk * k_gravity * area) - 0.5e-3;
  const auto stress = [&](double depth, double length) {
    return bulk * k_gravity * length * (1 - std::exp(-depth / length));
  };
  double best = 0.0;
  double least = 1e300;
  for (double length = 2e-3; length < 0.1; length *= 1.01) {
    double squares = 0.0;
    for (const int place : k_places) {
      const double off = stress(top - 1e-3 * place, length) - stress_at(run, place);
      squares += off * off;
    }
    if (squares < least) {
      least = squares;
      best = length;
    }
  }
  const double k = k_width / (4 * 0.5 * best);
  CAPTURE(best);
  CAPTURE(k);
  CHECK(k > 0.3);
  CHECK(k < 0.8);
  // Saturation: two diameters of weight between the lowest box and the middle one add little.
  CHECK(stress_at(run, 2) < 1.35 * stress_at(run, 20));
  CHECK(stress_at(run, 2) < 0.6 * bulk * k_gravity * (top - 2e-3));
}
