// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "contact/aligned.hpp"
#include "contact/batch_kernels.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/store/tile.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Forces of pairs between two tiles. The earlier tile evaluates the pair; the other's particle is
/// its ghost, and the force on it is gathered beside those on the tile's own. A tile that is done
/// publishes the forces on its ghosts. Their owners add them in the order of the tiles, in whatever
/// order they arrive: the sums are the same on any number of threads.
class GhostExchange {
 public:
  /// Forgets all ghosts: so many tiles, the first `particles` rows in tiles of `tile_size` each.
  void restart(std::size_t tiles, std::size_t tile_size, std::size_t particles);

  /// Finds the ghosts of a tile: particles of later tiles that its pairs (a, b) name. Writes where
  /// each pair's forces are gathered: rows of a ForceBuffer. Different tiles may do so at once.
  void find_ghosts(Tile tile, std::span<const std::int32_t> a, std::span<const std::int32_t> b,
                   std::vector<contact::Places>& places);
  /// Rows of a tile's ghosts, ascending, each once.
  [[nodiscard]] std::span<const std::int32_t> ghosts(std::int32_t tile) const {
    return tiles_[static_cast<std::size_t>(tile)].ghosts;
  }
  /// After find_ghosts for all tiles: notes with every owner where forces on its particles come
  /// from.
  void plan();

  /// Begins a new step: nothing has been published in it.
  void begin_step() { ++step_; }
  /// Takes the forces on a tile's ghosts out of `force` and leaves zeros.
  void publish(std::int32_t tile, std::span<double> force);
  /// Whether all tiles that contribute to this one have published. One thread that takes the tiles
  /// in order finds it always so.
  [[nodiscard]] bool has_all(std::int32_t tile) const;

  /// Calls `add`(row, force) for each force on a tile's particle from outside, by row, then by
  /// tile: k_force_row numbers.
  template <class Add>
  void for_each_contribution(std::int32_t tile, Add&& add) const {
    for (const Contribution& c : tiles_[static_cast<std::size_t>(tile)].contributions) {
      add(c.row, tiles_[static_cast<std::size_t>(c.tile)].force.data() +
                     k_force_row * static_cast<std::size_t>(c.ghost));
    }
  }

  /// Of the forces published.
  [[nodiscard]] std::uint64_t digest() const {
    base::Digest d;
    for (const TileGhosts& t : tiles_) d.add(t.force);
    return d.value();
  }

 private:
  struct Contribution {
    std::int32_t row = 0;
    std::int32_t tile = 0;   ///< that evaluates it
    std::int32_t ghost = 0;  ///< its number among that tile's ghosts
  };
  struct TileGhosts {
    std::vector<std::int32_t> ghosts;
    contact::AlignedVector<double> force;  ///< eight numbers for each of them
    std::vector<Contribution> contributions;
    std::vector<std::int32_t> contributors;  ///< tiles, each once
  };

  std::vector<TileGhosts> tiles_;
  /// By tile: the last step whose forces are there. Read while others are written.
  mutable std::vector<std::int64_t> published_;
  std::int64_t step_ = 0;
  std::size_t tile_size_ = 1;
  std::size_t particles_ = 0;
};

}  // namespace dust::particles
