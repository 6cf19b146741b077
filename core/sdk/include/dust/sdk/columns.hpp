// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstddef>

namespace dust::sdk {

/// A vector per row of a batch, as three columns. Kernels read the columns (`normal.x[q]`), others
/// take the vector of a row (`normal[q]`).
struct VectorColumns {
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;

  [[nodiscard]] Vec3 operator[](std::size_t row) const { return {x[row], y[row], z[row]}; }
  /// The same columns without their first rows.
  [[nodiscard]] VectorColumns from(std::size_t first) const {
    return {x + first, y + first, z + first};
  }
};

/// The same to write into.
struct MutableVectorColumns {
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;

  void set(std::size_t row, Vec3 v) const {
    x[row] = v.x;
    y[row] = v.y;
    z[row] = v.z;
  }
};

}  // namespace dust::sdk
