// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/face_void_fraction.hpp"

#include <tbb/parallel_for.h>

namespace dust::coupling {

FaceVoidFraction::FaceVoidFraction(const Lattice& lattice) : lattice_(lattice) {
  for (auto& value : value_) value.assign(lattice.grid().size, 1.0);
}

void FaceVoidFraction::update(const fluid::CellField& eps,
                              const std::vector<std::ptrdiff_t>& active) {
  tbb::parallel_for(0, 3, [&](int d) {
    for (const std::ptrdiff_t storage : is_not_one_[d]) value_[d][storage] = 1.0;
    is_not_one_[d].clear();
    for (const std::ptrdiff_t cell : active) set_faces(d, lattice_.indices(cell), eps);
  });
}

/// The faces of component d of one cell, and their images in the halo beside the domain, where
/// grains near a side look.
void FaceVoidFraction::set_faces(int d, std::array<int, 3> cell, const fluid::CellField& eps) {
  const fluid::Grid& grid = lattice_.grid();
  const std::size_t a = static_cast<std::size_t>(d);
  const std::size_t e = (a + 1) % 3;
  const std::size_t f = (a + 2) % 3;
  const auto first = [&](std::size_t axis) {
    return !grid.is_periodic[axis] && cell[axis] == 0 ? -1 : cell[axis];
  };
  const auto last = [&](std::size_t axis) {
    return !grid.is_periodic[axis] && cell[axis] + 1 == grid.count[axis] ? cell[axis] + 1
                                                                         : cell[axis];
  };
  for (const int side : {0, 1}) {
    std::array<int, 3> at = cell;
    at[a] += side;
    const std::ptrdiff_t above = lattice_.cell(at[0], at[1], at[2]);
    // A face between two active cells is written by the upper one.
    const bool has_above = side == 1 && (grid.is_periodic[a] || at[a] < grid.count[a]);
    if (has_above && eps[above] != 1.0) continue;
    const std::ptrdiff_t below =
        lattice_.cell(at[0] - (d == 0), at[1] - (d == 1), at[2] - (d == 2));
    const double mean = 0.5 * (eps[below] + eps[above]);
    for (at[e] = first(e); at[e] <= last(e); ++at[e]) {
      for (at[f] = first(f); at[f] <= last(f); ++at[f]) {
        const std::ptrdiff_t storage = lattice_.storage(at[0], at[1], at[2]);
        value_[a][storage] = mean;
        is_not_one_[a].push_back(storage);
      }
    }
  }
}

}  // namespace dust::coupling
