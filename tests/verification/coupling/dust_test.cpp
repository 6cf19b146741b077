// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

namespace {

using namespace dust;
using test::World;

constexpr double k_step = 1e-3;

double stokes(double, double) { return 1.0; }

/// Free flight for one fluid step with as many refreshes as asked for.
void move(World& world, sdk::Vec3 gravity) {
  const int refreshes = static_cast<int>(std::lround(k_step / world.coupling->refresh_interval()));
  for (int n = 0; n < refreshes; ++n) {
    world.refresh();
    world.grains.move(k_step / refreshes, gravity);
  }
}

TEST_CASE("dust in a Couette layer shall settle and lag the air as tabulated") {
  struct Row {
    double time, y, x, speed;
  };
  // couette_dust_stokes.csv, released at 2 mm with the speed of the wall.
  const Row rows[] = {{0.005, 0.00196645, 0.00333463, 0.64252203},
                      {0.05, 0.00160556, 0.03288167, 0.67103022},
                      {0.2, 0.00040257, 0.14075414, 0.76726945}};
  World::Choice choice;
  choice.max = {0.2, 0.01, 0.01};
  choice.cells = {10, 8, 1};
  choice.is_one_way = true;
  choice.factor = stokes;
  World world(choice);
  world.set(world.velocity, [](sdk::Vec3 p) { return sdk::Vec3{0.8 * (1 - p.y / 0.01), 0, 0}; });
  world.grains.add({0.0, 0.002, 0.005}, {0.8, 0, 0}, 1e-5);
  int step = 0;
  for (const Row& row : rows) {
    for (; step < std::lround(row.time / k_step); ++step) {
      world.begin_step(k_step);
      move(world, {0, -9.81 * (1 - test::k_air / test::k_sand), 0});
      world.end_step();
    }
    CHECK(world.grains.position[1] == test::approx(row.y).epsilon(1e-3));
    CHECK(world.grains.position[0] == test::approx(row.x).epsilon(1e-3));
    CHECK(world.grains.velocity[0] == test::approx(row.speed).epsilon(1e-3));
  }
}

/// Air that only feels the grains and a constant push [N/m3]: rho du/dt = source - coefficient u +
/// push.
void push_air(World& world, sdk::Vec3 push) {
  for (int d = 0; d < 3; ++d) {
    std::vector<double>& u = world.velocity.component[d];
    for (std::size_t f = 0; f < world.grid.size; ++f) {
      const double ratio = k_step / world.choice.density;
      u[f] = (u[f] + ratio * (world.coupling->exchange().source.component[d][f] + push[d])) /
             (1.0 + ratio * world.coupling->exchange().coefficient.component[d][f]);
    }
    // Halo faces of the periodic box.
    const auto wrap = [](int i, int n) { return ((i % n) + n) % n; };
    for (int k = -2; k < world.grid.count[2] + 2; ++k) {
      for (int j = -2; j < world.grid.count[1] + 2; ++j) {
        for (int i = -2; i < world.grid.count[0] + 2; ++i) {
          u[world.grid.index(i, j, k)] =
              u[world.grid.index(wrap(i, world.grid.count[0]), wrap(j, world.grid.count[1]),
                                 wrap(k, world.grid.count[2]))];
        }
      }
    }
  }
}

/// A periodic box of dust of one size, at the places of a regular lattice of `per_cell`^3 per cell.
World::Choice periodic_box() {
  World::Choice choice;
  choice.max = {4e-3, 4e-3, 4e-3};
  choice.cells = {4, 4, 4};
  choice.periodic = {true, true, true};
  choice.voidage = "centre";
  return choice;
}
void fill(World& world, double diameter, double solids, sdk::Vec3 velocity) {
  // Few computed grains stand for many real ones: weight = real grains each.
  const int along = 8;
  const double pitch = 4e-3 / along;
  const double weight =
      solids * 4e-3 * 4e-3 * 4e-3 / (along * along * along * sdk::sphere_volume(diameter));
  for (int n = 0; n < along * along * along; ++n) {
    world.grains.add({(n % along + 0.5) * pitch, (n / along % along + 0.5) * pitch,
                      (n / along / along + 0.5) * pitch},
                     velocity, diameter, test::k_sand, weight);
  }
}

TEST_CASE(
    "loaded air and 5 to 10 um dust shall come to one speed, keep momentum and stay bounded") {
  for (const double diameter : {5e-6, 1e-5}) {
    for (const double solids : {1e-5, 1e-3, 0.1}) {
      CAPTURE(diameter);
      CAPTURE(solids);
      World world(periodic_box());
      fill(world, diameter, solids, {});
      world.set(world.velocity, [](sdk::Vec3) { return sdk::Vec3{1, 0, 0}; });
      double largest = 0.0;
      for (int step = 0; step < 60; ++step) {
        world.begin_step(k_step);
        push_air(world, {});
        move(world, {});
        world.end_step();
        largest =
            std::max(largest, std::abs(world.velocity.component[0][world.grid.index(1, 1, 1)]));
      }
      const double air = test::k_air * (1 - solids);
      const double speed = air / (air + test::k_sand * solids);
      CHECK(largest <= 1.0);
      CHECK(world.velocity.component[0][world.grid.index(1, 1, 1)] ==
            test::approx(speed).epsilon(1e-6));
      CHECK(world.grains.velocity[0] == test::approx(speed).epsilon(1e-6));
    }
  }
}

TEST_CASE("air pushed through held dust shall reach the speed of the balance") {
  for (const double diameter : {2e-6, 5e-6, 1e-5, 3e-4}) {
    for (const double solids : {0.01, 0.4}) {
      CAPTURE(diameter);
      CAPTURE(solids);
      World world(periodic_box());
      fill(world, diameter, solids, {});
      const double push = 1e4;
      for (int step = 0; step < 100; ++step) {
        world.begin_step(k_step);
        push_air(world, {push, 0, 0});
        const int refreshes =
            static_cast<int>(std::lround(k_step / world.coupling->refresh_interval()));
        for (int n = 0; n < refreshes; ++n) {
          world.refresh();
          world.grains.hold(k_step / refreshes);
        }
        world.end_step();
      }
      // push = n K u / eps: the drag per grain at that speed balances its part of the push.
      const double u = world.velocity.component[0][world.grid.index(2, 2, 2)];
      const double rate = world.grains.action[3];
      const double mass = test::k_sand * solids;  // per volume
      const double drag = mass * rate * u / (1 - solids);
      CHECK(drag == test::approx(push).epsilon(1e-3));
    }
  }
}

}  // namespace
