// SPDX-License-Identifier: Apache-2.0
// Bodies thinner than a cell stay tight, wherever and however they lie in the grid.
#include "dust/sdk/error.hpp"
#include "fluid/geometry/thin_bodies.hpp"
#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

using namespace dust;
using namespace dust::test;

namespace {

/// Moves along itself to the right and down.
class Sliding final : public sdk::Motion {
 public:
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      const Vec3 v = sdk::cross({0, 1, 0}, b.normal[n]);
      b.velocity.set(n, v);
    }
  }
  [[nodiscard]] double largest_speed() const override { return 1.0; }
};

/// A box with 0.1 Pa between its ends along `axis`; slippery round about.
Case pressed(int axis) {
  Case c;
  c.max = {0.02, 0.02, 0.02};
  c.cells = {10, 9, 11};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-9;
  for (auto& s : c.sides) s = slip();
  c.sides[2 * axis] = open_side(0.1, false);
  c.sides[2 * axis + 1] = open_side(0.0, false);
  return c;
}

double largest_flow(const Case& c, int axis) {
  double largest = 0.0;
  for (const int end : {0, c.cells[axis]}) {
    for (int a = 0; a < c.cells[(axis + 1) % 3]; ++a) {
      for (int b = 0; b < c.cells[(axis + 2) % 3]; ++b) {
        std::array<int, 3> at{};
        at[axis] = end;
        at[(axis + 1) % 3] = a;
        at[(axis + 2) % 3] = b;
        largest = std::max(largest, std::abs(c.u(axis, at[0], at[1], at[2])));
      }
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("a thin plate across a duct shall hold a pressure difference without any flow") {
  // 0.1 Pa would blow at 0.4 m/s. Cells are about 2 mm; the plates lie in cells, on faces, on
  // centres, straight and slanting, down to no thickness at all.
  for (int axis = 0; axis < 3; ++axis) {
    for (const double thickness : {1.6e-3, 1e-4, 0.0}) {
      for (const double place : {0.0100, 0.01037, 0.0109090909, 0.0113}) {
        for (const Vec3 tilt : {Vec3{0, 0, 0}, Vec3{0.11, 0.07, 0.05}, Vec3{0.31, 0, 0.27}}) {
          Case c = pressed(axis);
          Vec3 middle{0.01, 0.01, 0.01};
          middle[axis] = place;
          Vec3 normal = tilt;
          normal[axis] = 1.0;
          c.bodies.push_back(body(std::make_unique<Plate>(middle, normal, thickness), 0.0));
          c.start();
          c.advance(1e-3);
          c.advance(1e-3);
          CAPTURE(axis);
          CAPTURE(thickness);
          CAPTURE(place);
          CAPTURE(tilt.x);
          CHECK(largest_flow(c, axis) < 1e-9);
          CHECK(c.p(1, 1, 1) == test::approx(0.1).epsilon(1e-6));
          CHECK(std::abs(c.p(9, 8, 10)) < 1e-7);
        }
      }
    }
  }
}

namespace {

/// Whether linear interpolation at `p` asks a centre of a cell on the other side of the plate than
/// `side` tells.
bool reaches_across(const Case& c, Vec3 p, Vec3 middle, Vec3 normal, double side) {
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 centre;
    double weight = 1.0;
    for (int d = 0; d < 3; ++d) {
      const double h = c.grid.spacing[d];
      const double s = (p[d] - c.grid.origin[d]) / h - 0.5;
      const double low = std::floor(s);
      const bool is_high = (corner >> d & 1) != 0;
      weight *= is_high ? s - low : 1.0 - (s - low);
      const double at = std::clamp(low + (is_high ? 1.0 : 0.0), 0.0, c.cells[d] - 1.0);
      centre[d] = c.grid.origin[d] + (at + 0.5) * h;
    }
    if (weight > 1e-9 && side * dot(centre - middle, normal) < 0.0) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("points beside a thin plate shall be interpolated between cells of their own side") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::size_t moved = 0, across = 0, across_before = 0;
  for (const double thickness : {0.8e-3, 1e-4, 0.0}) {
    for (const Vec3 direction : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0.3, 0, 1}, Vec3{1, 0.2, 0.9},
                                 Vec3{-0.7, 0.6, 0.8}, Vec3{0.1, -1, 0.05}}) {
      Case c = pressed(2);
      const Vec3 middle{0.0103, 0.0098, 0.0107};
      const Vec3 normal = direction / norm(direction);
      c.bodies.push_back(body(std::make_unique<Plate>(middle, normal, thickness), 0.0));
      c.start();
      for (int n = 0; n < 4000; ++n) {
        const Vec3 point{c.max.x * part(random), c.max.y * part(random), c.max.z * part(random)};
        const double side = dot(point - middle, normal);
        if (std::abs(side) < 0.5 * thickness + 1e-6) continue;
        const Vec3 p = c.solver->thin_bodies().on_own_side(point);
        const Vec3 way = p - point;
        for (int d = 0; d < 3; ++d) CHECK(std::abs(way[d]) <= 1.5 * c.grid.spacing[d]);
        if (norm(way) > 0.0) ++moved;
        if (reaches_across(c, point, middle, normal, side)) ++across_before;
        if (reaches_across(c, p, middle, normal, side)) ++across;
      }
    }
  }
  CHECK(across_before > 5000);
  CHECK(moved >= across_before);
  // Left are corners of cells that the plate cuts off, of which no neighbour by a face is on their
  // side: slivers.
  CHECK(across < 10);
}

TEST_CASE("a thin belt that slants through the grid shall stay tight while it runs") {
  Case c = pressed(2);
  c.cells = {10, 1, 11};
  c.bodies.push_back(
      body(std::make_unique<Plate>(Vec3{0.01, 0.01, 0.01}, Vec3{0.3, 0, 1}, 4e-4), 0.0));
  c.bodies.back().motions.push_back(std::make_unique<Sliding>());
  c.start();
  for (int n = 0; n < 20; ++n) c.advance(1e-3);
  // The belt stirs the air on its two sides, but none changes sides.
  double net = 0.0;
  for (int i = 0; i < 10; ++i) net += c.u(2, i, 0, 0);
  CHECK(std::abs(net) < 1e-6);
  CHECK(c.solver->report().largest_speed > 0.1);
}

TEST_CASE("fluid shall stick to both faces of a thin plate where these really are") {
  // A plate of 0.2 mm that runs along itself at 1 m/s between walls at rest, cells of 1 mm: two
  // straight profiles, whatever the plate's place in its cell.
  for (const double place : {0.0071, 0.00738, 0.0076, 0.0080}) {
    Case c;
    c.max = {1e-3, 1e-3, 0.02};
    c.cells = {1, 1, 20};
    c.fluid.density = 1.2;
    c.fluid.viscosity = 1.8e-5;
    c.sides[4] = wall();
    c.sides[5] = wall();
    c.bodies.push_back(body(std::make_unique<Plate>(Vec3{0, 0, place}, Vec3{0, 0, 1}, 2e-4), 0.0));
    c.bodies.back().motions.push_back(std::make_unique<Sliding>());
    c.start();
    for (int n = 0; n < 300; ++n) c.advance(1.0);
    for (int k = 0; k < 20; ++k) {
      const double z = c.grid.centre(0, 0, k).z;
      if (std::abs(z - place) <= 1.1e-4) continue;
      // The faces run to opposite sides: v = y x normal.
      const double exact = z < place ? -z / (place - 1e-4) : (0.02 - z) / (0.02 - place - 1e-4);
      CAPTURE(place);
      CAPTURE(z);
      CHECK(c.u(0, 0, 0, k) == test::approx(exact).epsilon(1e-3));
    }
  }
}

TEST_CASE("fluid shall go round the end of a thin plate") {
  Case c;
  c.max = {0.02, 0.01, 0.02};
  c.cells = {20, 1, 20};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-3;
  c.fluid.pressure_tolerance = 1e-8;
  for (auto& s : c.sides) s = wall();
  c.sides[2] = slip();
  c.sides[3] = slip();
  c.sides[4] = wall({0, 0, 0.1});
  c.sides[5] = open_side(0.0, false);
  // Half across the duct: all that comes in passes the other half.
  c.bodies.push_back(
      body(std::make_unique<Plate>(Vec3{0.0, 0, 0.0103}, Vec3{0.05, 0, 1}, 2e-4, 0.0101), 0.0));
  c.start();
  for (int n = 0; n < 50; ++n) c.advance(2e-3);
  double behind = 0.0;
  double beside = 0.0;
  double out = 0.0;
  for (int i = 0; i < 20; ++i) {
    (i < 9 ? behind : beside) += c.u(2, i, 0, 10);
    out += c.u(2, i, 0, 20);
  }
  CHECK(out == test::approx(2.0).epsilon(1e-6));
  CHECK(beside > 1.8);
  CHECK(std::abs(behind) < 0.2);
}

TEST_CASE(
    "a closed room that gains or loses fluid shall be refused, whatever gives way elsewhere") {
  // A plate, thick or thinner than a cell, parts a duct whose far end is open.
  for (const double thickness : {5e-3, 1e-4}) {
    const auto divided = [&](double speed) {
      Case c;
      c.max = {0.02, 0.02, 0.02};
      c.cells = {10, 1, 10};
      c.fluid.density = 1.2;
      c.fluid.viscosity = 1.8e-5;
      for (auto& s : c.sides) s = wall();
      c.sides[0] = wall({speed, 0, 0});
      c.sides[1] = open_side(0.0, false);
      c.bodies.push_back(
          body(std::make_unique<Slab>(Vec3{0.0101, 0, 0}, Vec3{1, 0, 0}, thickness), 0.0));
      c.start();
      return c;
    };
    CAPTURE(thickness);
    Case blown = divided(1.0);
    CHECK_THROWS_WITH_AS(blown.advance(1e-3), doctest::Contains("m would gain 0.0004 m3/s"),
                         sdk::ModelError);
    Case drained = divided(-1.0);
    CHECK_THROWS_WITH_AS(drained.advance(1e-3), doctest::Contains("m would lose 0.0004 m3/s"),
                         sdk::ModelError);
    Case still = divided(0.0);
    still.advance(1e-3);
    CHECK(std::isfinite(still.p(1, 0, 1)));
  }
}

TEST_CASE("a sheet before either side of a periodic pair shall hold the fluid back") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double place : {0.0002, 0.0008, 0.0192, 0.0198}) {
      Case c;
      c.max = {0.02, 0.02, 0.02};
      c.cells = {10, 10, 10};
      c.fluid.density = 1.2;
      c.fluid.viscosity = 1.8e-5;
      c.fluid.pressure_tolerance = 1e-9;
      Vec3 middle{0.01, 0.01, 0.01};
      Vec3 normal, force;
      middle[axis] = place;
      normal[axis] = 1.0;
      force[axis] = 5.0;  // N/m3: 0.1 Pa over the period
      c.bodies.push_back(body(std::make_unique<Plate>(middle, normal, 0.0), 0.0));
      c.start();
      c.set_source(force);
      for (int n = 0; n < 3; ++n) c.advance(1e-3);
      CAPTURE(axis);
      CAPTURE(place);
      CHECK(largest_flow(c, axis) < 1e-6);
    }
  }
}

TEST_CASE("layers along a sheet before a periodic side shall feel it from both sides") {
  // Fluid that slides along a plate 0.2 cells before the upper side is slowed below and above it,
  // as along one 0.2 cells behind the lower side.
  const auto speeds = [](double place) {
    Case c;
    c.max = {0.02, 0.02, 0.02};
    c.cells = {4, 4, 10};
    c.fluid.density = 1.2;
    c.fluid.viscosity = 1.8e-5;
    c.fluid.pressure_tolerance = 1e-9;
    c.bodies.push_back(
        body(std::make_unique<Plate>(Vec3{0.01, 0.01, place}, Vec3{0, 0, 1}, 0.0), 0.0));
    c.start();
    c.solver->set_velocity([](Vec3) { return Vec3{1, 0, 0}; });
    c.advance_to(0.02, 1e-3);
    return std::pair{c.u(0, 1, 1, 0), c.u(0, 1, 1, 9)};
  };
  const auto low = speeds(0.0004);
  const auto high = speeds(0.0196);
  CHECK(low.first < 0.95);
  CHECK(high.second == test::approx(low.first).epsilon(1e-6));
  CHECK(high.first == test::approx(low.second).epsilon(1e-6));
}
