// SPDX-License-Identifier: Apache-2.0
#include "coupling/drag/drag_model.hpp"

#include "fluid/momentum_set.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <numbers>

namespace {

using namespace dust;
using test::World;

coupling::DragModel model_of(const World& world) {
  return {*world.drag, *world.setup.fluid, world.grid, world.setup.materials};
}

World::Choice power_law(double exponent) {
  World::Choice choice;
  choice.factor = [exponent](double re, double) { return std::pow(re, exponent); };
  return choice;
}

}  // namespace

TEST_CASE(
    "the drag coefficient shall be Stokes's times the factor, that of what a grain stands for") {
  World::Choice choice = power_law(0.0);
  choice.coarse_graining = {1.0, 2.0};
  World world(choice);
  world.grains.add({0.5, 0.5, 0.5}, {0, 0, 0}, 2e-3);
  world.grains.add({0.5, 0.5, 0.5}, {0, 0, 0}, 2e-3);
  world.grains.material[1] = 1;
  const coupling::DragModel model = model_of(world);
  const auto rows = world.grains.rows();
  const double stokes = 3.0 * std::numbers::pi * test::k_air_viscosity * 2e-3;
  CHECK(model.coefficient(rows, 0, 1.5) == test::approx(1.5 * stokes).epsilon(1e-14));
  // Eight of half the diameter: 8 / 2 times as much.
  CHECK(model.coefficient(rows, 1, 1.0) == test::approx(4.0 * stokes).epsilon(1e-14));
  CHECK(model.reynolds(rows, 0, 0.8, 3.0) ==
        test::approx(0.8 * 3.0 * 2e-3 * test::k_air / test::k_air_viscosity).epsilon(1e-14));
  CHECK(model.reynolds(rows, 1, 0.8, 3.0) ==
        test::approx(0.5 * model.reynolds(rows, 0, 0.8, 3.0)).epsilon(1e-14));
  const double mass = rows.mass(1);
  CHECK(model.fastest_relaxation(rows) == test::approx(4.0 * stokes / mass).epsilon(1e-14));
}

TEST_CASE("the slope of a power law shall be its exponent, at most that of inertia") {
  for (const double exponent : {0.0, 0.5, 1.0, 2.0}) {
    CAPTURE(exponent);
    const World world(power_law(exponent));
    const coupling::DragModel model = model_of(world);
    auto columns = std::make_unique<coupling::DragColumns>();
    for (std::size_t q = 0; q < 3; ++q) {
      columns->reynolds[q] = std::pow(100.0, static_cast<double>(q));
      columns->void_fraction[q] = 1.0;
    }
    double slope[3] = {-1, -1, -1};
    model.evaluate(*columns, 3);
    model.find_slope(*columns, 3, slope);
    for (const double s : slope) {
      CHECK(s == test::approx(std::min(exponent, 1.0)).epsilon(0.004));
      CHECK(s <= 1.0);
    }
  }
}

TEST_CASE("a law that ends at 0 shall have a slope there, as Ergun's for a lone grain at rest") {
  World::Choice choice;
  choice.drag = "ergun";
  const World world(choice);
  const coupling::DragModel model = model_of(world);
  auto columns = std::make_unique<coupling::DragColumns>();
  columns->reynolds[0] = 0.0;
  columns->void_fraction[0] = 1.0;
  double slope = -1.0;
  model.evaluate(*columns, 1);
  REQUIRE(columns->factor[0] == 0.0);
  model.find_slope(*columns, 1, &slope);
  CHECK(slope == 0.0);
}

TEST_CASE("set III shall have the pressure's part in the drag, and act on the whole volume") {
  using fluid::MomentumSet;
  CHECK(fluid::momentum_set_of("I") == MomentumSet::one);
  CHECK(fluid::momentum_set_of("II") == MomentumSet::two);
  CHECK(fluid::momentum_set_of("III") == MomentumSet::three);
  CHECK(fluid::fluid_fraction(MomentumSet::two, 0.4) == 0.4);
  CHECK(fluid::fluid_fraction(MomentumSet::three, 0.4) == 1.0);
  for (const char* set : {"I", "II", "III"}) {
    World::Choice choice = power_law(0.0);
    choice.momentum_set = set;
    const World world(choice);
    const double expected = choice.momentum_set == "III" ? 2.5 : 1.0;
    CHECK(model_of(world).factor_of_set(0.4) == expected);
  }
}
