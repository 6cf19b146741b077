// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_order = 1.8;  ///< surfaces cut the grid anywhere, so errors scatter a little

struct Errors {
  double largest = 0.0;
  double mean_square = 0.0;
};

/// Rotating inner cylinder R1 (speed 1) in a resting ring R2: u = A r + B / r round the axis.
Errors cylinders(int n) {
  const double r1 = 0.21;
  const double r2 = 0.43;
  const Vec3 axis{0.507, 0, 0.491};
  Case c;
  c.cells = {n, 1, n};
  c.fluid.density = 1;
  c.fluid.viscosity = 0.1;
  c.fluid.pressure_tolerance = 1e-6;
  for (auto& s : c.sides) s = slip();
  c.bodies.push_back(body(std::make_unique<Cylinder>(axis, r1, false), 1.0));
  c.bodies.push_back(body(std::make_unique<Cylinder>(axis, r2, true), 0.0));
  c.start();
  c.advance_to(1.5, 0.2 / n);
  const double b = 1.0 / (1 / r1 - r1 / (r2 * r2));
  const double a = -b / (r2 * r2);
  Errors e;
  int count = 0;
  for (const int d : {0, 2}) {
    c.each_face(d, [&](int, int, int, Vec3 x, double v) {
      const Vec3 q = x - axis;
      const double r = std::hypot(q.x, q.z);
      if (r <= r1 || r >= r2) return;
      const Vec3 exact = (a + b / (r * r)) * sdk::cross({0, 1, 0}, {q.x, 0, q.z});
      const double error = std::abs(v - exact[d]);
      e.largest = std::max(e.largest, error);
      e.mean_square += error * error;
      ++count;
    });
  }
  e.mean_square = std::sqrt(e.mean_square / count);
  return e;
}

/// Couette flow along a tilted gap: upper wall moves along itself. Periodicity does not fit a
/// tilted gap, so the ends are given the exact profile.
Errors tilted(int n) {
  const double angle = 0.3;
  const Vec3 along{std::cos(angle), 0, -std::sin(angle)};
  const Vec3 up{std::sin(angle), 0, std::cos(angle)};
  const double gap = 0.3;
  const Vec3 foot{0.5, 0, 0.37};
  const auto exact = [=](Vec3 p) {
    const double s = std::clamp(dot(p - foot, up) / gap, 0.0, 1.0);
    return s * along;
  };
  Case c;
  c.cells = {n, 1, n};
  c.fluid.density = 1;
  c.fluid.viscosity = 0.1;
  c.fluid.pressure_tolerance = 1e-6;
  for (auto& s : c.sides) s = slip();
  for (const int s : {0, 1}) {
    c.sides[s] = wall();
    c.sides[s]->velocity = [=](Vec3 p, double) { return exact(p); };
  }
  // The right end lets the flow out, so the small error of the cut openings has a way to go.
  c.sides[1] = open_side(0.0, false);
  c.bodies.push_back(body(std::make_unique<HalfSpace>(foot, up), 0.0));
  c.bodies.push_back(body(std::make_unique<HalfSpace>(foot + gap * up, -up), -1.0));
  c.start();
  c.solver->set_velocity(exact);
  c.advance_to(0.5, 0.4 / n);
  Errors e;
  int count = 0;
  for (const int d : {0, 2}) {
    c.each_face(d, [&](int, int, int, Vec3 x, double v) {
      const double s = dot(x - foot, up) / gap;
      // The open end does not know that the flow is tilted: leave its neighbourhood out.
      if (s <= 0 || s >= 1 || x.x > 0.5) return;
      const double error = std::abs(v - exact(x)[d]);
      e.largest = std::max(e.largest, error);
      e.mean_square += error * error;
      ++count;
    });
  }
  e.mean_square = std::sqrt(e.mean_square / count);
  return e;
}

}  // namespace

TEST_CASE("flow between rotating cylinders shall be second order with surfaces cutting the grid") {
  Errors last;
  const Errors first = cylinders(24);
  for (const int n : {48, 96}) {
    last = cylinders(n);
    MESSAGE("cells " << n << ": largest " << last.largest << " rms " << last.mean_square);
  }
  const double largest = 0.5 * order(first.largest, last.largest);
  const double rms = 0.5 * order(first.mean_square, last.mean_square);
  MESSAGE("cells 24: largest " << first.largest << " rms " << first.mean_square << "; order "
                               << largest << " (largest), " << rms << " (rms)");
  CHECK(rms > k_order);
  CHECK(largest > 1.5);
}

TEST_CASE("Couette flow along tilted plates shall be met to a small share of the speed") {
  const Errors a = tilted(16);
  const Errors b = tilted(32);
  const Errors c = tilted(64);
  MESSAGE("largest " << a.largest << " " << b.largest << " " << c.largest << ", rms "
                     << a.mean_square << " " << b.mean_square << " " << c.mean_square);
  CHECK(c.mean_square < 2e-3);
}

TEST_CASE("flow past a rod beside a periodic side shall be that past one in the middle") {
  // 16 x 1 x 16 cells, a rod of 4 cells radius: its surface ends 0.2 cells from the seam, within.
  constexpr int k_cells = 16;
  const auto flow = [](int moved) {
    Case c;
    c.cells = {k_cells, 1, k_cells};
    c.max = {1.0, 0.0625, 1.0};
    c.fluid.density = 1;
    c.fluid.viscosity = 0.01;
    c.fluid.pressure_tolerance = 1e-10;
    const double cell = 1.0 / k_cells;
    c.bodies.push_back(body(
        std::make_unique<Cylinder>(Vec3{(8.2 - moved) * cell, 0, 8.2 * cell}, 4.0 * cell, false),
        0));
    c.start();
    c.set_source({1.0, 0.0, 0.5});
    c.advance_to(0.5, 0.01);
    std::vector<double> u;
    for (int k = 0; k < k_cells; ++k) {
      for (int i = 0; i < k_cells; ++i) {
        const int at = (i - moved + k_cells) % k_cells;
        const double x = i - 8.2;
        const double z = k + 0.5 - 8.2;
        u.push_back(x * x + z * z > 16.0 ? c.u(0, at, 0, k) : 0.0);
      }
    }
    return u;
  };
  const auto middle = flow(0);
  const auto seam = flow(4);
  double largest = 0.0;
  double apart = 0.0;
  for (std::size_t n = 0; n < middle.size(); ++n) {
    largest = std::max(largest, std::abs(middle[n]));
    apart = std::max(apart, std::abs(middle[n] - seam[n]));
  }
  CHECK(largest > 0.1);
  CHECK(apart < 1e-7 * largest);  // the tolerance of the pressure
}

// A line that cuts a right-angled edge met it as a sheet, or not, by the rounding of two normals.
TEST_CASE("air beside a turned box shall be the same wherever the box stands in whole cells") {
  constexpr int k_cells = 12;
  constexpr double k_cell = 0.01;
  const auto flow = [&](double angle, int shift) {
    Case c;
    c.max = {k_cells * k_cell, k_cells * k_cell, k_cells * k_cell};
    c.cells = {k_cells, k_cells, k_cells};
    c.fluid.density = 1.2;
    c.fluid.viscosity = 1.8e-5;
    c.fluid.pressure_tolerance = 1e-10;
    const Vec3 centre{0.0553, 0.0332 + shift * k_cell, 0.0334 + shift * k_cell};
    c.bodies.push_back(
        body(std::make_unique<TurnedBox>(centre, Vec3{0.02, 0.016, 0.012}, Vec3{1, 2, 0.5}, angle),
             0.0));
    c.start();
    c.solver->set_velocity([](Vec3) { return Vec3{1.0, 0.3, 0.2}; });
    c.advance_to(0.01, 1e-3);
    return c;
  };
  for (const double angle : {0.35, 0.52, 0.9}) {
    CAPTURE(angle);
    const Case here = flow(angle, 0);
    const Case there = flow(angle, 5);
    double largest = 0.0;
    for (int d = 0; d < 3; ++d) {
      for (int k = 0; k < k_cells; ++k) {
        for (int j = 0; j < k_cells; ++j) {
          for (int i = 0; i < k_cells; ++i) {
            const double other = there.u(d, i, (j + 5) % k_cells, (k + 5) % k_cells);
            largest = std::max(largest, std::abs(here.u(d, i, j, k) - other));
          }
        }
      }
    }
    CHECK(largest < 1e-6);
  }
}
