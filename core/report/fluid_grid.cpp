// SPDX-License-Identifier: Apache-2.0
#include "report/fluid_grid.hpp"

namespace dust::report {

std::optional<FluidGrid> fluid_grid_of(const H5Source& source) {
  const auto origin = source.attribute("/fluid", "origin");
  const auto spacing = source.attribute("/fluid", "spacing");
  const auto count = source.attribute("/fluid", "count");
  if (origin.size() != 3 || spacing.size() != 3 || count.size() != 3) return std::nullopt;
  FluidGrid grid;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(count[d] >= 1.0 && count[d] < 1e6 && spacing[d] > 0.0)) return std::nullopt;
    grid.origin[d] = origin[d];
    grid.spacing[d] = spacing[d];
    grid.count[d] = static_cast<std::size_t>(count[d]);
  }
  return grid;
}

}  // namespace dust::report
