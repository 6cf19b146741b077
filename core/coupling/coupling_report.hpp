// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <cstdint>

namespace dust::coupling {

/// Limiters and checks, counted since the start; none of them is silent.
struct CouplingReport {
  std::int64_t moved_shares = 0;   ///< shares of grain volume given to a neighbour (body, side)
  std::int64_t limited_cells = 0;  ///< times a cell gave volume away at the smallest void fraction
  std::int64_t unplaced_grains =
      0;  ///< grains with no open cell in reach: their volume is not mapped
  std::int64_t unpaired_forces = 0;   ///< force components with no open face around the grain: the
                                      ///< bodies and sides carry them, not the fluid
  double smallest_void_fraction = 1;  ///< after mapping, since the start
  double largest_imbalance = 0.0;  ///< |impulse on grains + impulse on fluid| / scale, per exchange
  double largest_diameter_over_spacing = 0.0;
};

void save(const CouplingReport& report, sdk::ArchiveWriter& archive);
void load(CouplingReport& report, sdk::ArchiveReader& archive);

}  // namespace dust::coupling
