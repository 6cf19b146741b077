// SPDX-License-Identifier: Apache-2.0
// Forces that momentum sets I and II contain: named or not, grains feel them once.
#include "still.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <string>

namespace {

using namespace dust;
using test::Still;
using test::World;

constexpr double k_diameter = 1e-3;
const double k_volume = sdk::sphere_volume(k_diameter);
const sdk::Vec3 k_gravity{1.0, 0, -9.81};

World::Choice water() {
  World::Choice choice;
  choice.density = 998.2;
  choice.viscosity = 1e-3;
  return choice;
}

/// A flow with pressure gradient (120, 0, -40) Pa/m and div tau (0, 8, 3) N/m3.
void set_stress(Still& still) {
  still.world.set(still.world.stress, [](sdk::Vec3) { return sdk::Vec3{-120.0, 8.0, 43.0}; });
  const fluid::Grid& grid = still.world.grid;
  still.world.for_cells([&](int i, int j, int k) {
    const sdk::Vec3 x = grid.centre(i, j, k);
    still.pressure[static_cast<std::size_t>(grid.index(i, j, k))] = 120.0 * x.x - 40.0 * x.z;
  });
}

sdk::Vec3 force_at_rest(const std::vector<Still::Force>& names, bool has_stress) {
  Still still(water(), names, k_gravity);
  if (has_stress) set_stress(still);
  still.world.grains.add({0.3, 0.2, 0.1}, {}, k_diameter);
  still.map();
  still.refresh(1e-4);
  return still.force();
}

TEST_CASE("V-INV-10: Archimedes shall give the displaced weight, gravity being a vector") {
  const sdk::Vec3 lift = force_at_rest({{"archimedes"}}, false);
  CHECK(lift.x == test::approx(-998.2 * k_volume * 1.0).epsilon(1e-10));
  CHECK(lift.z == test::approx(998.2 * k_volume * 9.81).epsilon(1e-10));
  // The whole pressure of a fluid at rest does the same; without a model the weight is reduced.
  const sdk::Vec3 whole = force_at_rest({{"pressure_gradient", {{"hydrostatic", true}}}}, false);
  CHECK(norm(whole - lift) < 1e-10 * norm(lift));
  CHECK(norm(force_at_rest({}, false)) == 0.0);
}

TEST_CASE("pressure and viscous stress shall act once, whoever gives them") {
  const sdk::Vec3 expected{-120.0 * k_volume, 8.0 * k_volume, 43.0 * k_volume};
  using Names = std::vector<Still::Force>;
  for (const Names& names :
       {Names{}, Names{{"pressure_gradient"}}, Names{{"viscous"}},
        Names{{"viscous"}, {"pressure_gradient"}}, Names{{"saffman"}, {"viscous"}}}) {
    CAPTURE(names.size());
    const sdk::Vec3 got = force_at_rest(names, true);
    CHECK(norm(got - expected) < 1e-10 * norm(expected));
  }
  // The whole pressure has the weight of the fluid in it.
  const sdk::Vec3 whole = force_at_rest({{"pressure_gradient", {{"hydrostatic", true}}}}, true);
  CHECK(whole.z == test::approx((43.0 + 998.2 * 9.81) * k_volume).epsilon(1e-10));
}

TEST_CASE("a grain shall fall alike whether its weight is reduced or Archimedes lifts it") {
  const auto fall = [](const std::vector<Still::Force>& names) {
    Still still(water(), names, {0, 0, -9.81});
    still.world.grains.add({0, 0, 0}, {}, k_diameter);
    for (int n = 0; n < 100; ++n) still.step(4, still.weight(test::k_sand));
    return still.world.grains.position[2];
  };
  const double reduced = fall({});
  CHECK(reduced < -0.02);
  CHECK(fall({{"archimedes"}}) == test::approx(reduced).epsilon(1e-10));
}

TEST_CASE("in set III a force on grain and fluid shall be divided by the void fraction") {
  // Uniform stream past a held grain that spins; eps is 1 without feedback, so the set changes
  // nothing here but the parts it has in the drag.
  for (const std::string set : {"I", "III"}) {
    CAPTURE(set);
    World::Choice choice = water();
    choice.momentum_set = set;
    Still still(choice, {{"magnus"}});
    set_stress(still);
    still.world.set(still.world.velocity, [](sdk::Vec3) { return sdk::Vec3{0.1, 0, 0}; });
    still.world.grains.add({0.3, 0.2, 0.1}, {}, k_diameter);
    still.world.grains.rotation[1] = 20.0;
    still.map();
    still.refresh(1e-4);
    const double lift = 3.14159265358979 / 8.0 * 1e-9 * 998.2 * 2.0;
    const double stress = set == "I" ? 43.0 * k_volume : 0.0;
    CHECK(still.force().z == test::approx(lift + stress).epsilon(1e-9));
  }
}

}  // namespace
