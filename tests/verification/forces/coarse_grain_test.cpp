// SPDX-License-Identifier: Apache-2.0
// A grain that stands for smaller ones, beside one of these.
#include "still.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace {

using namespace dust;
using test::Still;
using test::World;

/// Number of grains along an edge that one stands for.
constexpr double k_ratio = 3.0;

/// A grain that stands for smaller ones and one of these, in a stream with shear, both spinning.
struct Pair {
  explicit Pair(World::Choice choice, const std::vector<Still::Force>& forces)
      : still(with_material(std::move(choice)), forces, {0, 0, -9.81}) {
    still.world.set(still.world.velocity, [](sdk::Vec3 x) {
      return sdk::Vec3{0.3 + 2.0 * x.z, 0.1 - x.x, 0.05 * x.y};
    });
    for (const double d : {k_diameter * k_ratio, k_diameter}) {
      still.world.grains.add({0.5, 0.4, 0.3}, {0.1, -0.05, 0.02}, d);
    }
    still.world.grains.rotation = {30, -20, 10, 0, 30, -20, 10, 0};
    still.world.grains.material[1] = 1;
  }
  static World::Choice with_material(World::Choice choice) {
    choice.coarse_graining = {k_ratio, 1.0};
    return choice;
  }
  static constexpr double k_diameter = 4e-4;
  Still still;
};

TEST_CASE("a coarse grain shall fly as those it stands for, in air and with a liquid's forces") {
  World::Choice air;
  air.factor = [](double re, double) { return 1.0 + 0.15 * std::pow(re, 0.687); };
  air.cells = {8, 8, 8};
  World::Choice water = air;
  water.density = 998.2;
  water.viscosity = 1e-3;
  const std::vector<Still::Force> all{{"virtual_mass"}, {"basset"}, {"saffman"}, {"magnus"}};
  for (const bool is_water : {false, true}) {
    CAPTURE(is_water);
    Pair pair(is_water ? water : air, is_water ? all : std::vector<Still::Force>{});
    const auto& grains = pair.still.world.grains;
    for (int n = 0; n < 40; ++n) pair.still.step(4, pair.still.weight(test::k_sand));
    for (std::size_t d = 0; d < 3; ++d) {
      CAPTURE(d);
      CHECK(std::abs(grains.velocity[d] - 0.1) > 1e-3);  // it has been pushed about
      CHECK(grains.velocity[d] == test::approx(grains.velocity[4 + d]).epsilon(1e-10));
      CHECK(grains.position[d] == test::approx(grains.position[4 + d]).epsilon(1e-10));
    }
  }
}

}  // namespace
