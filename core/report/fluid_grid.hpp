// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/h5_source.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace dust::report {

/// The grid of the fluid's fields in results.h5.
struct FluidGrid {
  std::array<double, 3> origin{};   ///< [m]
  std::array<double, 3> spacing{};  ///< [m]
  std::array<std::size_t, 3> count{};
};

/// Nothing where there is no fluid, or what stands there is no grid.
std::optional<FluidGrid> fluid_grid_of(const H5Source& source);

}  // namespace dust::report
