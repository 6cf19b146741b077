// SPDX-License-Identifier: Apache-2.0
// What passes the faces of cells, as sensors see it, and what `air_flow` makes of it.
#include "run/snapshots/face_table.hpp"
#include "run/snapshots/columns.hpp"
#include "sensor/air_flow/air_flow.hpp"
#include "support/approx.hpp"
#include "verification/fluid/fluid_case.hpp"
#include "verification/fluid/test_bodies.hpp"

#include <doctest/doctest.h>

namespace {

using namespace dust;
using run::FaceTable;
using sdk::Vec3;

/// Single precision of the columns; the pressure is solved to 1e-11.
constexpr double k_single = 1e-6;

/// The fluid as sensors see it.
class Seen {
 public:
  Seen(const test::Case& c, FaceTable::Moment moment)
      : cells_(c.grid, c.fluid, c.solver->open_fraction()), faces_(c.grid) {
    cells_.publish(*c.solver, c.eps);
    faces_.publish(*c.solver, c.eps, moment);
  }
  [[nodiscard]] model::air_flow::Passing through(int axis, Vec3 min, Vec3 max) const {
    sdk::FluidColumns fluid = cells_.columns();
    fluid.faces = faces_.columns();
    return model::air_flow::through(fluid, axis, min, max);
  }

 private:
  run::FluidTable cells_;
  FaceTable faces_;
};

constexpr double k_duct_velocity = 0.3;  // [m/s]

/// A duct of 100 mm along x in cells of 5 mm, with a bed at the inlet whose layers differ, a bar
/// that cuts cells and a wall that leaves the upper 20 of 50 mm open; its faces lie within cells.
test::Case blocked_duct() {
  test::Case c;
  c.max = {0.1, 0.02, 0.05};
  c.cells = {20, 4, 10};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-11;
  c.sides[0] = test::wall({k_duct_velocity / 0.45, 0, 0});
  c.sides[1] = test::open_side(0.0, false);
  for (int s = 2; s < 6; ++s) c.sides[s] = s < 4 ? test::slip() : test::wall();
  c.bodies.push_back(
      test::body(std::make_unique<test::Cylinder>(Vec3{0.0337, 0, 0.021}, 0.0083, false), 0.0));
  c.bodies.push_back(
      test::body(std::make_unique<test::Plate>(Vec3{0.062, 0, 0}, Vec3{1, 0, 0}, 0.02, 0.03), 0.0));
  c.start();
  for (int k = 0; k < c.cells[2]; ++k) {
    for (int j = 0; j < c.cells[1]; ++j) {
      for (int i = 0; i < 4; ++i) c.eps[c.grid.index(i, j, k)] = i % 2 == 0 ? 0.45 : 0.38;
    }
  }
  return c;
}

/// A hood in a ceiling at 603 mm that draws 60 m3/h through 139 x 115 mm.
test::Case hood(double cell) {
  test::Case c;
  c.min = {-0.6, -0.24, 0};
  c.max = {0.72, 0.24, 0.66};
  for (int d = 0; d < 3; ++d) {
    c.cells[static_cast<std::size_t>(d)] =
        static_cast<int>(std::lround((c.max[d] - c.min[d]) / cell));
  }
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-10;
  for (int s = 0; s < 6; ++s) c.sides[s] = s < 4 ? test::open_side(0.0, true) : test::wall();
  c.bodies.push_back(
      test::body(std::make_unique<test::HalfSpace>(Vec3{0, 0, 0.603}, Vec3{0, 0, -1}), 0.0));
  c.bodies.back().suction =
      scenario::SuctionSpec{60.0 / 3600.0, {0.061, -0.06, 0.603}, {0.2, 0.055, 0.603}, {}, {}};
  c.start();
  return c;
}

TEST_CASE("air_flow shall be the same through every section of a duct, within cells too") {
  test::Case c = blocked_duct();
  for (int n = 0; n < 40; ++n) c.advance(1e-3);
  const Seen seen(c, FaceTable::Moment::after_step);
  const double flow = k_duct_velocity * c.max.y * c.max.z;
  // On the sides, in and beside the bed and the bar, on planes of faces, before, in and behind the
  // wall from 52 to 72 mm.
  for (const double x :
       {0.0,    0.0013, 0.01,  0.0188, 0.0256, 0.0301, 0.0337, 0.0411, 0.047,  0.0493,
        0.0507, 0.0519, 0.053, 0.0601, 0.07,   0.0715, 0.0733, 0.08,   0.0977, 0.1}) {
    CAPTURE(x);
    CHECK(seen.through(0, {x, 0, 0}, {x, c.max.y, c.max.z}).net() ==
          test::approx(flow).epsilon(k_single));
  }
  // In a bed the air between the grains is faster; in front of the wall's open part it is as fast
  // as the flow asks for.
  const auto bed = seen.through(0, {0, 0, 0}, {0, c.max.y, c.max.z});
  CHECK(bed.area == test::approx(c.max.y * c.max.z).epsilon(k_single));
  CHECK(bed.mean_velocity() == test::approx(k_duct_velocity).epsilon(k_single));
  CHECK(bed.lowest == test::approx(k_duct_velocity / 0.45).epsilon(k_single));
  const auto gap = seen.through(0, {0.062, 0, 0}, {0.062, c.max.y, c.max.z});
  CHECK(gap.area == test::approx(0.4 * c.max.y * c.max.z).epsilon(k_single));
  CHECK(gap.mean_velocity() == test::approx(2.5 * k_duct_velocity).epsilon(k_single));
  CHECK(gap.lowest > 0.0);
}

TEST_CASE("air_flow in front of a hood shall be what the hood draws, at coarse and fine cells") {
  for (const double cell : {0.06, 0.03}) {
    CAPTURE(cell);
    test::Case c = hood(cell);
    for (int n = 0; n < 10; ++n) c.advance(4e-3);
    const Seen seen(c, FaceTable::Moment::after_step);
    const auto below = [&](double z) {
      return seen.through(2, {0.003, -0.117, z}, {0.257, 0.117, z});
    };
    // From the sides a part comes in between the ceiling and the cells below it.
    CHECK(3600.0 * below(0.6).net() == test::approx(60.0).epsilon(0.05));
    CHECK(below(0.6).backward < 0.01 * below(0.6).forward);
    CHECK(below(0.6).area == test::approx(0.254 * 0.234).epsilon(k_single));
    // Within the cell that the hood draws from it falls with the way, and so does the open share.
    const double half = 0.6 + 0.5 * cell;
    CHECK(below(half).net() == test::approx(0.5 * below(0.6).net()).epsilon(k_single));
    CHECK(below(half).mean_velocity() ==
          test::approx(below(0.6).mean_velocity()).epsilon(k_single));
  }
}

TEST_CASE("before the first step what passes faces shall be by the velocity that there is") {
  test::Case c = blocked_duct();
  c.solver->set_velocity([](Vec3) { return Vec3{0.2, 0, 0}; });
  const Seen seen(c, FaceTable::Moment::before_step);
  const auto bed = seen.through(0, {0.0025, 0, 0}, {0.0025, 0.02, 0.05});
  CHECK(seen.through(0, {0.01, 0, 0}, {0.01, 0.02, 0.05}).net() ==
        test::approx(0.5 * (0.45 + 0.38) * 0.2 * 0.001).epsilon(k_single));
  CHECK(bed.area == test::approx(0.001).epsilon(k_single));
}

TEST_CASE("faces between periodic sides shall be the same at both") {
  test::Case c;
  c.max = {0.03, 0.02, 0.02};
  c.cells = {6, 4, 4};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.start();
  c.eps[c.grid.index(0, 1, 1)] = 0.5;
  c.eps[c.grid.index(5, 1, 1)] = 0.7;
  c.solver->set_velocity([](Vec3) { return Vec3{0.2, 0.1, -0.3}; });
  c.advance(1e-3);
  const Seen seen(c, FaceTable::Moment::after_step);
  for (int d = 0; d < 3; ++d) {
    Vec3 low, high = c.max;
    high[d] = 0.0;
    const auto first = seen.through(d, low, high);
    low[d] = high[d] = c.max[d];
    const auto last = seen.through(d, low, high);
    CAPTURE(d);
    CHECK(first.net() != 0.0);
    CHECK(first.net() == last.net());
    CHECK(first.lowest == last.lowest);
    CHECK(first.highest == last.highest);
  }
}

}  // namespace
