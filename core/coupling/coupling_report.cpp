// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_report.hpp"

#include <array>
#include <vector>

namespace dust::coupling {

void save(const CouplingReport& r, sdk::ArchiveWriter& archive) {
  archive.integers(
      "counts", std::array{r.moved_shares, r.limited_cells, r.unplaced_grains, r.unpaired_forces});
  archive.numbers("extremes", std::array{r.smallest_void_fraction, r.largest_imbalance,
                                         r.largest_diameter_over_spacing});
}

void load(CouplingReport& r, sdk::ArchiveReader& archive) {
  const std::vector<std::int64_t> counts = archive.integers("counts");
  const std::vector<double> extremes = archive.numbers("extremes");
  r.moved_shares = counts.at(0);
  r.limited_cells = counts.at(1);
  r.unplaced_grains = counts.at(2);
  r.unpaired_forces = counts.at(3);
  r.smallest_void_fraction = extremes.at(0);
  r.largest_imbalance = extremes.at(1);
  r.largest_diameter_over_spacing = extremes.at(2);
}

}  // namespace dust::coupling
