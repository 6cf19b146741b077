// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/store/tile.hpp"

#include <cstddef>
#include <span>

namespace dust::particles {

/// Numbers per particle in rows of forces: force [N] and torque [N m], each with a fourth.
inline constexpr std::size_t k_force_row = 8;
/// The fourth numbers: where dust or an account asks for it, what contacts dissipate at the
/// particle [J], until TileStep::take_work(); they are zero where particles move.
inline constexpr std::size_t k_normal_work = 3;
inline constexpr std::size_t k_tangential_work = 7;

/// Forces on a tile's particles and, behind them, on its ghosts, while the tile is evaluated: in
/// memory of the calling thread, so that they stay in its cache. All zero at first. Whoever takes a
/// force out leaves zeros, while it is near; where an exception prevented that, the end of the
/// buffer does it, lest the next solver of this thread finds them.
class ForceBuffer {
 public:
  ForceBuffer(Tile tile, std::size_t ghosts);
  ~ForceBuffer();
  ForceBuffer(const ForceBuffer&) = delete;
  ForceBuffer& operator=(const ForceBuffer&) = delete;

  /// Rows of k_force_row numbers: the tile's particles, then its ghosts.
  [[nodiscard]] double* rows() { return rows_.data(); }
  [[nodiscard]] std::span<double> own() { return rows_.first(own_); }
  [[nodiscard]] std::span<double> ghosts() { return rows_.subspan(own_); }

 private:
  std::span<double> rows_;
  std::size_t own_;
  int exceptions_;  ///< under way when it was made
};

}  // namespace dust::particles
