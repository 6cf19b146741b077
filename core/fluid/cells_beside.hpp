// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"

#include <cstddef>

namespace dust::fluid {

/// Where the cells below and above a face stand, from the number of the face on. Beyond a side that
/// is the cell before it again, or that of the other end where the grid is periodic.
struct CellsBeside {
  std::ptrdiff_t below = 0;
  std::ptrdiff_t above = 0;
};

/// Of the face across d that `along` faces of its row come before.
inline CellsBeside cells_beside(const Grid& grid, std::size_t d, int along) {
  const std::ptrdiff_t step = grid.stride[d];
  const std::ptrdiff_t round = grid.is_periodic[d] ? step * grid.count[d] : step;
  return {along == 0 ? round - step : -step, along == grid.count[d] ? -round : 0};
}

}  // namespace dust::fluid
