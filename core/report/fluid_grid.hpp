// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/h5_source.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace dust::report {

/// Cells, or blocks of them, along x, y, z.
using Count = std::array<std::size_t, 3>;
inline std::size_t product(const Count& n) { return n[0] * n[1] * n[2]; }

/// The grid of the fluid's fields in results.h5.
struct FluidGrid {
  std::array<double, 3> origin{};   ///< [m]
  std::array<double, 3> spacing{};  ///< [m]
  Count count{};
};

/// Nothing where there is no fluid, or what stands there is no grid.
std::optional<FluidGrid> fluid_grid_of(const H5Source& source);

}  // namespace dust::report
