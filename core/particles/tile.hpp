// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// Coarse particles [begin, end) that one task works through: a name for a part of the rows. What a
/// class keeps of a tile, it keeps by the tile's index.
struct Tile {
  std::int32_t index = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

}  // namespace dust::particles
