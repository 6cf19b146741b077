// SPDX-License-Identifier: Apache-2.0
// Openings in bodies that suck a given flow.
#include "dust/sdk/error.hpp"
#include "fluid_case.hpp"
#include "support/approx.hpp"
#include "test_bodies.hpp"

#include <doctest/doctest.h>
#include <numbers>

using namespace dust;
using namespace dust::test;

namespace {

/// The flow is exact; the pressure is solved to 1e-10.
constexpr double k_exact = 1e-7;

/// Volume flow [m3/s] in through the top.
double inflow(const Case& c) {
  double sum = 0.0;
  for (int j = 0; j < c.cells[1]; ++j) {
    for (int i = 0; i < c.cells[0]; ++i) sum -= c.u(2, i, j, c.cells[2]);
  }
  return sum * c.grid.spacing.x * c.grid.spacing.y;
}

/// Volume flow [m3/s] in through the bottom.
double inflow_below(const Case& c) {
  double sum = 0.0;
  for (int j = 0; j < c.cells[1]; ++j) {
    for (int i = 0; i < c.cells[0]; ++i) sum += c.u(2, i, j, 0);
  }
  return sum * c.grid.spacing.x * c.grid.spacing.y;
}

Case room(int n) {
  Case c;
  c.max = {0.1, 0.05, 0.1};
  c.cells = {2 * n, n, 2 * n};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-10;
  for (auto& s : c.sides) s = wall();
  // The one side that no body reaches.
  c.sides[5] = open_side(0.0, true);
  return c;
}

}  // namespace

TEST_CASE("an opening in a body shall suck exactly its flow, at any cell size and slant") {
  const double flow = 3e-4;
  for (const int n : {6, 11}) {
    for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0.3, 0.1, 1}}) {
      Case c = room(n);
      c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0.05, 0.025, 0.032}, normal), 0.0));
      c.bodies.back().suction =
          scenario::SuctionSpec{flow, {0.03, 0.01, 0}, {0.06, 0.04, 0.1}, {}, {}};
      c.start();
      for (int k = 0; k < 5; ++k) c.advance(1e-3);
      CAPTURE(n);
      CAPTURE(normal.x);
      CHECK(inflow(c) == test::approx(flow).epsilon(k_exact));
    }
  }
}

TEST_CASE("an opening in a body thinner than a cell shall draw from its own side alone") {
  const double flow = 3e-4;
  // Across the whole room, wholly between two planes of the grid (cells of 5 mm), and on a slant.
  for (const double thickness : {0.0006, 0.0032, 0.0044}) {
    for (const double slant : {0.0, 0.3}) {
      Case c = room(10);
      for (int s = 0; s < 4; ++s) c.sides[s] = slip();
      c.sides[4] = open_side(0.0, true);
      const Vec3 middle{0.05, 0.025, 0.0526};
      bodies::Body sheet = body(std::make_unique<Slab>(middle, Vec3{0, 0, 1}, thickness), 0.0);
      sheet.frame_origin = middle;
      sheet.frame_axis = {0, 1, 0};
      sheet.frame_angle = slant;
      const double below = middle.z - 0.5 * thickness;
      sheet.suction = scenario::SuctionSpec{flow, {0.03, 0.01, below}, {0.07, 0.04, below}, {}, {}};
      c.bodies.push_back(std::move(sheet));
      c.start();
      for (int k = 0; k < 5; ++k) c.advance(1e-3);
      CAPTURE(thickness);
      CAPTURE(slant);
      CHECK(std::abs(inflow(c)) < flow * k_exact);
      CHECK(inflow_below(c) == test::approx(flow).epsilon(k_exact));
    }
  }
}

TEST_CASE("an opening shall go on sucking where its body's surface comes to a plane of the grid") {
  const double flow = 3e-4;
  const double step = 1e-3;
  // 5 mm a step: the opening lies on a plane of the grid after each of them.
  Case c = room(10);
  c.bodies.push_back(moving(std::make_unique<Slab>(Vec3{0.05, 0.025, 0.02}, Vec3{0, 0, 1}, 0.02),
                            Shift::steady({0, 0, 5.0})));
  c.bodies.back().suction =
      scenario::SuctionSpec{flow, {0.03, 0.01, 0.03}, {0.06, 0.04, 0.03}, {}, {}};
  c.sides[4] = open_side(0.0, true);
  c.start();
  for (int n = 0; n < 6; ++n) {
    const double volume = open_volume(c);
    c.advance(step);
    // What the body takes and what it displaces.
    const double displaced = (volume - open_volume(c)) / step;
    CAPTURE(n);
    CHECK(inflow(c) + inflow_below(c) + displaced == test::approx(flow).epsilon(1e-5));
  }
}

TEST_CASE("the flow into a flat opening shall be uniform and follow its factors over time") {
  const double flow = 3e-4;
  Case c = room(10);  // cells of 5 mm
  c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.03}, Vec3{0, 0, 1}), 0.0));
  c.bodies.back().suction =
      scenario::SuctionSpec{flow, {0.03, 0.01, 0.03}, {0.06, 0.04, 0.03}, {0.0, 0.01}, {1.0, 0.0}};
  c.start();
  c.advance(4e-3);
  CHECK(inflow(c) == test::approx(0.6 * flow).epsilon(k_exact));
  // The face above the surface's cell: what goes through it and its neighbours ends in the hood.
  const double mean = 0.6 * flow / (0.03 * 0.03);
  CHECK(c.solver->velocity().component[2][c.grid.index(8, 5, 6)] ==
        test::approx(-mean).epsilon(1e-6));  // the surface itself
  c.advance(8e-3);
  CHECK(std::abs(inflow(c)) < flow * k_exact);
}

TEST_CASE("far from a small opening the flow shall be that of a point sink") {
  // Half space over a plate: u_r = Q / (2 pi r2).
  Case c;
  c.max = {0.12, 0.12, 0.07};
  c.cells = {48, 48, 28};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-7;
  for (auto& s : c.sides) s = open_side(0.0, false);
  c.sides[4] = slip();
  c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.01003}, Vec3{0, 0, 1}), 0.0));
  const double flow = 1e-4;
  c.bodies.back().suction =
      scenario::SuctionSpec{flow, {0.0575, 0.0575, 0}, {0.0625, 0.0625, 0.1}, {}, {}};
  c.start();
  c.advance(1e-4);  // from rest: potential flow
  const int k = 12;
  const double r = c.grid.face(2, 24, 24, k).z - 0.01003;
  double mean = 0.0;
  for (const int i : {23, 24}) {
    for (const int j : {23, 24}) mean += 0.25 * c.u(2, i, j, k);
  }
  MESSAGE("at " << r << " m: " << mean << " m/s, point sink "
                << -flow / (2 * std::numbers::pi * r * r));
  // The domain's sides hold p = 0 at 60 mm, the opening is 5 mm wide: a few per cent each.
  CHECK(mean == test::approx(-flow / (2 * std::numbers::pi * r * r)).epsilon(0.1));
}

TEST_CASE("an opening that meets no fluid, or one in a closed room, shall be refused") {
  Case c = room(6);
  c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.03}, Vec3{0, 0, 1}), 0.0));
  c.bodies.back().suction =
      scenario::SuctionSpec{1e-4, {0.03, 0.01, 0.05}, {0.06, 0.04, 0.06}, {}, {}};
  CHECK_THROWS_WITH_AS(c.start(), doctest::Contains("suction: no part of the body's surface"),
                       sdk::ModelError);
  Case d = room(6);
  d.sides[5] = wall();
  d.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.03}, Vec3{0, 0, 1}), 0.0));
  d.bodies.back().suction =
      scenario::SuctionSpec{1e-4, {0.03, 0.01, 0.0}, {0.06, 0.04, 0.06}, {}, {}};
  d.start();
  CHECK_THROWS_WITH_AS(d.advance(1e-3), doctest::Contains("and bodies let"), sdk::ModelError);
}

TEST_CASE("an opening in a part of the domain that nothing gives way to shall be refused") {
  Case c = room(6);
  c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.02}, Vec3{0, 0, 1}), 0.0));
  c.bodies.back().suction =
      scenario::SuctionSpec{1e-4, {0.03, 0.01, 0.0}, {0.06, 0.04, 0.06}, {}, {}};
  c.bodies.push_back(body(std::make_unique<Slab>(Vec3{0, 0, 0.07}, Vec3{0, 0, 1}, 0.01), 0.0));
  c.start();
  CHECK_THROWS_WITH_AS(c.advance(1e-3), doctest::Contains("m would lose 0.0001 m3/s"),
                       sdk::ModelError);
}

TEST_CASE("grains that move in a closed room, and pores without a flow, shall stop no run") {
  Case c = room(6);
  c.bodies.push_back(body(std::make_unique<Slab>(Vec3{0, 0, 0.03}, Vec3{0, 0, 1}, 0.01), 0.0));
  c.bodies.push_back(body(std::make_unique<Slab>(Vec3{0, 0, 0.048}, Vec3{0.01, 0, 1}, 0.01), 0.0));
  c.start();
  fluid::CellField after = c.eps;
  after[c.grid.index(3, 3, 0)] = 0.7;  // comes to rest below the plates, from nowhere
  c.solver->advance(0.0, 1e-3, c.eps, after, c.exchange);
  c.solver->advance(1e-3, 1e-3, after, after, c.exchange);
  CHECK(c.solver->report().largest_speed < 10.0);
}
