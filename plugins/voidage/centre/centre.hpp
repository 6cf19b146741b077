// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::centre {

/// Number of the cell that holds `position` [m] on an axis of cells of `spacing` [m] from `origin`.
inline int cell_of(double position, double origin, double spacing) {
  return static_cast<int>(std::floor((position - origin) / spacing));
}

}  // namespace dust::model::centre
