// SPDX-License-Identifier: Apache-2.0
// Grains on a sheet thinner than a cell act on the fluid of their own side alone.
#include "two_way.hpp"
#include "verification/fluid/test_bodies.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_cell = 5e-3;       // m
constexpr int k_cells = 8;            // along x and z
constexpr double k_thickness = 5e-4;  // m, of the sheet
constexpr double k_diameter = 6e-4;   // m

/// Air over and under a sheet across a box that is periodic in x and y.
TwoWay air_beside_sheet(double height, const std::string& voidage) {
  World::Choice choice;
  choice.max = {k_cells * k_cell, 4 * k_cell, k_cells * k_cell};
  choice.cells = {k_cells, 4, k_cells};
  choice.periodic = {true, true, false};
  choice.voidage = voidage;
  TwoWay::Sides sides;
  sides[4] = slip();
  sides[5] = slip();
  bodies::BodySet solids;
  solids.push_back(
      body(std::make_unique<Plate>(sdk::Vec3{0, 0, height}, sdk::Vec3{0, 0, 1}, k_thickness), 0.0));
  return {choice, std::move(sides), {}, 1e-8, std::move(solids)};
}

/// First layer of cells over the sheet.
int first_layer(double height) { return static_cast<int>(std::ceil(height / k_cell - 0.5)); }

}  // namespace

TEST_CASE("grains on a sheet shall leave the fluid under it alone") {
  // The sheet in the lower part of a layer of cells, in its upper part, and on a face of the grid.
  for (const double height : {0.0202, 0.0238, 0.0200}) {
    for (const std::string voidage : {"centre", "divided"}) {
      CAPTURE(height);
      CAPTURE(voidage);
      TwoWay it = air_beside_sheet(height, voidage);
      const int above = first_layer(height);
      it.solver->set_velocity([&](sdk::Vec3 p) {
        return sdk::Vec3{p.z > height ? 2.0 : 0.0, 0, 0};
      });
      it.hold_fluid();
      const double z = height + 0.5 * k_thickness + 0.5 * k_diameter;
      for (int n = 0; n < 40; ++n) {
        it.world.grains.add({1e-3 * n, 0.37e-3 * n, z + 1e-5 * n}, {}, k_diameter);
      }
      for (int n = 0; n < 5; ++n) it.step({}, true);
      std::vector<float> exchange(3 * k_cells * 4 * k_cells);
      it.world.coupling->momentum_exchange(exchange);
      double solids = 0.0, force = 0.0;
      it.world.for_cells([&](int i, int j, int k) {
        const std::ptrdiff_t o = it.world.grid.index(i, j, k);
        const double own = 1.0 - it.world.coupling->void_fraction()[o];
        const float* f = exchange.data() + 3 * (i + k_cells * (j + 4 * k));
        if (k < above) {
          CHECK(own == 0.0);
          for (int d = 0; d < 3; ++d) CHECK(f[d] == 0.0F);
          CHECK(it.solver->velocity().component[0][o] == 0.0);
        }
        solids += own * it.world.grid.cell_volume() * it.solver->open_fraction()[o];
        force += f[0];
      });
      CHECK(solids == approx(it.world.grains.solid_volume()).epsilon(1e-9));
      CHECK(force < 0.0);
    }
  }
}

TEST_CASE("what finds no room over a sheet shall not go under it") {
  // A layer one and a half cells deep with 0.6 of solids on a sheet just over the middle of its
  // cells: all of it counts for the cells from the next face on, which have no room for it.
  constexpr double spacing = 5.8e-4;
  for (const double height : {0.0226, 0.0238}) {
    CAPTURE(height);
    TwoWay it = air_beside_sheet(height, "centre");
    it.hold_fluid();
    const double floor = height + 0.5 * k_thickness + 0.5 * k_diameter;
    for (double z = floor; z < height + 1.5 * k_cell; z += spacing) {
      for (double y = 0.5 * spacing; y < 4 * k_cell; y += spacing) {
        for (double x = 0.5 * spacing; x < k_cells * k_cell; x += spacing) {
          it.world.grains.add({x, y, z}, {}, k_diameter);
        }
      }
    }
    it.step({}, true);
    double solids = 0.0, largest = 0.0;
    it.world.for_cells([&](int i, int j, int k) {
      const std::ptrdiff_t o = it.world.grid.index(i, j, k);
      const double own = 1.0 - it.world.coupling->void_fraction()[o];
      if (k < first_layer(height)) CHECK(own == 0.0);
      solids += own * it.world.grid.cell_volume() * it.solver->open_fraction()[o];
      largest = std::max(largest, own);
    });
    CHECK(largest > 0.699);  // there was something to move
    CHECK(solids == approx(it.world.grains.solid_volume()).epsilon(1e-9));
  }
}

TEST_CASE("a grain on a sheet shall not feel the fluid under it") {
  for (const double height : {0.0202, 0.0238, 0.0200}) {
    CAPTURE(height);
    TwoWay it = air_beside_sheet(height, "divided");
    it.solver->set_velocity([&](sdk::Vec3 p) { return sdk::Vec3{p.z < height ? 2.0 : 0.0, 0, 0}; });
    it.hold_fluid();
    const double beside = 0.5 * k_thickness + 0.5 * k_diameter + 1e-5;
    it.world.grains.add({0.011, 0.007, height + beside}, {}, k_diameter);
    it.world.grains.add({0.021, 0.012, height - beside}, {}, k_diameter);
    it.step({}, true);
    CHECK(it.world.grains.action[0] == 0.0);
    CHECK(it.world.grains.action[4] > 1.0);
  }
}
