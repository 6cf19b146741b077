// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "contact/aligned.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/store/tile.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Forces on active particles that have not moved in this step yet, because somebody may still add
/// to them: another tile's contacts, or a stage of its own. Tile by tile; different tiles may be
/// handled at once.
class DeferredForces {
 public:
  void restart(std::size_t tiles) {
    tiles_.resize(tiles);
    for (OfTile& t : tiles_) t.force.clear();
  }
  /// Takes the forces on `active`, from the `moved`-th on, out of the buffer and leaves zeros.
  void keep(Tile tile, std::span<const std::int32_t> active, std::size_t moved, ForceBuffer& force);
  [[nodiscard]] bool has_any() const;
  [[nodiscard]] bool has(std::int32_t tile) const { return !at(tile).force.empty(); }
  /// So many active particles at the front have moved.
  [[nodiscard]] std::size_t moved(std::int32_t tile) const { return at(tile).moved; }
  /// Eight numbers for each of the others, in their order.
  [[nodiscard]] std::span<double> rows(std::int32_t tile) {
    return tiles_[static_cast<std::size_t>(tile)].force;
  }
  void clear(std::int32_t tile) { tiles_[static_cast<std::size_t>(tile)].force.clear(); }
  [[nodiscard]] std::uint64_t digest() const {
    base::Digest d;
    for (const OfTile& t : tiles_) d.add(t.force);
    return d.value();
  }

 private:
  struct OfTile {
    contact::AlignedVector<double> force;
    std::size_t moved = 0;
  };
  [[nodiscard]] const OfTile& at(std::int32_t tile) const {
    return tiles_[static_cast<std::size_t>(tile)];
  }
  std::vector<OfTile> tiles_;
};

}  // namespace dust::particles
