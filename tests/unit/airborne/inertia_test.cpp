// SPDX-License-Identifier: Apache-2.0
// Dust that does not turn with the gas: closed forms of the drift tau Du/Dt.
#include "support/approx.hpp"
#include "unit/airborne/box.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_turn = 2.0;  // [rad/s]

/// A box of 1 m whose gas turns about its middle like a solid body.
Box turning(int cells) {
  Box box({cells, 1, cells}, {1, 1.0 / cells, 1}, {false, true, false});
  box.set_velocity([](Vec3 x) { return Vec3{-k_turn * (x.z - 0.5), 0, k_turn * (x.x - 0.5)}; });
  return box;
}

/// How far the middle of a blob is from the axis after a quarter of a turn, less the exact
/// distance.
double error_of_spiral(int cells, double time) {
  Box box = turning(cells);
  box.dust().inertia_time = time;
  box.set_mass([](Vec3 x) { return smooth_blob(x, {0.65, x.y, 0.5}, 0.15); });
  const double quarter = 0.5 * std::numbers::pi / k_turn;
  CHECK(box.run_with_inertia(quarter, 4 * cells) == 0.0);
  const Vec3 middle = box.middle();
  const double exact = 0.15 * std::exp(time * k_turn * k_turn * quarter);
  return std::abs(std::hypot(middle.x - 0.5, middle.z - 0.5) - exact);
}

}  // namespace

TEST_CASE(
    "the acceleration of gas that turns like a solid body shall be exact but for rounding to "
    "float") {
  Box box = turning(20);
  GasAcceleration acceleration(box.grid(), 0.05);
  acceleration.find(box.flow(), 1e-3);
  for (const int d : {0, 2}) {
    box.each_face(d, [&](std::size_t face, Vec3 x, bool) {
      if (std::hypot(x.x - 0.5, x.z - 0.5) > 0.4) return;  // sides are closed
      CHECK(acceleration.field(static_cast<std::size_t>(d))[face] ==
            test::approx(-k_turn * k_turn * (x[d] - 0.5)).scale(k_turn).epsilon(1e-6));
      CHECK(acceleration.turn(static_cast<std::size_t>(d))[face] ==
            test::approx(k_turn).epsilon(1e-6));
    });
  }
}

TEST_CASE("dust in turning gas shall spiral out by exp(tau omega^2 t), to second order") {
  // tau omega = 0.1: half of what the expansion allows.
  const double coarse = error_of_spiral(40, 0.05);
  const double fine = error_of_spiral(80, 0.05);
  CHECK(fine < 1e-4);  // of a drift of 26 mm
  CHECK(coarse > 3.0 * fine);
}

TEST_CASE("an even cloud in turning gas shall thin out by exp(-2 tau omega^2 t)") {
  // Dust lighter than the fluid gathers in the middle.
  for (const double time : {0.05, -0.05}) {
    Box box = turning(20);
    box.dust().inertia_time = time;
    box.set_mass([](Vec3) { return 1.0; });
    box.run_with_inertia(0.1, 20);
    const double exact = std::exp(-2.0 * time * k_turn * k_turn * 0.1);
    box.each_cell([&](std::size_t cell, Vec3 x) {
      if (std::hypot(x.x - 0.5, x.z - 0.5) > 0.2)
        return;  // what comes from the sides has not arrived
      CHECK(box.mass()[cell] == test::approx(exact).epsilon(1e-6));
    });
  }
}

TEST_CASE("dust shall lag behind gas that speeds up, by tau times what it has gained") {
  constexpr double k_gain = 0.8;  // [m/s2]
  constexpr double k_time = 0.02;
  constexpr int k_steps = 100;
  constexpr double k_end = 0.5;
  Box box({100, 1, 1}, {1, 0.01, 0.01}, {true, true, true});
  box.dust().inertia_time = k_time;
  box.set_mass([](Vec3 x) { return smooth_blob(x, {0.3, x.y, x.z}, 0.2); });
  const double step = k_end / k_steps;
  double gas = 0.0;
  box.run_with_inertia(k_end, k_steps, [&](int n) {
    const double speed = 0.5 + k_gain * (n + 0.5) * step;
    box.set_velocity([speed](Vec3) { return Vec3{speed, 0, 0}; });
    gas += speed * step;
  });
  // As one that follows u(t) by dv/dt = (u - v) / tau from v = u on.
  const double behind = k_time * k_gain * (k_end - k_time * (1.0 - std::exp(-k_end / k_time)));
  CHECK(gas - (box.middle().x - 0.3) == test::approx(behind).epsilon(0.01));
}

TEST_CASE(
    "where gas turns too fast for the expansion the drift shall stay bounded and be counted") {
  Box box = turning(40);
  box.dust().inertia_time = 2.0;  // tau omega = 4
  box.set_mass([](Vec3 x) { return smooth_blob(x, {0.6, x.y, 0.5}, 0.1); });
  const double before = box.in_air();
  const double time = 0.25 * std::numbers::pi / k_turn;
  CHECK(box.run_with_inertia(time, 80) > 0.5);
  CHECK(box.in_air() == test::approx(before).epsilon(1e-13));
  CHECK(box.lost() == 0.0);
  // Outwards at a fifth of the gas's speed.
  const Vec3 middle = box.middle();
  const double distance = std::hypot(middle.x - 0.5, middle.z - 0.5);
  CHECK(distance == test::approx(0.1 * std::exp(0.2 * k_turn * time)).epsilon(0.01));
  box.each_cell([&](std::size_t cell, Vec3) { CHECK(box.mass()[cell] >= 0.0); });
}

TEST_CASE("where the drift is held shall not depend on what the whole of the gas moves with") {
  // Solid-body turn about an axis that moves along; the drift round it at tau omega = 0.4.
  const auto marked = [](double speed) {
    Box box({60, 1, 60}, {3.0, 0.05, 3.0}, {false, true, false});
    box.dust().inertia_time = 0.2;
    const double step = 0.01;
    GasAcceleration acceleration(box.grid(), 0.02);
    double middle = 1.5 - 0.5 * speed;
    for (int n = 0; n <= 50; ++n) {
      middle = 1.5 + speed * step * (n - 50);
      box.set_velocity([&](Vec3 x) {
        return Vec3{speed - k_turn * (x.z - 1.5), 0, k_turn * (x.x - middle)};
      });
      acceleration.find(box.flow(), step);
    }
    Transport transport(box.grid());
    transport.prepare(box.flow(), &acceleration);
    Losses losses;
    losses.outlets.resize(2, 0.0);
    transport.advance(box.flow(), box.dust(), 1.0, {}, 1e-4, box.mass(), losses);
    std::size_t held = 0, all = 0;
    box.each_cell([&](std::size_t cell, Vec3 x) {
      const double r = std::hypot(x.x - 1.5, x.z - 1.5);
      if (r < 0.2 || r > 0.8) return;
      ++all;
      held += transport.limited()[cell] > 0.0F ? 1 : 0;
    });
    CHECK(all > 100);
    // tau Du/Dt of the turn alone, within what the memory of the past is behind.
    box.each_face(0, [&](std::size_t face, Vec3 x, bool) {
      if (std::hypot(x.x - 1.5, x.z - 1.5) > 0.8) return;
      CHECK(acceleration.field(0)[face] ==
            test::approx(-k_turn * k_turn * (x.x - 1.5)).scale(k_turn * k_turn).epsilon(1e-3));
    });
    return static_cast<double>(held) / static_cast<double>(all);
  };
  CHECK(marked(0.0) == 1.0);
  CHECK(marked(0.7) == 1.0);
}

TEST_CASE("dust shall lag behind gas that starts at once, from rest as from a creep") {
  for (const double before : {0.0, 1e-6}) {
    CAPTURE(before);
    Box box({100, 1, 1}, {1, 0.01, 0.01}, {true, true, true});
    box.dust().inertia_time = 2e-3;
    box.set_mass([](Vec3 x) { return smooth_blob(x, {0.3, x.y, x.z}, 0.2); });
    constexpr double k_step = 5e-3;
    constexpr int k_steps = 20;
    box.run_with_inertia(k_steps * k_step, k_steps, [&](int n) {
      const double speed = n < 2 ? before : 1.0;
      box.set_velocity([speed](Vec3) { return Vec3{speed, 0, 0}; });
    });
    // tau times what it gained.
    const double gas = 0.3 + (k_steps - 2) * k_step;
    CHECK(gas - box.middle().x == test::approx(2e-3).epsilon(0.01));
  }
}

TEST_CASE("a face that a body sets free shall not count as gas that was sped up") {
  // A piston goes with gas of 1 m/s: nothing is accelerated anywhere.
  Box box({20, 1, 1}, {1.0, 0.05, 0.05}, {false, true, true});
  constexpr double k_step = 0.05;
  GasAcceleration acceleration(box.grid(), 0.05);
  for (int n = 0; n < 8; ++n) {
    const double behind = 0.2 + k_step * n;
    box.each_face(0, [&](std::size_t face, Vec3 x, bool is_side) {
      const bool is_closed = is_side || (x.x > behind && x.x < behind + 0.2);
      box.flow().passage.component[0][face] = is_closed ? 0.0 : 1.0;
    });
    box.set_velocity([](Vec3) { return Vec3{1.0, 0.0, 0.0}; });
    acceleration.find(box.flow(), k_step);
    for (const float a : acceleration.field(0)) CHECK(a == 0.0F);
  }
}

TEST_CASE("an even cloud among grains that go with the gas shall stay even") {
  // A block of packed grains and the gas in and round it go at one speed: nothing is accelerated.
  constexpr double k_speed = 3.0;           // [m/s]
  constexpr double k_void_fraction = 0.55;  // in the block
  constexpr int k_cells = 60;
  constexpr double k_h = 0.01;
  constexpr double k_length = 20.3 * k_h;
  // Solids [m] of the block, which begins at `front`, between two places.
  const auto solids = [&](double front, double from, double to) {
    return (1.0 - k_void_fraction) *
           std::max(0.0, std::min(to, front + k_length) - std::max(from, front));
  };
  for (const double tau : {0.8e-3, 7e-3}) {       // 10 and 30 um of limestone
    for (const double part : {0.02, 0.1, 0.5}) {  // of a cell, the way in a step
      CAPTURE(tau);
      CAPTURE(part);
      Box box({k_cells, 1, 1}, {k_cells * k_h, k_h, k_h}, {true, true, true});
      box.dust().inertia_time = tau;
      const double step = part * k_h / k_speed;
      double front = 0.1001;
      const auto fill = [&](CellField& volume) {
        box.each_cell([&](std::size_t cell, Vec3 x) {
          volume[cell] = 1.0 - solids(front, x.x - 0.5 * k_h, x.x + 0.5 * k_h) / k_h;
        });
      };
      fill(box.flow().volume_after);
      box.set_mass([](Vec3) { return 1.0; });
      const int steps = static_cast<int>(std::lround(0.2 / (k_speed * step)));
      box.run_with_inertia(steps * step, steps, [&](int) {
        box.flow().volume_before = box.flow().volume_after;
        // What passes a face in the step is what lies behind it.
        box.each_face(0, [&](std::size_t face, Vec3 x, bool) {
          const double way = k_speed * step;
          box.flow().throughflow.component[0][face] = (way - solids(front, x.x - way, x.x)) / step;
        });
        front += k_speed * step;
        fill(box.flow().volume_after);
        box.flow().void_fraction = box.flow().volume_after;
        box.each_face(0, [&](std::size_t face, Vec3 x, bool) {
          box.flow().passage.component[0][face] =
              1.0 - 0.5 * solids(front, x.x - k_h, x.x + k_h) / k_h;
        });
      });
      double low = 1.0, high = 1.0;
      box.each_cell([&](std::size_t cell, Vec3) {
        const double c = box.mass()[cell] / box.flow().volume_after[cell];
        low = std::min(low, c);
        high = std::max(high, c);
      });
      // The drift fades out where grains take up 1 %, and the gas swings by as much till then.
      CHECK(low > 0.99);
      CHECK(high < 1.01);
    }
  }
}

TEST_CASE("cells in which the drift is limited shall be the mirrored ones in a mirrored flow") {
  // The gas speeds up between two planes, off the middle, along one axis.
  const auto marked = [](int axis, bool is_mirrored, bool is_periodic) {
    constexpr int k_cells = 20;
    std::array<int, 3> cells{1, 1, 1};
    cells[static_cast<std::size_t>(axis)] = k_cells;
    Vec3 size{1.0 / k_cells, 1.0 / k_cells, 1.0 / k_cells};
    size[axis] = 1.0;
    std::array<bool, 3> periodic{true, true, true};
    periodic[static_cast<std::size_t>(axis)] = is_periodic;
    Box box(cells, size, periodic);
    box.dust().inertia_time = 0.05;
    box.set_velocity([&](Vec3 x) {
      const double place = is_mirrored ? 1.0 - x[axis] : x[axis];
      Vec3 u;
      u[axis] = (is_mirrored ? -1.0 : 1.0) * (1.0 + 5.0 * std::clamp(place - 0.25, 0.0, 0.2));
      return u;
    });
    GasAcceleration acceleration(box.grid(), box.dust().inertia_time);
    acceleration.find(box.flow(), 1e-4);
    Transport transport(box.grid());
    transport.prepare(box.flow(), &acceleration);
    Losses losses;
    losses.outlets.resize(2, 0.0);
    transport.advance(box.flow(), box.dust(), 1.0, {}, 1e-4, box.mass(), losses);
    std::vector<float> all;
    box.each_cell([&](std::size_t cell, Vec3) { all.push_back(transport.limited()[cell]); });
    if (is_mirrored) std::reverse(all.begin(), all.end());
    return all;
  };
  for (const int axis : {0, 1, 2}) {
    for (const bool is_periodic : {false, true}) {
      CAPTURE(axis);
      CAPTURE(is_periodic);
      const std::vector<float> cells = marked(axis, false, is_periodic);
      CHECK(cells == marked(axis, true, is_periodic));
      // On either side of the faces at 0.3, 0.35 and 0.4 m; at the ends the slope is half of it.
      CHECK(std::count(cells.begin() + 3, cells.begin() + 11, 1.0F) == 4);
    }
  }
}
