// SPDX-License-Identifier: Apache-2.0
// Boxes that dust comes from.
#include "airborne/dust_field.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace dust;
using airborne::DustField;
using airborne::Flow;
using fluid::Grid;

namespace {

/// A still box of 4 x 4 x 4 cells of 10 mm with walls all round, and one source of 1 mg/s.
struct Still {
  Grid grid = Grid::make({0, 0, 0}, {0.04, 0.04, 0.04}, {4, 4, 4}, {false, false, false});
  Flow flow{grid};
  scenario::DustFieldSpec spec;

  Still(sdk::Vec3 min, sdk::Vec3 max, double begin, double end) {
    spec.diameters = {5e-6};
    spec.density = 2650;
    spec.sources = {{"spring", min, max, {1e-6}, begin, end}};
    fill(1.0);
  }
  void fill(double volume) {
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const auto cell = static_cast<std::size_t>(grid.index(i, j, k));
          flow.volume_before[cell] = flow.volume_after[cell] = volume;
        }
      }
    }
  }
  [[nodiscard]] DustField field() const {
    return {grid, spec, {1.2, 1.8e-5}, {0, 0, -9.81}, {0, 6}};
  }
};

}  // namespace

TEST_CASE("dust in cells that a body covers shall go to the nearest ones with gas") {
  Still box({0, 0, 0}, {0.04, 0.04, 0.01}, 0.0, 1.0);
  DustField field = box.field();
  const auto cell = [&](int i) { return static_cast<std::int32_t>(box.grid.index(i, 1, 2)); };
  for (int i = 0; i < 4; ++i) field.release(0, cell(i), 1e-9 * (1 + i));
  // A body all over, but for two cells; what is left of them goes to the nearer one.
  box.fill(0.0);
  for (const int i : {2, 3}) box.flow.volume_after[static_cast<std::size_t>(cell(i))] = 0.5;
  field.leave_covered_cells(box.flow.volume_after);
  const double whole = box.grid.cell_volume();
  const auto held = [&](int i) { return whole * field.mass(0)[static_cast<std::size_t>(cell(i))]; };
  CHECK(held(0) == 0.0);
  CHECK(held(1) == 0.0);
  CHECK(held(2) == test::approx(6e-9));
  CHECK(held(3) == test::approx(4e-9));
  CHECK(field.balance(0).airborne == test::approx(1e-8));
}

TEST_CASE("a source shall need gas while it is active, and neither before nor after") {
  Still box({0, 0, 0}, {0.04, 0.04, 0.01}, 0.01, 0.02);
  DustField field = box.field();
  box.fill(0.0);
  field.advance(box.flow, 0.0, 0.01);
  box.fill(1.0);
  field.advance(box.flow, 0.01, 0.01);
  box.fill(0.0);
  field.advance(box.flow, 0.02, 0.01);
  CHECK(field.balance(0).released == test::approx(1e-8));
  DustField covered = box.field();
  CHECK_THROWS_WITH_AS(covered.advance(box.flow, 0.01, 0.01),
                       doctest::Contains("dust.field.sources.spring: there is no fluid"),
                       sdk::ModelError);
}

TEST_CASE("a flat source shall lie in one layer of cells, on every plane of the grid") {
  for (int plane = 0; plane <= 4; ++plane) {
    CAPTURE(plane);
    const double z = plane * 0.01;
    Still box({0, 0, z}, {0.04, 0.04, z}, 0.0, 1.0);
    DustField field = box.field();
    field.advance(box.flow, 0.0, 1e-4);
    CHECK(field.balance(0).released == test::approx(1e-10));
    CHECK(field.balance(0).airborne == test::approx(1e-10).epsilon(0.01));
    int layers = 0;
    for (int k = 0; k < 4; ++k) {
      const auto cell = static_cast<std::size_t>(box.grid.index(1, 1, k));
      // What settles in the step is a hundredth of a cell's.
      if (field.mass(0)[cell] > 0.5 * 1e-10 / (16 * box.grid.cell_volume())) ++layers;
    }
    CHECK(layers == 1);
  }
}
