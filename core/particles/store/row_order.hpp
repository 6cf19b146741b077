// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dust::particles {

/// An order of rows: row n is to become what row order[n] was.
struct RowOrder {
  std::vector<std::int32_t> order;
  std::size_t coarse_count = 0;  ///< of them, at the front
};

/// Coarse particles first, from `coarse_limit` [m] of diameter on, then fine ones, each in Morton
/// order of cells of the given edge [m] from `origin` on: what is near in space is near in memory.
/// `position`: rows x, y, z, radius.
RowOrder morton_order(const double* position, std::size_t count, sdk::Vec3 origin, double edge,
                      double coarse_limit);

}  // namespace dust::particles
