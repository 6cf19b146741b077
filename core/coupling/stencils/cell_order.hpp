// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace dust::coupling {

/// The order in which the coupling visits grains: by the eighth of a cell they lie in, then by row.
/// Those with the same faces around them come one after another. Nothing but speed and the order of
/// sums depends on it.
class CellOrder {
 public:
  /// `position`: 4 numbers per row.
  void sort(const fluid::Grid& grid, const double* position, std::size_t count);
  [[nodiscard]] std::span<const std::int32_t> rows() const { return rows_; }

 private:
  std::vector<std::uint64_t> items_, other_;  ///< eighth in the upper half, row in the lower one
  std::vector<std::int32_t> rows_;
};

}  // namespace dust::coupling
