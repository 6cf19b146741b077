// SPDX-License-Identifier: Apache-2.0
#include "two_way.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace dust;
using test::TwoWay;
using test::World;

TEST_CASE("a bed of coarse grains shall have the pressure drop of those they stand for") {
  constexpr double k_width = 0.01;
  constexpr double k_height = 0.04;  // of the duct, the lower half is the bed
  constexpr double k_pitch = 1e-3;
  constexpr double k_diameter = 9e-4;
  constexpr double k_speed = 0.2;  // superficial
  const double solids = std::numbers::pi / 6.0 * std::pow(k_diameter / k_pitch, 3);
  const double eps = 1.0 - solids;
  for (const double ratio : {1.0, 3.0}) {
    CAPTURE(ratio);
    World::Choice choice;
    choice.max = {k_width, k_width, k_height};
    choice.cells = {2, 2, 8};
    choice.drag = "ergun";
    choice.coarse_graining = {ratio};
    TwoWay::Sides sides;
    for (int s = 0; s < 4; ++s) sides[s] = test::slip();
    sides[4] = test::wall({0, 0, k_speed / eps});  // the side's velocity is interstitial
    sides[5] = test::open_side(0.0, false);
    TwoWay run(choice, std::move(sides));
    for (int k = 0; k < 20; ++k) {
      for (int j = 0; j < 10; ++j) {
        for (int i = 0; i < 10; ++i) {
          run.world.grains.add({(i + 0.5) * k_pitch, (j + 0.5) * k_pitch, (k + 0.5) * k_pitch}, {},
                               k_diameter);
        }
      }
    }
    for (int n = 0; n < 60; ++n) run.step({}, true);
    const fluid::Grid& grid = run.world.grid;
    const auto& p = run.solver->pressure();
    const double drop = p[grid.index(0, 0, 0)] - p[grid.index(0, 0, grid.count[2] - 1)];
    const double d = k_diameter / ratio;
    const double law = (150.0 * test::k_air_viscosity * solids * solids * k_speed / (d * d) +
                        1.75 * test::k_air * solids * k_speed * k_speed / d) /
                       std::pow(eps, 3) * 0.5 * k_height;
    MESSAGE("1 for " << ratio * ratio * ratio << ": " << drop << " Pa, Ergun " << law << " Pa");
    // What the air wins by leaving the bed slower than it enters it is 0.22 % without coarse
    // grains.
    CHECK(drop == test::approx(law).epsilon(4e-3));
    CHECK(run.world.coupling->report().largest_imbalance < 1e-12);
  }
}

}  // namespace
