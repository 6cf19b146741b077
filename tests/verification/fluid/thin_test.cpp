// SPDX-License-Identifier: Apache-2.0
// Bodies thinner than a cell stay tight, wherever and however they lie in the grid.
#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;

namespace {

/// A plate of any thickness, 0 included, through `middle`; of a finite half length if given.
class Plate final : public bodies::OnePart<Plate> {
 public:
  Plate(Vec3 middle, Vec3 normal, double thickness, double half_length = 1e9)
      : middle_(middle),
        normal_(normal / norm(normal)),
        along_(cross({0, 1, 0}, normal_)),
        half_(0.5 * thickness),
        half_length_(half_length) {}
  [[nodiscard]] bodies::SurfacePoint nearest(Vec3 p) const override {
    const double s = dot(p - middle_, normal_);
    const double q = dot(p - middle_, along_);
    const Vec3 up = s < 0 ? -normal_ : normal_;
    const double over_s = std::abs(s) - half_;
    const double over_q = std::abs(q) - half_length_;
    const Vec3 out = q < 0 ? -along_ : along_;
    if (over_q <= 0.0 || over_q < over_s) {
      if (over_q <= 0.0) return {std::max(over_s, over_q), over_s >= over_q ? up : out};
    }
    if (over_s <= 0.0) return {over_q, out};
    const double r = std::hypot(over_s, over_q);
    return {r, (over_s / r) * up + (over_q / r) * out};
  }
  [[nodiscard]] bodies::Triangles triangles(Vec3, Vec3, double) const override { return {}; }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  Vec3 middle_;
  Vec3 normal_;
  Vec3 along_;
  double half_;
  double half_length_;
};

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
