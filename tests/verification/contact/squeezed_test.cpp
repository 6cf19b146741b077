// SPDX-License-Identifier: Apache-2.0
// A small grain caught between a lump and a plate, as in a chute, against the energy of its two
// Hertzian contacts (Johnson, Contact Mechanics, 1985, section 4.2): what the largest overlap of a
// run tells.
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_young = 50e6;
constexpr double k_poisson = 0.25;
constexpr double k_density = 2650.0;
constexpr double k_small = 0.004;  ///< radius [m]

/// Stiffness of a Hertzian contact, force over overlap^1.5 [N/m^1.5], of two bodies of the same
/// material with the effective radius [m].
double stiffness(double young, double radius) {
  const double effective = young / (2.0 * (1.0 - k_poisson * k_poisson));
  return 4.0 / 3.0 * effective * std::sqrt(radius);
}

/// The larger of both overlaps [m] when the lump stands still: 0.5 m v^2 = sum of 0.4 k d^2.5, and
/// the light grain between passes the force on, so that k d^1.5 is the same.
double expected_overlap(double young, double lump, double speed) {
  const double at_lump = stiffness(young, k_small * lump / (k_small + lump));
  const double at_plate = stiffness(young, k_small);
  const double mass = k_density * 4.0 / 3.0 * std::numbers::pi * std::pow(lump, 3);
  const double share =
      std::pow(at_lump / at_plate, 2.0 / 3.0);  // overlap at the plate over the other
  const double sum = at_lump + at_plate * std::pow(share, 2.5);
  return std::max(1.0, share) * std::pow(0.5 * mass * speed * speed / (0.4 * sum), 0.4);
}

/// The largest overlap [m] in steps as a run's would be, and finer.
double run(double young, double lump, double speed) {
  DemRig rig;
  const int stone = rig.material(k_density, young, k_poisson);
  const int plate = rig.material(k_density, young, k_poisson);
  rig.law(stone, stone, 1.0, 0.0);
  rig.law(stone, plate, 1.0, 0.0);
  rig.diameters = {2.0 * k_small, 2.0 * lump};
  rig.setup.time.dem_step = 2e-6;
  rig.setup.time.expected_speed = 2.0 * speed;
  rig.setup.domain.min.x = 0.0;
  rig.wall(0, plate);
  auto dem = rig.make();
  constexpr double k_gap = 1e-6;
  std::vector<dust::particles::NewGrain> grains;
  grains.push_back(
      {.position = {k_small + k_gap, 0, 0}, .diameter = 2.0 * k_small, .material = stone});
  grains.push_back({.position = {2.0 * k_small + lump + 2.0 * k_gap, 0, 0},
                    .velocity = {-speed, 0, 0},
                    .diameter = 2.0 * lump,
                    .material = stone});
  dem->insert(grains);
  Stepper stepper(*dem);
  double largest = 0.0;
  for (int n = 0; n < 20000; ++n) {
    stepper.step();
    const double small_at = grain(*dem, 0).position.x;
    const double lump_at = grain(*dem, 1).position.x;
    largest = std::max({largest, k_small - small_at, k_small + lump - (lump_at - small_at)});
    if (lump_at > 2.0 * k_small + lump + 1e-4) break;  // it has come off
  }
  return largest;
}

}  // namespace

TEST_CASE(
    "a grain caught between a lump and a plate shall sink in by what the lump's energy asks") {
  struct Row {
    double young, lump, speed;
  };
  // Lumps of 60 and 45 mm on 8 mm: beyond half of its radius at the speeds of a chute.
  for (const Row& r : {Row{k_young, 0.03, 0.5}, Row{k_young, 0.03, 2.0}, Row{k_young, 0.0225, 2.0},
                       Row{10.0 * k_young, 0.03, 2.0}}) {
    const double expected = expected_overlap(r.young, r.lump, r.speed);
    CAPTURE(expected / k_small);
    // The grain's own inertia, 1/420 of the lump's, adds an oscillation.
    CHECK(run(r.young, r.lump, r.speed) == approx(expected).epsilon(0.05));
  }
  CHECK(expected_overlap(k_young, 0.03, 2.0) > 0.6 * k_small);
  // Ten times the stiffness takes 60 % off, no more: the power 0.4.
  CHECK(expected_overlap(10.0 * k_young, 0.03, 2.0) ==
        approx(std::pow(10.0, -0.4) * expected_overlap(k_young, 0.03, 2.0)));
}
