// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

namespace dust::sdk {

/// A grid of cells, counted from 0, x fastest; the number of a cell is
/// i + count_x (j + count_y k).
struct GridShape {
  Vec3 origin;               ///< [m] lower corner
  Vec3 spacing;              ///< [m]
  int count[3] = {1, 1, 1};  ///< cells per direction
};

}  // namespace dust::sdk
