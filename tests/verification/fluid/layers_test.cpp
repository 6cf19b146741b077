// SPDX-License-Identifier: Apache-2.0
#include "fluid/properties.hpp"
#include "fluid_case.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_water = 998.2;
constexpr double k_water_viscosity = 0.998e-3;
constexpr double k_air = 1.19;
constexpr double k_air_viscosity = 1.84e-5;

/// A box of air with water up to half its height along `axis`.
Case half_filled(int axis) {
  Case c;
  c.max = {0.02, 0.02, 0.02};
  c.cells = {6, 6, 6};
  c.fluid.density = k_air;
  c.fluid.viscosity = k_air_viscosity;
  c.fluid.pressure_tolerance = 1e-10;
  scenario::FluidRegion water{"water", {-1, -1, -1}, {1, 1, 1}, k_water, k_water_viscosity};
  water.max[axis] = 0.01;
  c.fluid.regions = {water};
  return c;
}

}  // namespace

TEST_CASE("two layers between plates shall share the shear stress, along any axis") {
  // Steady Couette flow: mu du/dn is one number, so the speeds are straight lines in each layer.
  for (int axis = 0; axis < 3; ++axis) {
    const int along = (axis + 1) % 3;
    Case c = half_filled(axis);
    Vec3 speed;
    const double plate = 1e-6;  // slow, so that steps of seconds carry nothing across a cell
    speed[along] = plate;
    c.sides[2 * axis] = wall();
    c.sides[2 * axis + 1] = wall(speed);
    c.start();
    // 0.01 m of water take h^2 / nu = 100 s.
    for (int n = 0; n < 400; ++n) c.advance(5.0);
    const double between = k_air_viscosity / (k_air_viscosity + k_water_viscosity);
    for (int n = 0; n < 6; ++n) {
      std::array<int, 3> at{2, 2, 2};
      at[static_cast<std::size_t>(axis)] = n;
      const double s = (n + 0.5) / 3.0;  // in layers
      const double expected = s < 1.0 ? between * s : between + (1.0 - between) * (s - 1.0);
      CHECK(c.u(along, at[0], at[1], at[2]) == test::approx(plate * expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("a pressure shall accelerate two slugs in a row by the sum of their masses") {
  for (int axis = 0; axis < 3; ++axis) {
    Case c = half_filled(axis);
    c.sides[2 * axis] = open_side(5.0, false);
    c.sides[2 * axis + 1] = open_side(0.0, false);
    c.start();
    for (int n = 0; n < 10; ++n) c.advance(1e-3);
    const double expected = 5.0 * 0.01 / (0.01 * (k_air + k_water));
    CHECK(c.u(axis, 3, 3, 3) == test::approx(expected).epsilon(1e-7));
  }
}

TEST_CASE("a region of the same fluid shall change nothing but rounding") {
  const auto run = [](bool has_region) {
    Case c;
    c.max = {0.02, 0.02, 0.02};
    c.cells = {8, 8, 8};
    c.fluid.density = 1.2;
    c.fluid.viscosity = 1.8e-5;
    c.fluid.pressure_tolerance = 1e-10;
    if (has_region) {
      c.fluid.regions = {{"same", {-1, -1, -1}, {0.012, 0.01, 0.009}, 1.2, 1.8e-5}};
    }
    c.sides[4] = wall();
    c.sides[5] = wall({0.7, 0, 0});
    c.start();
    c.solver->set_velocity([](Vec3 p) {
      return Vec3{std::sin(400 * p.y), std::cos(500 * p.z), std::sin(300 * p.x + 1)};
    });
    for (int n = 0; n < 5; ++n) c.advance(1e-3);
    return c.u(0, 3, 4, 5) + c.u(1, 2, 2, 6) + c.u(2, 5, 1, 3);
  };
  CHECK(run(true) == test::approx(run(false)).epsilon(1e-9));
}

TEST_CASE("a point beyond a periodic side shall be in the fluid of its image in the domain") {
  Case c = half_filled(2);
  c.fluid.regions[0].min = {0, 0, 0};
  c.fluid.regions[0].max = {0.02, 0.02, 0.01};
  const auto grid = fluid::Grid::make(c.min, c.max, c.cells, {true, false, false});
  const fluid::Properties by_place(c.fluid, grid.origin, grid.period());
  CHECK(by_place.at({0.01, 0.01, 0.005}).density == k_water);
  for (const double x : {-0.001, 0.0201, 0.045}) {
    CHECK(by_place.at({x, 0.01, 0.005}).density == k_water);
    CHECK(by_place.at({x, 0.01, 0.015}).density == k_air);
  }
  // Along y it ends.
  CHECK(by_place.at({0.01, 0.021, 0.005}).density == k_air);
}
