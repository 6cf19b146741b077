// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/fluid_cells.hpp"
#include "run/snapshots/columns.hpp"
#include "support/approx.hpp"
#include "verification/fluid/fluid_case.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace {

using namespace dust;

TEST_CASE("what flows through an uneven bed shall be the same in each of its layers") {
  constexpr double k_superficial = 0.3;
  for (const int axis : {0, 1, 2}) {
    CAPTURE(axis);
    test::Case c;
    c.max = {0.02, 0.02, 0.02};
    c.max[axis] = 0.1;
    c.cells = {4, 4, 4};
    c.cells[axis] = 20;
    c.fluid.density = 1.2;
    c.fluid.viscosity = 1.8e-5;
    c.fluid.pressure_tolerance = 1e-11;
    for (int s = 0; s < 6; ++s) c.sides[s] = test::slip();
    sdk::Vec3 inlet;
    inlet[axis] = k_superficial / 0.45;  // of the bed's first layer
    c.sides[2 * axis] = test::wall(inlet);
    c.sides[2 * axis + 1] = test::open_side(0.0, false);
    c.start();
    // The bed lies on the inlet; its layers differ, and above it is air.
    for (int k = 0; k < c.cells[2]; ++k) {
      for (int j = 0; j < c.cells[1]; ++j) {
        for (int i = 0; i < c.cells[0]; ++i) {
          const int layer = std::array{i, j, k}[static_cast<std::size_t>(axis)];
          if (layer < 12) c.eps[c.grid.index(i, j, k)] = layer % 2 == 0 ? 0.45 : 0.38;
        }
      }
    }
    for (int n = 0; n < 50; ++n) c.advance(1e-3);
    run::FluidTable table(c.grid, c.fluid, c.solver->open_fraction());
    table.publish(*c.solver, c.eps);
    const sdk::FluidColumns columns = table.columns();
    const sdk::FluidCells cells(columns);
    for (const double x : {0.0, 2.5e-3, 0.021, 0.055, 0.0575, 0.062, 0.099, 0.1}) {
      CAPTURE(x);
      // Single precision of the columns.
      CHECK(cells.superficial_velocity(axis, x) == test::approx(k_superficial).epsilon(1e-6));
    }
  }
}

}  // namespace
