// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/face_stencils.hpp"

#include "coupling/stress_balance.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace dust;
using coupling::FaceStencils;
using coupling::StencilBatch;
using test::World;

void scatter(World& world, int count) {
  test::Numbers random;
  for (int g = 0; g < count; ++g) {
    world.grains.add({random.between(0.1, 0.9), random.between(0.1, 0.9), random.between(0.1, 0.9)},
                     {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}, 1e-3);
  }
}

}  // namespace

TEST_CASE("stencils shall hold every grain once, in batches, until the rows are others") {
  World world({});
  scatter(world, 600);
  FaceStencils stencils;
  stencils.sort(world.grid, world.grains.rows(), 5);
  REQUIRE(stencils.size() == 3);
  CHECK(stencils.rows(0).size() == StencilBatch::k_size);
  CHECK(stencils.rows(2).size() == 600 - 2 * StencilBatch::k_size);
  std::vector<std::int32_t> rows(stencils.rows().begin(), stencils.rows().end());
  std::sort(rows.begin(), rows.end());
  std::vector<std::int32_t> all(600);
  std::iota(all.begin(), all.end(), 0);
  CHECK(rows == all);
  CHECK(stencils.are_in_order(5, 600));
  CHECK_FALSE(stencils.are_in_order(6, 600));
  CHECK_FALSE(stencils.are_in_order(5, 599));
}

TEST_CASE("stencils ahead of grains shall be those of the grains where they fly to") {
  World world({});
  scatter(world, 200);
  const coupling::Lattice lattice(world.grid, world.open);
  constexpr double k_ahead = 0.05;
  FaceStencils ahead;
  ahead.sort(world.grid, world.grains.rows(), 1);
  const std::vector<std::int32_t> rows(ahead.rows().begin(), ahead.rows().end());
  const StencilBatch& batch = ahead.locate(lattice, world.grains.rows(), 0, k_ahead);
  CHECK(batch.count == 200);
  for (std::size_t q = 0; q < batch.count; ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    double there[3];
    for (std::size_t d = 0; d < 3; ++d) {
      there[d] = world.grains.position[4 * row + d] + k_ahead * world.grains.velocity[4 * row + d];
      CHECK(batch.position[4 * q + d] == there[d]);
    }
    CHECK(coupling::cell_of(batch, q) == lattice.cell(lattice.place(there)));
  }
}

TEST_CASE("what grains receive of the stress shall be taken off what the fluid left them") {
  World world({});
  const coupling::Lattice lattice(world.grid, world.open);
  coupling::StressBalance balance(lattice, *world.voidage);
  // One grain that fills a tenth of its cell, in a uniform stress.
  const double cell = world.grid.cell_volume();
  const double diameter = 0.03;
  world.grains.add({0.6, 0.6, 0.6}, {0, 0, 0}, diameter);
  const std::ptrdiff_t storage = world.grid.index(2, 2, 2);
  fluid::CellField eps(world.grid.size, 1.0);
  eps[storage] = 0.9;
  const sdk::Vec3 stress{3.0, -2.0, 0.5};
  world.set(world.stress, [&](sdk::Vec3) { return stress; });
  constexpr double k_step = 1e-3;
  balance.leave(eps, world.stress, k_step);
  for (int d = 0; d < 3; ++d) {
    CHECK(balance.deferred(d)[static_cast<std::size_t>(storage)] ==
          test::approx(k_step * cell * 0.1 * stress[d]).epsilon(1e-12));
  }
  FaceStencils stencils;
  stencils.sort(world.grid, world.grains.rows(), 1);
  stencils.locate(lattice, world.grains.rows(), 0);
  const auto received = balance.room_for(1);
  for (int d = 0; d < 3; ++d) {
    received[0][static_cast<std::size_t>(d)] = k_step * cell * 0.1 * stress[d];
  }
  balance.receive(stencils, stencils.rows(), received);
  for (int d = 0; d < 3; ++d) {
    for (const double deferred : balance.deferred(d)) CHECK(std::abs(deferred) < 1e-18);
  }
}
