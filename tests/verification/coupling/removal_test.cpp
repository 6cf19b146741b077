// SPDX-License-Identifier: Apache-2.0
// A body that is taken away from grains at rest leaves the air at rest.
#include "two_way.hpp"
#include "verification/fluid/test_bodies.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace dust;
using namespace dust::test;

TEST_CASE("taking a body away from grains at rest shall leave the air at rest") {
  constexpr double cell = 5e-3;
  constexpr double diameter = 6e-4;
  for (const double step : {1e-3, 1e-4}) {
    CAPTURE(step);
    World::Choice choice;
    choice.max = {8 * cell, 4 * cell, 4 * cell};
    choice.cells = {8, 4, 4};
    choice.periodic = {false, true, true};
    choice.voidage = "centre";
    choice.fluid_step = step;
    TwoWay::Sides sides;
    sides[0] = slip();
    sides[1] = open_side(0.0, false);
    bodies::BodySet solids;
    // Leaves 0.6 of the third layer of cells open.
    solids.push_back(
        body(std::make_unique<HalfSpace>(sdk::Vec3{2.4 * cell, 0, 0}, sdk::Vec3{1, 0, 0}), 0.0));
    TwoWay it(choice, std::move(sides), {}, 1e-10, std::move(solids));
    it.hold_fluid();
    for (int n = 0; n < 60; ++n) {
      it.world.grains.add({2.6 * cell + 1e-5 * n, 3.1e-4 * n, 1.7e-4 * n + 1e-3}, {}, diameter);
    }
    const auto largest_speed = [&] {
      double largest = 0.0;
      it.world.for_cells([&](int i, int j, int k) {
        const std::ptrdiff_t o = it.world.grid.index(i, j, k);
        for (const auto& component : it.solver->velocity().component) {
          largest = std::max(largest, std::abs(component[o]));
        }
      });
      return largest;
    };
    for (int n = 0; n < 3; ++n) it.step({}, true);
    const double before = largest_speed();
    it.bodies[0].removed_at = it.time;
    it.solver->bodies_changed(it.time);
    it.world.open = it.solver->open_fraction();
    it.world.coupling->bodies_changed(it.world.open);
    it.step({}, true);
    CHECK(before < 1e-9);
    CHECK(largest_speed() < 1e-9);
  }
}
