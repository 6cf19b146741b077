// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

namespace {

using namespace dust;
using test::Numbers;
using test::World;

// Rounding of sums of a few thousand shares.
constexpr double k_sum = 1e-12;

double mapped_volume(const World& world) {
  double sum = 0.0;
  world.for_cells([&](int i, int j, int k) {
    const std::ptrdiff_t c = world.grid.index(i, j, k);
    sum += (1.0 - world.coupling->void_fraction()[c]) * world.open[c] * world.grid.cell_volume();
  });
  return sum;
}

TEST_CASE("the mapped volume shall be that of the grains, at walls, corners and periodic sides") {
  for (const char* rule : {"centre", "divided", "big_particle", "gaussian"}) {
    for (const bool periodic : {false, true}) {
      World::Choice choice;
      choice.max = {0.01, 0.012, 0.014};
      choice.cells = {10, 10, 10};
      choice.periodic = {periodic, periodic, false};
      choice.voidage = rule;
      World world(choice);
      Numbers random;
      for (int g = 0; g < 2000; ++g) {
        world.grains.add(
            {random.between(0, 0.01), random.between(0, 0.012), random.between(0, 0.014)}, {},
            random.between(1e-5, 5e-4), 2650, random.between(0.05, 1));
      }
      world.grains.add({0, 0, 0}, {}, 5e-4);
      world.grains.add({0.01, 0.012, 0.014}, {}, 5e-4);
      world.begin_step(1e-3);
      CHECK(mapped_volume(world) == test::approx(world.grains.solid_volume()).epsilon(k_sum));
      CHECK(world.coupling->report().moved_shares > 0);
      CHECK(world.coupling->report().unplaced_grains == 0);
    }
  }
}

TEST_CASE("a lone grain's own kernel shall hold its volume at walls, corners and bodies, too") {
  for (const char* rule : {"big_particle", "gaussian"}) {
    for (const double diameter : {0.6e-3, 0.96e-3, 2e-3}) {
      for (const int sides : {1, 2, 3}) {
        World::Choice choice;
        choice.max = {0.012, 0.012, 0.012};
        choice.cells = {12, 12, 12};
        choice.voidage = rule;
        choice.disturbance_correction = scenario::DisturbanceCorrection::automatic;
        // A body that ends on a plane of the grid.
        choice.open = [](int, int, int k) { return k < 9 ? 1.0 : 0.0; };
        for (const bool is_at_body : {false, true}) {
          World world(choice);
          const double r = 0.5 * diameter;
          world.grains.add(
              {sides > 1 ? r : 0.0063, sides > 2 ? r : 0.0057, is_at_body ? 0.009 - r : r}, {},
              diameter);
          world.begin_step(1e-3);
          CAPTURE(rule);
          CAPTURE(diameter);
          CAPTURE(sides);
          CAPTURE(is_at_body);
          CHECK(mapped_volume(world) == test::approx(world.grains.solid_volume()).epsilon(k_sum));
        }
      }
    }
  }
}

TEST_CASE("wide grains shall keep their volume in a domain thinner than themselves") {
  for (const char* rule : {"big_particle", "gaussian"}) {
    World::Choice choice;
    choice.max = {0.02, 0.002, 0.02};
    choice.cells = {20, 2, 20};
    choice.periodic = {false, true, false};
    choice.voidage = rule;
    World world(choice);
    world.grains.add({0.010, 0.0003, 0.012}, {}, 4e-3, 2650, 0.2);
    world.grains.add({0.0005, 0.0013, 0.019}, {}, 3e-3, 2650, 0.2);
    world.begin_step(1e-3);
    CHECK(mapped_volume(world) == test::approx(world.grains.solid_volume()).epsilon(k_sum));
    CHECK(world.coupling->report().unplaced_grains == 0);
    CHECK(world.coupling->report().largest_diameter_over_spacing == test::approx(4.0));
  }
}

TEST_CASE("a grain across a periodic side shall be mapped as the same grain inside") {
  World::Choice choice;
  choice.cells = {8, 8, 8};
  choice.periodic = {true, true, true};
  World inside(choice);
  World across(choice);
  inside.grains.add({0.26, 0.51, 0.49}, {}, 0.06);
  across.grains.add({0.01, 0.01, 0.99}, {}, 0.06);
  inside.begin_step(1e-3);
  across.begin_step(1e-3);
  int cells = 0;
  inside.for_cells([&](int i, int j, int k) {
    const double a = inside.coupling->void_fraction()[inside.grid.index(i, j, k)];
    const double b =
        across.coupling->void_fraction()[across.grid.index((i + 6) % 8, (j + 4) % 8, (k + 4) % 8)];
    CHECK(a == test::approx(b).epsilon(k_sum));
    cells += a < 1.0;
  });
  CHECK(cells == 8);
}

TEST_CASE("closed cells shall hold no grain volume and cut cells only beside their open part") {
  for (const char* rule : {"centre", "divided", "big_particle", "gaussian"}) {
    World::Choice choice;
    choice.max = {0.01, 0.01, 0.01};
    choice.cells = {10, 10, 10};
    choice.voidage = rule;
    // A body fills the lower cells; its surface cuts layer 3 (open part 0.05) and, on the right
    // half, layer 4.
    choice.open = [](int i, int, int k) {
      if (k < 3) return 0.0;
      if (k == 3) return 0.05;
      return k == 4 && i >= 5 ? 0.4 : 1.0;
    };
    World world(choice);
    Numbers random;
    for (int g = 0; g < 500; ++g) {
      world.grains.add(
          {random.between(0, 0.01), random.between(0, 0.01), random.between(0.00395, 0.0045)}, {},
          3e-4);
    }
    world.begin_step(1e-3);
    CHECK(mapped_volume(world) == test::approx(world.grains.solid_volume()).epsilon(k_sum));
    CHECK(world.coupling->report().moved_shares > 0);
    double smallest = 1.0;
    world.for_cells([&](int i, int j, int k) {
      const double eps = world.coupling->void_fraction()[world.grid.index(i, j, k)];
      if (k <= 3) CHECK(eps == 1.0);
      smallest = std::min(smallest, eps);
    });
    CHECK(smallest == world.coupling->report().smallest_void_fraction);
  }
}

TEST_CASE("an overfull cell shall give its excess to the cells around it, and count it") {
  World::Choice choice;
  choice.max = {0.01, 0.01, 0.01};
  choice.cells = {10, 10, 10};
  World world(choice);
  // 12 grains of 0.0654 of a cell each in one cell: 0.785 of it.
  for (int g = 0; g < 12; ++g) world.grains.add({0.0055, 0.0055, 0.0055}, {}, 5e-4);
  world.begin_step(1e-3);
  const double eps = world.coupling->void_fraction()[world.grid.index(5, 5, 5)];
  CHECK(eps == test::approx(0.30).epsilon(1e-9));
  CHECK(world.coupling->report().limited_cells == 1);
  CHECK(mapped_volume(world) == test::approx(world.grains.solid_volume()).epsilon(k_sum));
}

TEST_CASE("what overfull cells give shall not depend on the order of the grains") {
  World::Choice choice;
  choice.max = {0.01, 0.01, 0.01};
  choice.cells = {10, 10, 10};
  choice.voidage = "centre";
  // Neighbours of one cell that is nearly full, both overfull; and a third behind one of them.
  const auto field = [&](bool reversed) {
    World world(choice);
    std::vector<double> x;
    for (const double cell : {0.0045, 0.0055, 0.0065, 0.0075}) {
      x.insert(x.end(), cell == 0.0055 ? 9 : 13, cell);
    }
    if (reversed) std::reverse(x.begin(), x.end());
    for (const double at : x) world.grains.add({at, 0.0055, 0.0055}, {}, 5e-4);
    world.begin_step(1e-3);
    CHECK(world.coupling->report().limited_cells >= 3);
    CHECK(mapped_volume(world) == test::approx(world.grains.solid_volume()).epsilon(k_sum));
    return world.coupling->void_fraction();
  };
  const fluid::CellField one = field(false);
  const fluid::CellField other = field(true);
  double largest = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n) {
    largest = std::max(largest, std::abs(one[n] - other[n]));
  }
  CHECK(largest < 1e-12);
}

TEST_CASE("the void fraction of the last step shall be kept") {
  World world({});
  world.grains.add({0.4, 0.4, 0.4}, {}, 0.1);
  world.begin_step(1e-3);
  CHECK(*std::min_element(world.coupling->void_fraction_before().begin(),
                          world.coupling->void_fraction_before().end()) == 1.0);
  const fluid::CellField first = world.coupling->void_fraction();
  world.grains.position[0] = 0.9;
  world.begin_step(1e-3);
  CHECK(world.coupling->void_fraction_before() == first);
  CHECK(world.coupling->void_fraction() != first);
}

TEST_CASE("grains too large for the cells shall be refused with a number") {
  World::Choice choice;
  choice.cells = {10, 10, 10};
  World world(choice);
  world.grains.add({0.5, 0.5, 0.5}, {}, 0.051);
  CHECK_THROWS_WITH_AS(world.begin_step(1e-3), doctest::Contains("D/dx up to 0.5"),
                       sdk::ModelError);
  const std::array<double, 2> sizes{0.05, 0.051};
  CHECK_NOTHROW(world.coupling->check_diameters({sizes.data(), 1}));
  CHECK_THROWS_WITH_AS(world.coupling->check_diameters(sizes), doctest::Contains("use fewer"),
                       base::UserError);
}

}  // namespace
