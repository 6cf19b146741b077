// SPDX-License-Identifier: Apache-2.0
// Lift by shear and by spin, from a field of velocity on a grid.
#include "still.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace dust;
using test::Still;
using test::World;

constexpr double k_density = 1.2;
constexpr double k_viscosity = 1.8e-5;

World::Choice air() {
  World::Choice choice;
  choice.max = {0.02, 0.02, 0.02};
  choice.cells = {10, 10, 10};
  choice.density = k_density;
  choice.viscosity = k_viscosity;
  return choice;
}

TEST_CASE("Saffman's lift in plane shear shall have its value and point to the faster air") {
  constexpr double k_shear = 60.0;  // 1/s: u_x = 60 z
  constexpr double k_diameter = 2e-4;
  for (const double z : {0.0100, 0.0137, 0.0003, 0.0199}) {  // inside and at the sides
    CAPTURE(z);
    Still still(air(), {{"saffman"}});
    still.world.set(still.world.velocity, [](sdk::Vec3 x) {
      return sdk::Vec3{k_shear * x.z, 0, 0};
    });
    still.world.grains.add({0.0103, 0.0091, z}, {}, k_diameter);
    still.map();
    still.refresh(1e-5);
    const double lift = 1.615 * k_diameter * k_diameter *
                        std::sqrt(k_density * k_viscosity / k_shear) * (k_shear * z) * k_shear;
    // Points on a side are taken 1e-5 of a cell inside.
    CHECK(still.force().z == test::approx(lift).epsilon(2e-5));
    CHECK(std::abs(still.force().y) < 1e-9 * lift);
    // A grain that leads is pushed the other way.
    still.world.grains.velocity[0] = 2.0 * k_shear * z;
    still.refresh(1e-5);
    CHECK(still.force().z == test::approx(-lift).epsilon(2e-5));
  }
}

TEST_CASE("spin shall lift by its excess over that of the air") {
  constexpr double k_diameter = 5e-4;
  constexpr double k_turn = 40.0;  // rad/s: the air turns as a solid about y
  Still still(air(), {{"magnus"}});
  still.world.set(still.world.velocity, [](sdk::Vec3 x) {
    return sdk::Vec3{k_turn * (x.z - 0.01), 0, -k_turn * (x.x - 0.01)};
  });
  still.world.grains.add({0.01, 0.01, 0.01}, {0, 0, 0.3}, k_diameter);
  still.world.grains.rotation[1] = k_turn;  // carried along
  still.map();
  constexpr double k_held = 1e-5;  // s
  still.refresh(k_held);
  const double drag = test::stokes_drag(k_viscosity, k_diameter);
  // Half way through the interval it has risen into air that goes along x.
  const double risen = drag * k_turn * 0.3 * 0.5 * k_held;
  CHECK(std::abs(still.force().x - risen) < 1e-9 * drag);
  still.world.grains.rotation[1] = 3.0 * k_turn;
  still.refresh(1e-5);
  // Omega = (0, -80, 0), w = (0, 0, -0.3): Omega x w = (24, 0, 0).
  const double lift = std::numbers::pi / 8.0 * std::pow(k_diameter, 3) * k_density * 24.0;
  CHECK(still.force().x == test::approx(lift + risen).epsilon(1e-6));
  // The lift has moved it along x by then, into air that sinks.
  CHECK(still.force().z == test::approx(-0.3 * drag).epsilon(2e-5));
}

}  // namespace
