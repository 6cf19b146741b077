// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// Particles per task where nothing but their rows is touched.
inline constexpr std::size_t k_block = 512;

/// Coarse particles [begin, end) that one task works through: a name for a part of the rows. What a
/// class keeps of a tile, it keeps by the tile's index.
struct Tile {
  std::int32_t index = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// How the rows are shared out: coarse particles in tiles, the fine level behind them.
struct Tiling {
  std::size_t coarse_count = 0;
  std::size_t tile_size = 512;

  /// Large enough to keep a tile's data in the second-level cache and most pairs inside one tile,
  /// and some 16 tiles for the threads to share. A function of the number of particles alone, for
  /// it fixes the order of sums.
  [[nodiscard]] static Tiling of(std::size_t coarse_count) {
    return {coarse_count,
            std::clamp(std::bit_ceil(coarse_count / 16 + 1), std::size_t{512}, std::size_t{2048})};
  }
  [[nodiscard]] std::size_t count() const { return (coarse_count + tile_size - 1) / tile_size; }
  [[nodiscard]] Tile tile(std::size_t index) const {
    return {static_cast<std::int32_t>(index), static_cast<std::int32_t>(index * tile_size),
            static_cast<std::int32_t>(std::min(coarse_count, (index + 1) * tile_size))};
  }
  /// Of a coarse particle.
  [[nodiscard]] std::size_t tile_of(std::int32_t row) const {
    return static_cast<std::size_t>(row) / tile_size;
  }
  [[nodiscard]] bool is_coarse(std::int32_t row) const {
    return static_cast<std::size_t>(row) < coarse_count;
  }
};

}  // namespace dust::particles
