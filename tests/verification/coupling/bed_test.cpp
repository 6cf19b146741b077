// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>

namespace {

using namespace dust;
using test::World;

constexpr double k_height = 0.04;  // of the duct [m]
constexpr double k_bottom = 0.01;  // of the bed
constexpr double k_top = 0.03;
constexpr double k_width = 0.01;
constexpr double k_pitch = 1e-3;       // of the regular packing
constexpr double k_diameter = 9e-4;    // [m]
constexpr double k_superficial = 0.2;  // [m/s]
constexpr double k_step = 1e-3;

/// A duct along z with grains at rest between k_bottom and k_top, every cell of the bed filled
/// alike.
World::Choice duct(int cells_along, const std::string& voidage) {
  World::Choice choice;
  choice.max = {k_width, k_width, k_height};
  choice.cells = {cells_along / 4, cells_along / 4, cells_along};
  choice.drag = "ergun";
  choice.voidage = voidage;
  return choice;
}
void fill(World& world, double bottom = k_bottom) {
  const auto places = [](double length) { return static_cast<int>(std::lround(length / k_pitch)); };
  for (int k = 0; k < places(k_top - bottom); ++k) {
    for (int j = 0; j < places(k_width); ++j) {
      for (int i = 0; i < places(k_width); ++i) {
        world.grains.add({(i + 0.5) * k_pitch, (j + 0.5) * k_pitch, bottom + (k + 0.5) * k_pitch},
                         {}, k_diameter);
      }
    }
  }
}

double ergun_gradient(double eps) {
  const double solids = 1.0 - eps;
  const double mu = test::k_air_viscosity;
  return 150.0 * mu * solids * solids * k_superficial /
             (std::pow(eps, 3) * k_diameter * k_diameter) +
         1.75 * test::k_air * solids * k_superficial * k_superficial /
             (std::pow(eps, 3) * k_diameter);
}

/// Makes the prescribed flow that of a plug: eps u = superficial velocity on every face along z.
void set_plug_flow(World& world) {
  for (auto& component : world.velocity.component) component.assign(world.grid.size, 0.0);
  for (int k = -1; k <= world.grid.count[2] + 1; ++k) {
    for (int j = -1; j <= world.grid.count[1]; ++j) {
      for (int i = -1; i <= world.grid.count[0]; ++i) {
        world.velocity.component[2][world.grid.index(i, j, k)] =
            k_superficial / world.face_void_fraction(2, i, j, k);
      }
    }
  }
}

/// Pressure drop along the duct that balances the exchange: sum over the faces, mean over the
/// width.
double pressure_drop(const World& world) {
  double sum = 0.0;
  world.for_cells([&](int i, int j, int k) {
    const std::ptrdiff_t f = world.grid.index(i, j, k);
    sum += world.coupling->exchange().coefficient.component[2][f] * world.velocity.component[2][f] -
           world.coupling->exchange().source.component[2][f];
  });
  return sum * world.grid.spacing.z / (world.grid.count[0] * world.grid.count[1]);
}

/// The bed held in place for some fluid steps of plug flow, up to the exchange of the last step.
void run_held(World& world, int steps) {
  for (int step = 1; step <= steps; ++step) {
    world.begin_step(k_step);
    set_plug_flow(world);
    world.refresh();
    if (step == steps) return;
    world.grains.hold(k_step);
    world.end_step();
  }
}

// The first step does not know the slip yet, the second pays the first one's debt.
constexpr int k_steps_to_steady = 4;
constexpr double k_rounding = 1e-11;

TEST_CASE("the pressure drop of a bed shall be that of Ergun at any cell size, ends included") {
  const double eps = 1.0 - std::numbers::pi / 6.0 * std::pow(k_diameter / k_pitch, 3);
  const double expected = ergun_gradient(eps) * (k_top - k_bottom);
  for (const std::string voidage : {"centre", "divided"}) {
    for (const int cells : {20, 8, 4}) {  // of 2, 5 and 10 mm
      CAPTURE(voidage);
      CAPTURE(cells);
      World world(duct(cells, voidage));
      fill(world);
      run_held(world, k_steps_to_steady);
      CHECK(pressure_drop(world) == test::approx(expected).epsilon(k_rounding));
      CHECK(world.coupling->report().moved_shares == 0);
      CHECK(world.coupling->report().largest_imbalance < 1e-12);
    }
  }
}

TEST_CASE("faces inside a bed shall carry the Ergun gradient and the faces of its ends half") {
  World world(duct(20, "divided"));
  fill(world);
  run_held(world, k_steps_to_steady);
  const double eps = 1.0 - std::numbers::pi / 6.0 * std::pow(k_diameter / k_pitch, 3);
  for (int k = 1; k < 20; ++k) {
    const std::ptrdiff_t f = world.grid.index(2, 1, k);
    const double gradient =
        world.coupling->exchange().coefficient.component[2][f] * world.velocity.component[2][f] -
        world.coupling->exchange().source.component[2][f];
    const double part = k < 5 || k > 15 ? 0.0 : k == 5 || k == 15 ? 0.5 : 1.0;
    CHECK(gradient == test::approx(part * ergun_gradient(eps)).epsilon(k_rounding));
  }
}

TEST_CASE("the grains of a bed shall carry the whole pressure drop, in the air and on a floor") {
  // Drag and pressure gradient on the grains add up to the pressure drop times the area, ends
  // included; the pressure gradient is the one that balances the exchange. On a floor the first
  // face inside takes what belongs to the floor's.
  for (const double bottom : {k_bottom, 0.0}) {
    for (const int cells : {20, 8, 4}) {
      CAPTURE(bottom);
      CAPTURE(cells);
      World world(duct(cells, "divided"));
      fill(world, bottom);
      run_held(world, k_steps_to_steady);
      for (std::size_t f = 0; f < world.grid.size; ++f) {
        world.stress.component[2][f] = world.coupling->exchange().coefficient.component[2][f] *
                                           world.velocity.component[2][f] -
                                       world.coupling->exchange().source.component[2][f];
      }
      world.refresh();
      double force = 0.0;
      for (std::size_t g = 0; g < world.grains.count(); ++g) {
        force += world.grains.action[4 * g + 3] * world.grains.action[4 * g + 2] /
                 world.grains.velocity[4 * g + 3];
      }
      const double eps = 1.0 - std::numbers::pi / 6.0 * std::pow(k_diameter / k_pitch, 3);
      CHECK(pressure_drop(world) ==
            test::approx(ergun_gradient(eps) * (k_top - bottom)).epsilon(k_rounding));
      CHECK(force == test::approx(pressure_drop(world) * k_width * k_width).epsilon(k_rounding));
    }
  }
}

TEST_CASE("a moving bed in a moving stream shall have the pressure drop of its slip") {
  World world(duct(20, "divided"));
  fill(world);
  run_held(world, k_steps_to_steady);
  const double at_rest = pressure_drop(world);
  World moving(duct(20, "divided"));
  fill(moving);
  constexpr double k_speed = 3.0;
  for (std::size_t g = 0; g < moving.grains.count(); ++g) {
    moving.grains.velocity[4 * g + 2] = k_speed;
  }
  for (int step = 1; step <= k_steps_to_steady; ++step) {
    moving.begin_step(k_step);
    set_plug_flow(moving);
    for (double& u : moving.velocity.component[2]) u += k_speed;
    moving.refresh();
    if (step == k_steps_to_steady) break;
    moving.grains.hold(k_step);
    moving.end_step();
  }
  CHECK(pressure_drop(moving) == test::approx(at_rest).epsilon(1e-9));
}

}  // namespace
