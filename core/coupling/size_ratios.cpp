// SPDX-License-Identifier: Apache-2.0
#include "coupling/size_ratios.hpp"

namespace dust::coupling {

std::size_t SizeRatios::cell_of(const double* position) const {
  return static_cast<std::size_t>(
      lattice_.host_cell(lattice_.cell(lattice_.place(position)), position));
}

void SizeRatios::find(const particles::GrainRows& grains, const CoarseGraining& graining,
                      ParticleStates& states) {
  sums_.assign(lattice_.grid().size, {0.0, 0.0});
  for (std::size_t row = 0; row < grains.count; ++row) {
    const double diameter = grains.diameter(row);
    std::array<double, 2>& sums = sums_[cell_of(grains.position_of(row))];
    sums[0] += grains.weight[row] * diameter * diameter * diameter;
    sums[1] += grains.weight[row] * diameter * diameter * graining.of(grains, row);
  }
  for (std::size_t row = 0; row < grains.count; ++row) {
    const std::array<double, 2>& sums = sums_[cell_of(grains.position_of(row))];
    states[row].size_ratio = grains.diameter(row) / graining.of(grains, row) * sums[1] / sums[0];
  }
}

}  // namespace dust::coupling
