// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/ghost_exchange.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>

namespace dust::particles {

void GhostExchange::restart(std::size_t tiles, std::size_t tile_size, std::size_t particles) {
  tiles_.resize(tiles);
  tile_size_ = std::max<std::size_t>(tile_size, 1);
  particles_ = particles;
}

void GhostExchange::find_ghosts(Tile tile, std::span<const std::int32_t> a,
                                std::span<const std::int32_t> b,
                                std::vector<contact::Places>& places) {
  auto& rows = tiles_[static_cast<std::size_t>(tile.index)].ghosts;
  rows.clear();
  for (std::size_t q = 0; q < a.size(); ++q) {
    const std::int32_t row = std::max(a[q], b[q]);
    if (row >= tile.end) rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  thread_local std::vector<std::int32_t> place;  // by row, from the tile's first on
  place.resize(particles_ - static_cast<std::size_t>(tile.begin));
  const std::int32_t size = tile.end - tile.begin;
  std::iota(place.begin(), place.begin() + size, 0);
  for (std::size_t g = 0; g < rows.size(); ++g) {
    place[static_cast<std::size_t>(rows[g] - tile.begin)] = size + static_cast<std::int32_t>(g);
  }
  const auto place_of = [&](std::int32_t row) {
    return place[static_cast<std::size_t>(row - tile.begin)];
  };
  places.resize(a.size());
  for (std::size_t q = 0; q < a.size(); ++q) places[q] = {place_of(a[q]), place_of(b[q])};
}

void GhostExchange::plan() {
  for (TileGhosts& t : tiles_) t.contributions.clear();
  published_.assign(tiles_.size(), 0);
  step_ = 0;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const auto& rows = tiles_[t].ghosts;
    for (std::size_t g = 0; g < rows.size(); ++g) {
      tiles_[static_cast<std::size_t>(rows[g]) / tile_size_].contributions.push_back(
          {rows[g], static_cast<std::int32_t>(t), static_cast<std::int32_t>(g)});
    }
  }
  oneapi::tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
    auto& contributions = tiles_[t].contributions;
    std::stable_sort(contributions.begin(), contributions.end(),
                     [](const Contribution& x, const Contribution& y) { return x.row < y.row; });
    auto& contributors = tiles_[t].contributors;
    contributors.clear();
    for (const Contribution& c : contributions) contributors.push_back(c.tile);
    std::sort(contributors.begin(), contributors.end());
    contributors.erase(std::unique(contributors.begin(), contributors.end()), contributors.end());
  });
}

void GhostExchange::publish(std::int32_t tile, std::span<double> force) {
  const auto t = static_cast<std::size_t>(tile);
  tiles_[t].force.assign(force.begin(), force.end());
  std::fill(force.begin(), force.end(), 0.0);
  std::atomic_ref(published_[t]).store(step_, std::memory_order_release);
}

bool GhostExchange::has_all(std::int32_t tile) const {
  const auto& contributors = tiles_[static_cast<std::size_t>(tile)].contributors;
  return std::all_of(contributors.begin(), contributors.end(), [&](std::int32_t from) {
    return std::atomic_ref(published_[static_cast<std::size_t>(from)])
               .load(std::memory_order_acquire) == step_;
  });
}

}  // namespace dust::particles
