// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/flow.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace dust::airborne {

/// Cells that bodies cut to slivers, each with the neighbour it is most open to: the two are one
/// volume to dust, which would else cross a sliver many times in a step. Slivers whose neighbours
/// are slivers, too, join up until they are none together: a slot is several volumes along it.
class SmallCells {
 public:
  /// Cells filled by gas to less than this share are slivers.
  static constexpr double k_small_share = 0.3;

  void find(const fluid::Grid& grid, const Flow& flow);
  /// Spreads what the members of a group hold evenly over the volume of the group. `mass` [kg/m3]
  /// of whole cells, `volume` [-].
  void mix(fluid::CellField& mass, const fluid::CellField& volume) const;
  /// Replaces the rates [1/s, per whole cell] at which volume leaves the members of a group by that
  /// of the whole group; its inner faces count.
  void join_rates(fluid::CellField& outflow, fluid::CellField& volume) const;
  [[nodiscard]] std::size_t groups() const { return begin_.empty() ? 0 : begin_.size() - 1; }

 private:
  [[nodiscard]] double sum(const fluid::CellField& field, std::size_t group) const;

  std::vector<std::int32_t> cell_;   ///< members, group by group, the host first
  std::vector<std::int32_t> begin_;  ///< of each group in `cell_`, and the end
};

}  // namespace dust::airborne
