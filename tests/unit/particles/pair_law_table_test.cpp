// SPDX-License-Identifier: Apache-2.0
#include "particles/pair_law_table.hpp"

#include "dust/sdk/error.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>

using namespace dust::particles;
using dust::test::DemRig;

TEST_CASE("pair laws shall be found from either side, and a pair without one be named") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  const int belt = rig.material(1100, 20e6, 0.45);
  const int plate = rig.material(7800, 90e6, 0.3);
  rig.law(sand, sand, 0.7, 0.4);
  rig.law(belt, sand, 0.5, 0.6, 0.3);
  const PairLawTable table(std::move(rig.laws), {"sand", "belt", "plate"}, 600e-6);
  REQUIRE(table.size() == 2);
  CHECK(table.index(sand, sand) == 0);
  CHECK(table.index(sand, belt) == 1);
  CHECK(table.index(belt, sand) == 1);
  CHECK(table[1].rolling != nullptr);
  CHECK(table.material_name(belt) == "belt");
  CHECK_THROWS_WITH_AS(static_cast<void>(table.index(sand, plate)),
                       "no interaction between the materials sand and plate: declare one under "
                       "`interactions`",
                       dust::sdk::ModelError);
}

TEST_CASE("room for a contact's history shall hold the law with most of it, in fours") {
  for (const bool has_rolling : {false, true}) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.7, 0.4, has_rolling ? 0.3 : -1.0);
    const int kept = rig.laws[0].history_size();
    const PairLawTable table(std::move(rig.laws), {"sand"}, 600e-6);
    CHECK(static_cast<int>(table.history_stride()) >= std::max(kept, 4));
    CHECK(static_cast<int>(table.history_stride()) < std::max(kept, 4) + 4);
    CHECK(table.history_stride() % 4 == 0);
  }
}

TEST_CASE("a cohesive law's range shall be that of the largest particle at a wall") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.laws_of(sand, sand, {"hertz_mindlin", {{"restitution", 0.7}, {"friction", 0.4}}}, {},
              {"jkr", {{"surface_energy", 0.05}}});
  const double largest = rig.laws[0].range_of(300e-6);
  const double small = rig.laws[0].range_of(5e-6);
  CHECK(small > 0.0);
  CHECK(small < largest);
  const PairLawTable table(std::move(rig.laws), {"sand"}, 600e-6);
  CHECK(table[0].range == largest);
  CHECK(table.largest_range() == largest);
}
