// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/multi_cell_kernel.hpp"

#include <algorithm>

namespace dust::coupling {
namespace {

/// D/dx above which a grain is spread over its cells. At 1 the eight faces are as wide as the
/// grain.
constexpr double k_small = 1.0 + 1e-9;

}  // namespace

MultiCellKernel::MultiCellKernel(const Lattice& lattice, const sdk::VoidageRule& rule)
    : lattice_(lattice), rule_(rule) {
  const sdk::Vec3 spacing = lattice.grid().spacing;
  largest_ = k_small * std::min({spacing.x, spacing.y, spacing.z});
}

void MultiCellKernel::set(const double* position, double radius) {
  const fluid::Grid& grid = lattice_.grid();
  const int capacity = rule_.capacity(grid.shape(), radius);
  for (auto* column : {&i_, &j_, &k_}) column->resize(static_cast<std::size_t>(capacity));
  weight_.resize(static_cast<std::size_t>(capacity));
  int used = 0;
  rule_.spread(grid.shape(), {1,
                              {position, position + 1, position + 2},
                              &radius,
                              capacity,
                              &used,
                              i_.data(),
                              j_.data(),
                              k_.data(),
                              weight_.data()});
  shares_.clear();
  double sum = 0.0;
  const auto add = [&](std::ptrdiff_t cell, double weight) {
    // Indices of the periodic image inside, so that faces can be counted from them.
    const std::array<int, 3> storage = lattice_.indices(cell);
    shares_.push_back({storage[0], storage[1], storage[2], cell, weight});
    sum += weight;
  };
  for (std::size_t n = 0; n < static_cast<std::size_t>(used); ++n) {
    const std::ptrdiff_t cell = lattice_.open_cell(i_[n], j_[n], k_[n]);
    if (cell >= 0 && weight_[n] > 0.0) add(cell, weight_[n]);
  }
  // Beyond a side that it has just left, or deep in a body.
  if (shares_.empty()) {
    add(lattice_.host_cell(lattice_.cell(lattice_.place(position)), position), 1.0);
  }
  for (Share& share : shares_) share.weight /= sum;
}

void MultiCellKernel::stencil(int d, const fluid::CellField& eps, MultiCellStencil& s) const {
  s.storage.clear();
  for (auto* column : {&s.weight, &s.void_fraction, &s.open}) column->clear();
  for (const Share& share : shares_) {
    for (const int side : {0, 1}) {
      const auto face = lattice_.face(d, share.i, share.j, share.k, side);
      s.storage.push_back(face.storage);
      s.weight.push_back(0.5 * share.weight);
      s.void_fraction.push_back(0.5 * (eps[face.below] + eps[face.above]));
      s.open.push_back(lattice_.open_share(d, face.storage));
    }
  }
}

double MultiCellKernel::mean(const fluid::CellField& field) const {
  double sum = 0.0;
  for (const Share& share : shares_) sum += share.weight * field[share.cell];
  return sum;
}

}  // namespace dust::coupling
