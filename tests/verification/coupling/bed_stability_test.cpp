// SPDX-License-Identifier: Apache-2.0
// Air through a held bed that several columns of cells side by side share: a fluid step is many
// times the relaxation of the air, and drag grows faster than the slip.
#include "two_way.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace dust;
using test::TwoWay;
using test::World;

constexpr double k_width = 0.04;
constexpr double k_height = 0.02;
constexpr double k_pitch = 1e-3;
constexpr double k_diameter = 9e-4;

/// Velocity in the middle of a bed that fills the duct: largest less smallest, over the mean, after
/// `steps` fluid steps of `step` [s].
double unevenness(double superficial, double step, bool overlaps, const std::string& set) {
  World::Choice choice;
  choice.max = {k_width, 5e-3, k_height};
  choice.cells = {8, 1, 4};
  choice.drag = "ergun";
  choice.fluid_step = step;
  choice.overlaps = overlaps;
  choice.momentum_set = set;
  const double eps = 1.0 - std::numbers::pi / 6.0 * std::pow(k_diameter / k_pitch, 3);
  TwoWay::Sides sides;
  for (int s = 0; s < 4; ++s) sides[s] = test::slip();
  sides[4] = test::wall({0, 0, superficial / eps});
  sides[5] = test::open_side(0.0, false);
  TwoWay run(choice, std::move(sides));
  // Errors need a beginning: one grain is missing.
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 40; ++i) {
        if (k == 10 && j == 2 && i == 12) continue;
        run.world.grains.add({(i + 0.5) * k_pitch, (j + 0.5) * k_pitch, (k + 0.5) * k_pitch}, {},
                             k_diameter);
      }
    }
  }
  for (int n = 0; n < 200; ++n) run.step({}, true);
  const fluid::Grid& grid = run.world.grid;
  double low = 1e30;
  double high = -1e30;
  for (int i = 0; i < 8; ++i) {
    const double w = run.world.velocity.component[2][grid.index(i, 0, 2)];
    low = std::min(low, w);
    high = std::max(high, w);
  }
  return (high - low) / (superficial / eps);
}

TEST_CASE("air shall flow evenly through an even bed, however long the step and fast the air") {
  // One grain of 125 in a cell opens that by 1 %, its resistance sinks by a tenth of that times
  // ten.
  constexpr double k_of_one_grain = 0.1;
  for (const bool overlaps : {false, true}) {
    for (const std::string set : {"I", "III"}) {
      // The share of inertia in the drag is 0.04, 0.3 and 0.8.
      for (const double superficial : {0.05, 0.5, 5.0}) {
        for (const double step : {1e-4, 5e-4, 2e-3}) {
          CAPTURE(overlaps);
          CAPTURE(set);
          CAPTURE(superficial);
          CAPTURE(step);
          CHECK(unevenness(superficial, step, overlaps, set) < k_of_one_grain);
        }
      }
    }
  }
}

}  // namespace
