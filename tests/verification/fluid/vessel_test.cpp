// SPDX-License-Identifier: Apache-2.0
// Closed vessels stay closed, wherever and however they lie in the grid.
#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include <doctest/doctest.h>

#include <array>
#include <random>
#include <vector>

using namespace dust;
using namespace dust::test;

namespace {

/// A still box of 14 cells of edge 1 along each axis.
Case still_box() {
  Case c;
  c.max = {14, 14, 14};
  c.cells = {14, 14, 14};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  for (auto& s : c.sides) s = wall();
  return c;
}

/// Whether fluid gets from the first cell to the one in the middle.
bool leads_in(const Case& c) {
  const fluid::FaceField open = c.solver->passable_area();
  using Cell = std::array<int, 3>;
  std::vector<char> is_reached(c.grid.size, 0);
  std::vector<Cell> next{{0, 0, 0}};
  const auto reach = [&](Cell cell) {
    char& seen = is_reached[static_cast<std::size_t>(c.grid.index(cell[0], cell[1], cell[2]))];
    if (seen == 0) next.push_back(cell);
    seen = 1;
  };
  while (!next.empty()) {
    const Cell cell = next.back();
    next.pop_back();
    for (std::size_t d = 0; d < 3; ++d) {
      const std::ptrdiff_t here = c.grid.index(cell[0], cell[1], cell[2]);
      Cell to = cell;
      if (cell[d] > 0 && open.component[d][static_cast<std::size_t>(here)] > 0.0) {
        to[d] = cell[d] - 1;
        reach(to);
      }
      const auto above = static_cast<std::size_t>(here + c.grid.stride[d]);
      if (cell[d] + 1 < c.cells[d] && open.component[d][above] > 0.0) {
        to[d] = cell[d] + 1;
        reach(to);
      }
    }
  }
  return is_reached[static_cast<std::size_t>(c.grid.index(7, 7, 7))] != 0;
}

struct Placing {
  Vec3 centre, about;
  double angle;
};

Placing random_placing(std::mt19937_64& random, bool is_turned) {
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  std::normal_distribution<double> any(0.0, 1.0);
  Placing p;
  p.centre = Vec3{7.5, 7.5, 7.5} + Vec3{shift(random), shift(random), shift(random)};
  p.about = {any(random), any(random), any(random)};
  p.angle = is_turned ? std::uniform_real_distribution<double>(0.0, 3.0)(random) : 0.0;
  return p;
}

/// Vessels that let fluid in, of 25 places; `add_walls`(bodies, placing) builds one.
template <class AddWalls>
int count_leaks(std::mt19937_64& random, bool is_turned, const AddWalls& add_walls) {
  int leaks = 0;
  for (int n = 0; n < 25; ++n) {
    Case c = still_box();
    add_walls(c.bodies, random_placing(random, is_turned));
    c.start();
    leaks += leads_in(c) ? 1 : 0;
  }
  return leaks;
}

/// [cells] Half the edges of a vessel.
constexpr Vec3 k_half{3.4, 3.1, 3.7};

}  // namespace

TEST_CASE("a closed vessel shall be tight wherever it lies, with walls thin and thick") {
  std::mt19937_64 random(11);
  for (const bool is_turned : {false, true}) {
    for (const double thickness : {0.0, 0.1, 0.3, 0.7, 1.1}) {
      CAPTURE(is_turned);
      CAPTURE(thickness);
      CHECK(count_leaks(random, is_turned, [&](bodies::BodySet& bodies, const Placing& p) {
              bodies.push_back(body(
                  std::make_unique<Vessel>(p.centre, k_half, thickness, p.about, p.angle), 0.0));
            }) == 0);
    }
  }
}

TEST_CASE("a vessel of six plates that meet at its edges shall be tight wherever it lies") {
  std::mt19937_64 random(12);
  for (const bool is_turned : {false, true}) {
    for (const double thickness : {0.1, 0.5}) {
      const auto add_plates = [&](bodies::BodySet& bodies, const Placing& p) {
        // The plates turn about the middle of the vessel.
        const TurnedBox whole({}, k_half, p.about, p.angle);
        for (int side = 0; side < 6; ++side) {
          const int d = side / 2;
          Vec3 along;
          along[d] = side % 2 == 0 ? -k_half[d] : k_half[d];
          Vec3 plate = k_half;
          plate[d] = 0.5 * thickness;
          bodies.push_back(body(
              std::make_unique<TurnedBox>(p.centre + whole.turned(along), plate, p.about, p.angle),
              0.0));
        }
      };
      CAPTURE(is_turned);
      CAPTURE(thickness);
      CHECK(count_leaks(random, is_turned, add_plates) == 0);
    }
  }
}

TEST_CASE("a vessel with a hole shall let fluid in, or the search for leaks finds none") {
  Case c = still_box();
  for (int side = 0; side < 5; ++side) {
    const int d = side / 2;
    Vec3 middle{7.5, 7.5, 7.5};
    middle[d] += side % 2 == 0 ? -k_half[d] : k_half[d];
    Vec3 plate = k_half;
    plate[d] = 0.1;
    c.bodies.push_back(body(std::make_unique<TurnedBox>(middle, plate, Vec3{0, 0, 1}, 0.0), 0.0));
  }
  c.start();
  CHECK(leads_in(c));
}
