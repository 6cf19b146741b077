// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace dust;
using namespace dust::test;

namespace {

/// Largest speed of component `d` on the cells' faces.
double largest(const Case& c, int d) {
  double found = 0.0;
  c.each_face(d, [&](int, int, int, Vec3, double v) { found = std::max(found, std::abs(v)); });
  return found;
}

}  // namespace

TEST_CASE("air that enters through total_pressure shall bring no velocity along the side") {
  // Air slides along an open side and is sucked off through the opposite one at 1 m/s: what comes
  // in from rest takes its place within the time of one way through the box.
  for (int across = 0; across < 3; ++across) {
    for (int inlet = 0; inlet < 2; ++inlet) {
      CAPTURE(across);
      CAPTURE(inlet);
      const int along = (across + 1) % 3;
      Case c;
      c.cells = {8, 8, 8};
      c.cells[(across + 2) % 3] = 2;
      c.fluid.density = 1.2;
      c.fluid.viscosity = 1e-6;
      Vec3 speed;
      speed[across] = inlet == 0 ? 1.0 : -1.0;
      c.sides[2 * across + inlet] = open_side(0.0, true);
      c.sides[2 * across + 1 - inlet] = wall(speed);
      c.sides[2 * across + 1 - inlet]->side_rules.tangential_velocity = sdk::SideRule::gradient;
      c.start();
      Vec3 begin = speed;
      begin[along] = 0.7;
      c.solver->set_velocity([&](Vec3) { return begin; });
      c.advance_to(0.5, 0.02);
      double sum = 0.0;
      int count = 0;
      c.each_face(along, [&](int, int, int, Vec3, double v) {
        sum += v;
        ++count;
      });
      // Half of it is still there; the first cell, of first order, keeps its own a little longer.
      CHECK(sum / count == test::approx(0.35).epsilon(0.1));
      c.advance_to(3.0, 0.02);
      CHECK(largest(c, along) < 1e-3);
      CHECK(largest(c, across) == test::approx(1.0).epsilon(1e-3));
    }
  }
}

TEST_CASE("a pressure that varies in time shall act at its own time, second order") {
  // A frictionless slug: rho L du/dt = P sin(w t), u = P (1 - cos(w t)) / (rho L w).
  const auto error = [](int steps) {
    const double w = 20.0;
    const double end = 0.1;
    Case c;
    c.max = {0.02, 0.02, 0.04};
    c.cells = {2, 1, 4};
    c.fluid.density = 1000.0;
    c.fluid.viscosity = 1e-3;
    for (int s = 0; s < 4; ++s) c.sides[s] = slip();
    c.sides[4] = open_side(0.0, false);
    c.sides[4]->pressure = [w](Vec3, double t) { return std::sin(w * t); };
    c.sides[5] = open_side(0.0, false);
    c.start();
    c.advance_to(end, end / steps);
    const double exact = (1.0 - std::cos(w * end)) / (1000.0 * 0.04 * w);
    return std::abs(c.u(2, 1, 0, 2) / exact - 1.0);
  };
  const double coarse = error(10);
  const double fine = error(20);
  MESSAGE("error with 10 and 20 steps: ", coarse, " ", fine);
  CHECK(coarse < 4e-3);
  CHECK(order(coarse, fine) > 1.8);
}

TEST_CASE("what passes a direction of one cell shall count in the Courant number") {
  Case c;
  c.max = {0.1, 0.01, 0.005};
  c.cells = {20, 2, 1};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  for (int s = 0; s < 4; ++s) c.sides[s] = slip();
  c.sides[4] = wall({0, 0, 1.0});
  c.sides[5] = open_side(0.0, false);
  c.start();
  c.advance(1e-3);
  c.advance(1e-3);
  CHECK(c.solver->report().courant_number == test::approx(0.2).epsilon(0.01));
}

namespace {

/// Fluid that comes in through the lower side along `in` and leaves through the opposite one and
/// the upper one along `up`, both at a given pressure, nothing along them. [m/s] along `in`, by
/// cells along `in` and `up`.
std::vector<double> turning_flow(int in, int up) {
  const int across = 3 - in - up;
  Case c;
  c.max[in] = 0.02;
  c.max[up] = 0.024;
  c.max[across] = 0.001;
  c.cells[static_cast<std::size_t>(in)] = 20;
  c.cells[static_cast<std::size_t>(up)] = 24;
  c.cells[static_cast<std::size_t>(across)] = 1;
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-10;
  for (auto& side : c.sides) side = slip();
  Vec3 speed;
  speed[in] = 0.6;
  c.sides[static_cast<std::size_t>(2 * in)] = wall(speed);
  for (const int open : {2 * in + 1, 2 * up + 1}) {
    auto side = open_side(0.0, false);
    side->side_rules.tangential_velocity = dust::sdk::SideRule::fixed;
    c.sides[static_cast<std::size_t>(open)] = std::move(side);
  }
  c.start();
  c.advance_to(4e-3, 5e-4);
  std::vector<double> out;
  for (int n = 0; n < 20; ++n) {
    for (int m = 0; m < 24; ++m) {
      int at[3] = {0, 0, 0};
      at[in] = n;
      at[up] = m;
      out.push_back(c.u(in, at[0], at[1], at[2]));
    }
  }
  return out;
}

}  // namespace

TEST_CASE("flow at the edge of an inlet and an opening shall not depend on the axes' names") {
  // What the sweeps along one axis after the other leave is 1e-4 of the inlet's speed. With the
  // edge's numbers taken from the inlet or from the opening by the order of the axes it was 0.05.
  const std::vector<double> first = turning_flow(0, 2);
  const int axes[][2] = {{2, 0}, {0, 1}, {1, 0}, {1, 2}, {2, 1}};
  for (const auto& [in, up] : axes) {
    CAPTURE(in);
    CAPTURE(up);
    const std::vector<double> other = turning_flow(in, up);
    double largest = 0.0;
    for (std::size_t n = 0; n < first.size(); ++n) {
      largest = std::max(largest, std::abs(other[n] - first[n]));
    }
    CHECK(largest < 1e-3 * 0.6);
  }
}

namespace {

/// A stream of 1 m/s in a slice of one cell, through one side of which fluid is drawn off at 10
/// 1/s; grains with next to no drag, or none, in it. [m/s] along x after 50 ms.
std::vector<double> drained_stream(int n, bool sticks, double coefficient) {
  Case c;
  c.max = {0.08, 0.01, 0.08};
  c.cells = {n, 1, n};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-10;
  for (const int s : {0, 1, 4, 5}) c.sides[static_cast<std::size_t>(s)] = open_side(0.0, false);
  c.sides[2] = sticks ? wall() : slip();
  c.sides[3] = sticks ? wall() : slip();
  c.sides[3]->velocity = [](Vec3, double) { return Vec3{0, 0.1, 0}; };
  c.start();
  c.solver->set_velocity([](Vec3) { return Vec3{1.0, 0, 0}; });
  for (auto& field : c.exchange.coefficient.component) field.assign(c.grid.size, coefficient);
  c.advance_to(0.05, 1e-3);
  std::vector<double> out;
  c.each_face(0, [&](int, int, int, Vec3, double u) { out.push_back(u); });
  return out;
}

}  // namespace

TEST_CASE("what is drawn off through a slice of one cell shall take its momentum along") {
  for (const bool sticks : {true, false}) {
    CAPTURE(sticks);
    const auto difference = [&](int cells) {
      const auto plain = drained_stream(cells, sticks, 0.0);
      const auto dragged = drained_stream(cells, sticks, 1e-12);
      double worst = 0.0, largest = 0.0;
      for (std::size_t n = 0; n < plain.size(); ++n) {
        worst = std::max(worst, std::abs(plain[n] - dragged[n]));
        largest = std::max(largest, std::abs(plain[n]));
      }
      CHECK(largest > 0.1);
      return worst;
    };
    // What is left is the error of convection, which the account of momentum takes off; without
    // what passes the sides the difference is 0.8 m/s and more.
    const double coarse = difference(8);
    const double fine = difference(16);
    MESSAGE("differences with 8 and 16 cells: ", coarse, " ", fine);
    CHECK(coarse < 1e-3);
    CHECK(fine < 1e-3);
  }
}
