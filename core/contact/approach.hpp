// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::contact {

/// Grains on straight courses, each to be found within its allowance of it.
struct Courses {
  const double* position = nullptr;   ///< rows: x, y, z, radius
  const double* velocity = nullptr;   ///< rows
  const double* allowance = nullptr;  ///< [m] one per grain
};

/// Whether grains a[q] and b[q] may come closer than touch + `range` [m] within `horizon` [s]: 1 or
/// 0 for each of `count` pairs.
void mark_approaching(const Courses& courses, const Images& images, double range, double horizon,
                      const std::int32_t* a, const std::int32_t* b, std::size_t count,
                      std::uint8_t* is_approaching);

}  // namespace dust::contact
