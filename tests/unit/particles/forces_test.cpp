// SPDX-License-Identifier: Apache-2.0
#include "contact/batch.hpp"
#include "dust/sdk/random.hpp"
#include "particles/forces/deferred_forces.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/forces/ghost_exchange.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

using namespace dust::particles;

namespace {

constexpr std::int32_t k_tile = 4;
constexpr std::int32_t k_tiles = 5;

Tile tile_of(std::int32_t t) { return {t, t * k_tile, (t + 1) * k_tile}; }

/// Pairs of every tile with all later ones: particle r of a tile with r, r + 1 of the others.
struct Chain {
  GhostExchange ghosts;
  std::vector<std::vector<dust::contact::Places>> places{k_tiles};

  Chain() {
    ghosts.restart(k_tiles, k_tile, k_tile * k_tiles);
    for (std::int32_t t = 0; t < k_tiles; ++t) {
      std::vector<std::int32_t> a;
      std::vector<std::int32_t> b;
      for (std::int32_t later = t + 1; later < k_tiles; ++later) {
        for (std::int32_t r = 0; r < k_tile; ++r) {
          // Either side may stand first.
          a.push_back(r % 2 == 0 ? t * k_tile + r : later * k_tile + r);
          b.push_back(r % 2 == 0 ? later * k_tile + r : t * k_tile + r);
        }
      }
      ghosts.find_ghosts(tile_of(t), a, b, places[static_cast<std::size_t>(t)]);
    }
    ghosts.plan();
  }

  /// Forces that depend on tile and ghost, with roundings that tell one order of sums from another.
  void publish(std::int32_t t) {
    ForceBuffer force(tile_of(t), ghosts.ghosts(t).size());
    const dust::sdk::Random random(3, static_cast<std::uint64_t>(t));
    auto rows = force.ghosts();
    for (std::size_t n = 0; n < rows.size(); ++n) rows[n] = random.uniform(n, 0) * (t + 1e-3);
    ghosts.publish(t, rows);
    CHECK(std::all_of(rows.begin(), rows.end(), [](double f) { return f == 0.0; }));
  }

  [[nodiscard]] std::vector<double> sums() const {
    std::vector<double> sum(8 * k_tile * k_tiles, 0.0);
    for (std::int32_t t = 0; t < k_tiles; ++t) {
      ghosts.for_each_contribution(t, [&](std::int32_t row, const double* force) {
        REQUIRE(row / k_tile == t);
        for (std::size_t d = 0; d < 8; ++d) sum[8 * static_cast<std::size_t>(row) + d] += force[d];
      });
    }
    return sum;
  }
};

}  // namespace

TEST_CASE("ghost forces shall have the same sums in whatever order the tiles are done") {
  Chain chain;
  std::vector<std::int32_t> order(k_tiles);
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> first;
  do {
    chain.ghosts.begin_step();
    for (std::int32_t n = 0; n < k_tiles; ++n) {
      // The last tile has ghosts with none, and waits for all others.
      const bool is_complete = chain.ghosts.has_all(k_tiles - 1);
      const bool all_done = std::count_if(order.begin(), order.begin() + n, [](std::int32_t t) {
                              return t < k_tiles - 1;
                            }) == k_tiles - 1;
      CHECK(is_complete == all_done);
      chain.publish(order[static_cast<std::size_t>(n)]);
    }
    const auto sums = chain.sums();
    if (first.empty()) first = sums;
    REQUIRE(sums == first);
  } while (std::next_permutation(order.begin(), order.end()));
  CHECK(std::any_of(first.begin(), first.end(), [](double f) { return f != 0.0; }));
}

TEST_CASE("a tile's ghosts shall be named once, and both sides of a pair shall have their rows") {
  Chain chain;
  const auto ghosts = chain.ghosts.ghosts(0);
  CHECK(ghosts.size() == static_cast<std::size_t>(k_tile * (k_tiles - 1)));
  CHECK(std::is_sorted(ghosts.begin(), ghosts.end()));
  CHECK(chain.ghosts.ghosts(k_tiles - 1).empty());
  for (const auto& p : chain.places[0]) {
    // One side is the tile's own, the other one of its ghosts behind them.
    CHECK(std::min(p.a, p.b) < k_tile);
    CHECK(std::max(p.a, p.b) >= k_tile);
  }
}

TEST_CASE("a force buffer shall be zero again after an exception") {
  const Tile tile = tile_of(0);
  try {
    ForceBuffer force(tile, 2);
    force.own()[3] = 1.0;
    force.ghosts()[5] = 2.0;
    throw std::runtime_error("a law has failed");
  } catch (const std::runtime_error&) {
  }
  ForceBuffer force(tile, 2);
  for (const double f : force.own()) CHECK(f == 0.0);
  for (const double f : force.ghosts()) CHECK(f == 0.0);
}

TEST_CASE("histories of a batch shall be at home again after an exception") {
  dust::contact::BatchColumns columns;
  std::vector<double> elsewhere(8);
  try {
    dust::contact::HistoryElsewhere history(columns);
    history.keep_at(elsewhere.data(), 2);
    CHECK(columns.history()[1] == elsewhere.data() + 2);
    throw std::runtime_error("a law has failed");
  } catch (const std::runtime_error&) {
  }
  CHECK(columns.history()[0] == columns.column(dust::contact::BatchColumns::first_history));
}

TEST_CASE("deferred forces shall be those of the particles that have not moved") {
  const Tile tile{0, 8, 12};
  DeferredForces deferred;
  deferred.restart(1);
  CHECK_FALSE(deferred.has_any());
  const std::vector<std::int32_t> active{11, 8, 10};
  ForceBuffer force(tile, 0);
  for (std::size_t n = 0; n < force.own().size(); ++n) force.own()[n] = static_cast<double>(n);
  deferred.keep(tile, active, 1, force);
  REQUIRE(deferred.has(0));
  const auto rows = deferred.rows(0);
  REQUIRE(rows.size() == 16);
  CHECK(rows[0] == 0.0);   // of row 8, the buffer's first
  CHECK(rows[8] == 16.0);  // of row 10
  // Taken out of the buffer; what moved, or was not active, is left to whoever moved it.
  CHECK(force.own()[1] == 0.0);
  CHECK(force.own()[16] == 0.0);
  CHECK(force.own()[9] == 9.0);
  CHECK(force.own()[25] == 25.0);
  std::fill(force.own().begin(), force.own().end(), 0.0);
  deferred.clear(0);
  CHECK_FALSE(deferred.has_any());
}
