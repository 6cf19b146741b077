// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/cell_order.hpp"
#include "coupling/stencils/face_void_fraction.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <numeric>
#include <vector>

namespace {

using namespace dust;
using coupling::StencilBatch;
using test::World;

/// Grains in a box with closed cells and solids in some; those of a batch, in the order of the
/// cells.
struct Faces {
  Faces(bool is_periodic, std::array<int, 3> cells) : world(choice(is_periodic, cells)) {
    // Solids in some cells, two of them at sides.
    std::vector<std::ptrdiff_t> touched;
    for (std::array<int, 3> c :
         std::vector<std::array<int, 3>>{{0, 0, 0}, {1, 0, 0}, {2, 0, 2}, {4, 0, 3}}) {
      for (std::size_t d = 0; d < 3; ++d) c[d] = std::min(c[d], cells[d] - 1);
      const std::ptrdiff_t cell = world.grid.index(c[0], c[1], c[2]);
      if (eps[cell] == 1.0) touched.push_back(cell);
      eps[cell] = random.between(0.4, 0.9);
    }
    const std::ptrdiff_t other = world.grid.index(cells[0] - 2, 0, cells[2] - 1);
    faces.update(fluid::CellField(world.grid.size, 0.5), {other});
    faces.update(eps, touched);  // what was set before is 1 again
    for (double& number : u) number = random.next();
    for (std::size_t q = 0; q < k_count; ++q) {
      // Some lie beyond the sides.
      for (int d = 0; d < 3; ++d) position.push_back(random.between(-0.1, 1.1));
      position.push_back(1e-3);
    }
    coupling::CellOrder order;
    order.sort(world.grid, position.data(), k_count);
    rows.assign(order.rows().begin(), order.rows().end());
    stencils->count = k_count;
    for (std::size_t q = 0; q < k_count; ++q) {
      std::copy_n(&position[4 * static_cast<std::size_t>(rows[q])], 4, &stencils->position[4 * q]);
    }
    lattice.place(*stencils);
  }
  static World::Choice choice(bool is_periodic, std::array<int, 3> cells) {
    World::Choice c;
    c.cells = cells;
    c.periodic = {is_periodic, is_periodic, false};
    c.open = [](int i, int, int k) { return i == 3 && k < 2 ? 0.0 : k == 0 ? 0.7 : 1.0; };
    return c;
  }

  static constexpr std::size_t k_count = 200;
  const World world;
  const coupling::Lattice lattice{world.grid, world.open};
  test::Numbers random;
  fluid::CellField eps = fluid::CellField(world.grid.size, 1.0);
  coupling::FaceVoidFraction faces{lattice};
  std::vector<double> u = std::vector<double>(world.grid.size);
  std::vector<double> position;
  std::vector<std::int32_t> rows;
  std::unique_ptr<StencilBatch> stencils = std::make_unique<StencilBatch>();
};

constexpr std::array<int, 3> k_many_cells{5, 1, 4};
constexpr std::array<int, 3> k_few_cells{2, 1, 2};

TEST_CASE("the order of the cells shall hold every grain once, those of one eighth by row") {
  const Faces f(true, k_few_cells);
  std::vector<std::int32_t> sorted = f.rows;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> all(Faces::k_count);
  std::iota(all.begin(), all.end(), 0);
  CHECK(sorted == all);
  // 32 eighths at most, and no group comes twice.
  CHECK(f.stencils->groups <= 32);
  for (std::size_t r = 0; r < f.stencils->groups; ++r) {
    const auto first = f.rows.begin() + f.stencils->group[r];
    CHECK(std::is_sorted(first, f.rows.begin() + f.stencils->group[r + 1]));
  }
}

TEST_CASE("a large grid shall be ordered as a small one") {
  // Numbers of eighths of 1, 2 and 3 digits of the sort.
  for (const int n : {4, 40, 200}) {
    CAPTURE(n);
    World::Choice choice;
    choice.cells = {n, 2, n};
    const World world(choice);
    test::Numbers random;
    std::vector<double> position;
    for (int q = 0; q < 3000; ++q) {
      for (int d = 0; d < 3; ++d) position.push_back(random.between(-0.01, 1.01));
      position.push_back(1e-3);
    }
    coupling::CellOrder order;
    order.sort(world.grid, position.data(), 3000);
    const auto eighth = [&](std::int32_t row) {
      std::array<long, 3> at;
      for (int d = 0; d < 3; ++d) {
        const int halves = 2 * choice.cells[d];
        const double s = position[4 * static_cast<std::size_t>(row) + d] * halves;
        at[static_cast<std::size_t>(d)] = static_cast<long>(std::clamp(s, 0.0, halves - 1.0));
      }
      return std::array<long, 4>{at[2], at[1], at[0], row};
    };
    CHECK(order.rows().size() == 3000);
    CHECK(std::is_sorted(order.rows().begin(), order.rows().end(),
                         [&](std::int32_t a, std::int32_t b) { return eighth(a) < eighth(b); }));
  }
}

TEST_CASE("batches of grains shall see at their faces what each sees by itself") {
  for (const auto& cells : {k_many_cells, k_few_cells}) {
    for (const bool is_periodic : {false, true}) {
      CAPTURE(is_periodic);
      CAPTURE(cells[0]);
      Faces f(is_periodic, cells);
      CHECK(coupling::has_large_groups(*f.stencils) ==
            (cells == k_few_cells));  // both ways of looking
      StencilBatch::Reals v, open, fluid, flux, given, slip, ratio;
      auto contributions = std::make_unique<coupling::FaceContributions>();
      for (std::size_t q = 0; q < Faces::k_count; ++q) {
        v[q] = contributions->velocity[q] = f.random.next();
        contributions->drag[q] = f.random.next();
        contributions->flux_difference[q] = f.random.next();
        contributions->extra[q] = f.random.next();
      }
      for (int d = 0; d < 3; ++d) {
        CAPTURE(d);
        coupling::sample_faces(*f.stencils, d, f.faces.columns(d), f.u.data(), v.data(),
                               {open.data(), fluid.data()}, flux.data());
        coupling::evaluate_faces(*f.stencils, d, f.faces.columns(d), f.u.data(), *contributions,
                                 3.0, false, given.data());
        std::vector<double> drag(f.world.grid.size), push(f.world.grid.size),
            extra(f.world.grid.size);
        for (std::size_t q = 0; q < Faces::k_count; ++q) {
          const coupling::Place p = f.lattice.place(&f.stencils->position[4 * q]);
          CHECK(coupling::cell_of(*f.stencils, q) == f.lattice.cell(p));
          coupling::Stencil s;
          f.lattice.stencil(d, p, f.eps, s);
          double sums[4] = {};
          for (std::size_t n = 0; n < coupling::size(s); ++n) {
            const double part = s.weight[n] * s.open[n];
            const double slip_at = s.void_fraction[n] * (f.u[s.storage[n]] - v[q]);
            sums[0] += part;
            sums[1] += part * s.void_fraction[n];
            sums[2] += s.weight[n] * slip_at;
            sums[3] += part * s.void_fraction[n] * (slip_at + contributions->flux_difference[q]);
            drag[s.storage[n]] += s.weight[n] * contributions->drag[q];
            push[s.storage[n]] += s.weight[n] * contributions->drag[q] * v[q];
            extra[s.storage[n]] += s.weight[n] * contributions->extra[q];
          }
          CHECK(open[q] == test::approx(sums[0]).epsilon(1e-12));
          CHECK(fluid[q] == test::approx(sums[1]).epsilon(1e-12));
          CHECK(flux[q] == test::approx(sums[2]).epsilon(1e-12));
          CHECK(given[q] == test::approx(3.0 * contributions->drag[q] * sums[3]).epsilon(1e-12));
        }
        // Runs give the same faces the same, whatever stands behind their ends.
        for (std::size_t r = 0; r < f.stencils->groups; ++r) {
          coupling::GroupContributions sum;
          coupling::sum_group(*f.stencils, d, r, *contributions, sum);
          std::size_t n = 0;
          coupling::for_corners(
              coupling::corners(*f.stencils, d, (d + 1) % 3, (d + 2) % 3, f.stencils->group[r]),
              [&](std::int32_t face, double) {
                drag[face] -= sum.drag[n];
                push[face] -= sum.push[n];
                extra[face] -= sum.extra[n];
                ++n;
              });
        }
        for (const auto* left : {&drag, &push, &extra}) {
          double largest = 0.0;
          for (const double l : *left) largest = std::max(largest, std::abs(l));
          CHECK(largest < 1e-12);
        }
        const StencilBatch::Reals around = [&] {
          StencilBatch::Reals e;
          e.fill(0.5);
          return e;
        }();
        coupling::slip_of_faces(Faces::k_count, around.data(), {open.data(), fluid.data()},
                                flux.data(), slip.data(), ratio.data());
        for (std::size_t q = 0; q < Faces::k_count; ++q) {
          CHECK(slip[q] == test::approx(2.0 * flux[q]).epsilon(1e-14));
          const double expected = open[q] > 0.0 ? 2.0 * fluid[q] / open[q] : 1.0;
          CHECK(ratio[q] == test::approx(expected).epsilon(1e-14));
        }
      }
    }
  }
}

}  // namespace
