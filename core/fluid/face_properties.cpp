// SPDX-License-Identifier: Apache-2.0
#include "fluid/face_properties.hpp"

#include <algorithm>

namespace dust::fluid {

FaceProperties::FaceProperties(const Grid& grid, const scenario::FluidSpec& fluid)
    : grid_(grid),
      properties_(fluid),
      set_(momentum_set_of(fluid.momentum_set)),
      is_varying_(set_ == MomentumSet::three || !properties_.is_uniform()),
      largest_(fluid.viscosity / fluid.density) {
  if (!is_varying_) return;
  density_ = FaceField(grid);
  viscosity_ = FaceField(grid);
  const auto at_cell = [&](std::array<int, 3> c) {
    for (int d = 0; d < 3; ++d) {
      const int n = grid.count[d];
      c[d] = grid.is_periodic[d] ? ((c[d] % n) + n) % n : std::clamp(c[d], 0, n - 1);
    }
    return properties_.at(grid.centre(c[0], c[1], c[2]));
  };
  // Halos included: kernels run over the face beyond the last cell.
  for (int d = 0; d < 3; ++d) {
    for (int k = -Grid::k_halo; k < grid.count[2] + Grid::k_halo; ++k) {
      for (int j = -Grid::k_halo; j < grid.count[1] + Grid::k_halo; ++j) {
        for (int i = -Grid::k_margin; i < grid.count[0] + Grid::k_margin; ++i) {
          const auto upper = at_cell({i, j, k});
          const auto lower = at_cell({i - (d == 0), j - (d == 1), k - (d == 2)});
          const std::ptrdiff_t o = grid.index(i, j, k);
          density_.component[d][o] = 0.5 * (lower.density + upper.density);
          viscosity_.component[d][o] = 0.5 * (lower.viscosity + upper.viscosity);
        }
      }
    }
  }
  inverse_inertia_ = FaceField(grid);
  set_void_fraction(CellField(grid.size, 1.0));
}

void FaceProperties::set_void_fraction(const CellField& eps) {
  if (!is_varying_) return;
  const bool is_set_three = set_ == MomentumSet::three;
  largest_ = 0.0;
  for (int d = 0; d < 3; ++d) {
    const std::ptrdiff_t s = grid_.stride[d];
    const auto& rho = density_.component[d];
    const auto& mu = viscosity_.component[d];
    auto& inverse = inverse_inertia_.component[d];
    for (std::ptrdiff_t o = s; o < static_cast<std::ptrdiff_t>(grid_.size); ++o) {
      if (rho[o] == 0.0) continue;  // padding of the rows
      inverse[o] = 1.0 / (is_set_three ? rho[o] * 0.5 * (eps[o] + eps[o - s]) : rho[o]);
      largest_ = std::max(largest_, mu[o] * inverse[o]);
    }
  }
}

}  // namespace dust::fluid
