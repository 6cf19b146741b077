// SPDX-License-Identifier: Apache-2.0
// The approach of a sphere to a floor, against an independent integration of its equation of
// motion.
#include "still.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace dust;
using test::Still;
using test::World;

// Case B1: a sphere of 15 mm in silicone oil.
constexpr double k_radius = 7.5e-3;
constexpr double k_oil = 970.0;
constexpr double k_viscosity = 0.373;
constexpr double k_density = 1120.0;
constexpr double k_g = 9.81;

World::Choice oil(double step) {
  World::Choice choice;
  choice.density = k_oil;
  choice.viscosity = k_viscosity;
  choice.fluid_step = step;
  return choice;
}

particles::Surface floor_at(double height) {
  particles::Surface floor;
  floor.normal = {0, 0, 1};
  floor.offset = height;
  return floor;
}

struct Motion {
  double gap, speed;
};

/// m dv/dt = W - 6 pi mu R v (1 + q(h / R) - q(1)), dh/dt = -v by Runge and Kutta's rule, v
/// downwards.
Motion reference(double gap, double time) {
  const double volume = sdk::sphere_volume(2.0 * k_radius);
  const double mass = k_density * volume;
  const double weight = (k_density - k_oil) * volume * k_g;
  const double stokes = 6.0 * std::numbers::pi * k_viscosity * k_radius;
  const auto q = [](double d) { return (7.0 * d + 2.0) / (6.0 * d * d + 2.0 * d); };
  const auto rate = [&](Motion s) {
    const double d = std::max(s.gap / k_radius, 1e-3);
    const double extra = d < 1.0 ? q(d) - q(1.0) : 0.0;
    return Motion{-s.speed, (weight - stokes * (1.0 + extra) * s.speed) / mass};
  };
  constexpr int k_steps = 200000;
  const double h = time / k_steps;
  Motion s{gap, 0.0};
  const auto ahead = [](Motion a, double f, Motion b) {
    return Motion{a.gap + f * b.gap, a.speed + f * b.speed};
  };
  for (int n = 0; n < k_steps; ++n) {
    const Motion k1 = rate(s);
    const Motion k2 = rate(ahead(s, 0.5 * h, k1));
    const Motion k3 = rate(ahead(s, 0.5 * h, k2));
    const Motion k4 = rate(ahead(s, h, k3));
    s = ahead(s, h / 6.0, ahead(ahead(k1, 2.0, k2), 1.0, ahead(k4, 2.0, k3)));
  }
  return s;
}

Motion approach(double gap, double time, double step) {
  Still still(oil(step), {{"lubrication"}}, {0, 0, -k_g}, {floor_at(-1.0)});
  still.world.grains.add({0, 0, -1.0 + k_radius + gap}, {}, 2.0 * k_radius, k_density);
  const int steps = static_cast<int>(std::lround(time / step));
  for (int n = 0; n < steps; ++n) still.step(1, still.weight(k_density));
  return {still.world.grains.position[2] + 1.0 - k_radius, -still.world.grains.velocity[2]};
}

TEST_CASE("a sphere shall approach a floor as lubrication lets it") {
  constexpr double k_start = 1.5 * k_radius;  // beyond the reach
  double last = 0.0;
  for (const double time : {0.4, 0.8, 1.0}) {
    const Motion expected = reference(k_start, time);
    const Motion got = approach(k_start, time, 2e-4);
    MESSAGE(time << " s: gap " << got.gap / k_radius << " R, expected " << expected.gap / k_radius);
    // First order in the interval: 2e-4 s beside the 0.01 s in which the resistance changes.
    CHECK(got.gap == test::approx(expected.gap).epsilon(0.02));
    CHECK(got.speed == test::approx(expected.speed).epsilon(0.02));
    CHECK(got.gap > 0.0);
    if (last > 0.0) CHECK(got.gap < last);
    last = got.gap;
  }
  // First order: half the interval, half the error.
  const Motion expected = reference(k_start, 0.8);
  const double coarse = std::abs(approach(k_start, 0.8, 4e-4).gap - expected.gap);
  const double fine = std::abs(approach(k_start, 0.8, 2e-4).gap - expected.gap);
  MESSAGE("order of the approach in time: " << std::log2(coarse / fine));
  CHECK(std::log2(coarse / fine) > 0.8);
}

TEST_CASE("a stiff film shall be stable and keep the balance with the weight") {
  // At the smallest gap the resistance is 1000 times the drag: its time is 1/100 of the interval.
  constexpr double k_step = 5e-3;
  Still still(oil(k_step), {{"lubrication", {{"smallest_gap", 1e-3}}}}, {0, 0, -k_g},
              {floor_at(0.0)});
  still.world.grains.add({0, 0, k_radius * 1.0005}, {}, 2.0 * k_radius, k_density);
  for (int n = 0; n < 10; ++n) still.step(1, still.weight(k_density));
  const double weight = (k_density - k_oil) * sdk::sphere_volume(2.0 * k_radius) * k_g;
  const double resistance =
      6.0 * std::numbers::pi * k_viscosity * k_radius * (1.0 + 2.007 / 0.002006 - 1.125);
  CHECK(-still.world.grains.velocity[2] == test::approx(weight / resistance).epsilon(1e-3));
}

TEST_CASE("a film shall drag a sphere along with a wall that comes nearer, and only then") {
  Still still(oil(1e-4), {{"lubrication"}}, {}, {floor_at(0.0)});
  still.world.grains.add({0, 0, 1.2 * k_radius}, {0.3, 0, 0}, 2.0 * k_radius, k_density);
  still.map();
  still.refresh(1e-4);
  const double drag = test::stokes_drag(k_viscosity, 2.0 * k_radius);
  // Sliding along the wall meets the plain drag; the film acts along the normal.
  CHECK(still.force().x == test::approx(-0.3 * drag).epsilon(1e-9));
  CHECK(std::abs(still.force().z) < 1e-12);
}

}  // namespace
