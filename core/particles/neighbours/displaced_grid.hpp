// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/cells.hpp"
#include "contact/batch_kernels.hpp"
#include "particles/neighbours/search.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Displaced particles by the cells that their surroundings overlap, in a hash table: another
/// particle looks into one cell. Cells of hashes that collide are one; what is near is found by
/// distances.
class DisplacedGrid {
 public:
  /// `around`: how far the others reach at most [m].
  DisplacedGrid(std::span<const Ball> displaced, double around, const contact::Images& images);

  /// Numbers of displaced particles that may be near a place, in their order.
  [[nodiscard]] std::span<const std::int32_t> at(const Ball& b) const {
    const std::uint32_t s = slot(cell(b.x, 0), cell(b.y, 1), cell(b.z, 2));
    const auto first = static_cast<std::size_t>(begin_[s]);
    return std::span(numbers_).subspan(first, static_cast<std::size_t>(begin_[s + 1]) - first);
  }

 private:
  [[nodiscard]] std::int64_t cell(double x, int d) const {
    return base::cell_index(x * inverse_[d]);
  }
  [[nodiscard]] std::uint32_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::uint64_t key =
        base::cell_key(base::wrapped_cell(x, count_[0]), base::wrapped_cell(y, count_[1]),
                       base::wrapped_cell(z, count_[2]));
    return static_cast<std::uint32_t>(base::spread_key(key) >> shift_);
  }

  double inverse_[3];
  std::int64_t count_[3] = {0, 0, 0};  ///< of cells along a periodic side, else 0
  int shift_ = 0;
  std::vector<std::int32_t> begin_;
  std::vector<std::int32_t> numbers_;
};

}  // namespace dust::particles
