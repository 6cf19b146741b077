// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/deferred_forces.hpp"

#include <algorithm>

namespace dust::particles {

void DeferredForces::keep(Tile tile, std::span<const std::int32_t> active, std::size_t moved,
                          ForceBuffer& force) {
  OfTile& kept = tiles_[static_cast<std::size_t>(tile.index)];
  kept.moved = moved;
  kept.force.resize(k_force_row * (active.size() - moved));
  double* to = kept.force.data();
  for (const std::int32_t row : active.subspan(moved)) {
    double* waiting = force.rows() + k_force_row * static_cast<std::size_t>(row - tile.begin);
    to = std::copy_n(waiting, k_force_row, to);
    std::fill_n(waiting, k_force_row, 0.0);
  }
}

bool DeferredForces::has_any() const {
  return std::any_of(tiles_.begin(), tiles_.end(),
                     [](const OfTile& t) { return !t.force.empty(); });
}

}  // namespace dust::particles
