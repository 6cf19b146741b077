// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/wrapped.hpp"
#include "fluid/grid.hpp"

#include <cstddef>

namespace dust::fluid {

/// Padded index of the next cell along d to the `side` (-1 or 1) of cell o, whose index along d is
/// `c`, through periodic sides; -1 where there is none.
[[nodiscard]] inline std::ptrdiff_t neighbour(const Grid& grid, std::ptrdiff_t o, int d, int c,
                                              int side) {
  const int n = grid.count[d];
  const int to = grid.is_periodic[d] && n > 1 ? wrapped(c + side, n) : c + side;
  if (to < 0 || to >= n) return -1;
  return o + (to - c) * grid.stride[d];
}

}  // namespace dust::fluid
