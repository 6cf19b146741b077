// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace dust::particles {

/// Row n of `width` numbers becomes what row order[n] was; rows not named are dropped.
template <class Vector>
void reorder_rows(Vector& rows, std::span<const std::int32_t> order, std::size_t width) {
  Vector sorted(order.size() * width);
  for (std::size_t n = 0; n < order.size(); ++n) {
    std::memcpy(sorted.data() + n * width, rows.data() + static_cast<std::size_t>(order[n]) * width,
                width * sizeof(sorted[0]));
  }
  rows.swap(sorted);
}

}  // namespace dust::particles
