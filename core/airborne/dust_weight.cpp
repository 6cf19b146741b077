// SPDX-License-Identifier: Apache-2.0
#include "airborne/dust_weight.hpp"

#include "fluid/parallel.hpp"

#include <algorithm>

namespace dust::airborne {

DustWeight::DustWeight(const fluid::Grid& grid, sdk::Vec3 gravity, double dust_density,
                       double gas_density)
    : grid_(grid),
      immersed_gravity_((1.0 - gas_density / dust_density) * gravity),
      sum_(grid.size, 0.0),
      one_(grid.size, 0.0),
      force_(grid) {}

const fluid::FaceField& DustWeight::find(const DustField& field, const fluid::CellField& volume) {
  const auto& n = grid_.count;
  std::fill(sum_.begin(), sum_.end(), 0.0);
  for (std::size_t c = 0; c < field.classes(); ++c) {
    field.concentration(c, volume, one_);
    fluid::for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) sum_[o + i] += one_[o + i];
    });
  }
  for (int d = 0; d < 3; ++d) {
    if (immersed_gravity_[d] == 0.0) continue;
    std::array<int, 3> faces = n;
    faces[static_cast<std::size_t>(d)] += 1;
    const std::ptrdiff_t s = grid_.stride[static_cast<std::size_t>(d)];
    const bool is_periodic = grid_.is_periodic[static_cast<std::size_t>(d)];
    const int last = n[static_cast<std::size_t>(d)];
    fluid::for_rows(faces[0], faces[1], faces[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < faces[0]; ++i) {
        const int along = d == 0 ? i : d == 1 ? j : k;
        const std::ptrdiff_t face = o + i;
        // Beyond a side there is what the cell before it holds, or the other end.
        const std::ptrdiff_t round = is_periodic ? last * s : s;
        const double below = sum_[along == 0 ? face - s + round : face - s];
        const double above = sum_[along == last ? face - round : face];
        force_.component[static_cast<std::size_t>(d)][face] =
            immersed_gravity_[d] * 0.5 * (below + above);
      }
    });
  }
  return force_;
}

}  // namespace dust::airborne
