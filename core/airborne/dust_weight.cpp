// SPDX-License-Identifier: Apache-2.0
#include "airborne/dust_weight.hpp"

#include "fluid/parallel.hpp"

#include <algorithm>
#include <array>

namespace dust::airborne {

DustWeight::DustWeight(const fluid::Grid& grid, sdk::Vec3 gravity, double dust_density,
                       double gas_density)
    : grid_(grid),
      immersed_gravity_((1.0 - gas_density / dust_density) * gravity),
      mass_(grid.size, 0.0),
      force_(grid) {}

const fluid::FaceField& DustWeight::find(const DustField& field, const fluid::CellField& volume) {
  const auto& n = grid_.count;
  std::fill(mass_.begin(), mass_.end(), 0.0);
  for (std::size_t c = 0; c < field.classes(); ++c) {
    const fluid::CellField& of_class = field.mass(c);
    fluid::for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) mass_[o + i] += of_class[o + i];
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
        const std::ptrdiff_t below = along == 0 ? face - s + round : face - s;
        const std::ptrdiff_t above = along == last ? face - round : face;
        const double gas = volume[below] + volume[above];
        force_.component[static_cast<std::size_t>(d)][face] =
            gas > 0.0 ? immersed_gravity_[d] * (mass_[below] + mass_[above]) / gas : 0.0;
      }
    });
  }
  return force_;
}

}  // namespace dust::airborne
