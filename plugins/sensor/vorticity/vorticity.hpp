// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/fluid_cells.hpp"
#include "dust/sdk/vec3.hpp"

namespace dust::model::vorticity {

/// Curl of the velocity [1/s] in cell (i, j, k) by differences of the centres around, one-sided at
/// sides and next to solid cells; 0 along directions with one cell.
inline sdk::Vec3 curl(const sdk::FluidColumns& f, const sdk::FluidCells& cells, int i, int j,
                      int k) {
  const std::span<const float> u[3] = {f.velocity_x, f.velocity_y, f.velocity_z};
  const auto slope = [&](int of, int along) {
    int low[3] = {i, j, k};
    int high[3] = {i, j, k};
    int steps = 0;
    if (low[along] > 0) {
      --low[along];
      if (cells.is_open(cells.index(low[0], low[1], low[2]))) {
        ++steps;
      } else {
        ++low[along];
      }
    }
    if (high[along] + 1 < f.count[along]) {
      ++high[along];
      if (cells.is_open(cells.index(high[0], high[1], high[2]))) {
        ++steps;
      } else {
        --high[along];
      }
    }
    if (steps == 0) return 0.0;
    return (static_cast<double>(u[of][cells.index(high[0], high[1], high[2])]) -
            static_cast<double>(u[of][cells.index(low[0], low[1], low[2])])) /
           (steps * f.spacing[along]);
  };
  return {slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1)};
}

}  // namespace dust::model::vorticity
