// SPDX-License-Identifier: Apache-2.0
#include "airborne/cells/covered_cells.hpp"

#include "fluid/geometry/wrapped.hpp"
#include "fluid/neighbour.hpp"

#include <array>
#include <cstddef>

namespace dust::airborne {

std::vector<std::int32_t> nearest_gas_cells(const fluid::Grid& grid,
                                            const fluid::CellField& volume) {
  struct Reached {
    std::array<int, 3> at;
    std::ptrdiff_t cell;
  };
  std::vector<std::int32_t> nearest(grid.size, -1);
  std::vector<Reached> reached;  // those with gas, then those one step from them, and so on
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::ptrdiff_t o = grid.index(i, j, k);
        if (!(volume[static_cast<std::size_t>(o)] > 0.0)) continue;
        nearest[static_cast<std::size_t>(o)] = static_cast<std::int32_t>(o);
        reached.push_back({{i, j, k}, o});
      }
    }
  }
  for (std::size_t n = 0; n < reached.size(); ++n) {
    const Reached from = reached[n];
    for (std::size_t d = 0; d < 3; ++d) {
      for (const int side : {-1, 1}) {
        const int axis = static_cast<int>(d);
        const std::ptrdiff_t q = fluid::neighbour(grid, from.cell, axis, from.at[d], side);
        if (q < 0 || nearest[static_cast<std::size_t>(q)] >= 0) continue;
        nearest[static_cast<std::size_t>(q)] = nearest[static_cast<std::size_t>(from.cell)];
        Reached next{from.at, q};
        next.at[d] = fluid::wrapped(from.at[d] + side, grid.count[d]);
        reached.push_back(next);
      }
    }
  }
  return nearest;
}

}  // namespace dust::airborne
