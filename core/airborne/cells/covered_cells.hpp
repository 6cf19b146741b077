// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"

#include <cstdint>
#include <vector>

namespace dust::airborne {

/// By cell, the nearest one with gas, in steps from cell to cell, through bodies and periodic
/// sides; itself where it has gas. `volume` [-] of gas in each cell. -1: in the halo, or there is
/// no gas anywhere.
[[nodiscard]] std::vector<std::int32_t> nearest_gas_cells(const fluid::Grid& grid,
                                                          const fluid::CellField& volume);

}  // namespace dust::airborne
