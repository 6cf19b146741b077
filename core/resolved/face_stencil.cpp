// SPDX-License-Identifier: Apache-2.0
#include "resolved/face_stencil.hpp"

#include <algorithm>

namespace dust::resolved {

bool is_in_domain(const fluid::Grid& grid, sdk::Vec3 place) {
  for (int d = 0; d < 3; ++d) {
    if (grid.is_periodic[static_cast<std::size_t>(d)]) continue;
    const double from_low = place[d] - grid.origin[d];
    if (from_low < 0.0 || from_low > grid.count[d] * grid.spacing[d]) return false;
  }
  return true;
}

FaceStencil stencil_at(const fluid::Grid& grid, int d, sdk::Vec3 place) {
  FaceStencil stencil;
  for (int e = 0; e < 3; ++e) {
    stencil[static_cast<std::size_t>(e)] = RomaPoints::around(face_place(grid, d, e, place[e]));
  }
  return stencil;
}

std::ptrdiff_t FacePlaces::along(int e, int index) const {
  const int count = grid_->count[static_cast<std::size_t>(e)];
  if (grid_->is_periodic[static_cast<std::size_t>(e)]) {
    index = (index % count + count) % count;
  } else {
    index = std::clamp(index, -1, d_ == e ? count + 1 : count);
  }
  return index * grid_->stride[static_cast<std::size_t>(e)];
}

double FacePlaces::mean(const FaceStencil& stencil, const double* values) const {
  std::array<std::array<std::ptrdiff_t, 3>, 3> at{};
  for (std::size_t e = 0; e < 3; ++e) {
    for (int n = 0; n < 3; ++n) {
      at[e][static_cast<std::size_t>(n)] = along(static_cast<int>(e), stencil[e].first + n);
    }
  }
  const double* origin = values + grid_->index(0, 0, 0);
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double* row = origin + at[1][j] + at[2][k];
      double of_row = 0.0;
      for (std::size_t i = 0; i < 3; ++i) of_row += stencil[0].weight[i] * row[at[0][i]];
      sum += stencil[1].weight[j] * stencil[2].weight[k] * of_row;
    }
  }
  return sum;
}

void FacePatch::clear(std::span<const FaceStencil> stencils) {
  std::array<int, 3> high{};
  for (std::size_t e = 0; e < 3; ++e) {
    low_[e] = high[e] = stencils.front()[e].first;
    for (const FaceStencil& s : stencils) {
      low_[e] = std::min(low_[e], s[e].first);
      high[e] = std::max(high[e], s[e].first);
    }
    count_[e] = high[e] - low_[e] + 3;
  }
  values_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], 0.0);
}

void FacePatch::add(const FaceStencil& stencil, double amount) {
  const int i = stencil[0].first - low_[0];
  const int j = stencil[1].first - low_[1];
  const int k = stencil[2].first - low_[2];
  for (int c = 0; c < 3; ++c) {
    for (int b = 0; b < 3; ++b) {
      const double of_row = amount * stencil[1].weight[static_cast<std::size_t>(b)] *
                            stencil[2].weight[static_cast<std::size_t>(c)];
      double* row =
          &values_[(static_cast<std::size_t>(k + c) * count_[1] + static_cast<std::size_t>(j + b)) *
                       static_cast<std::size_t>(count_[0]) +
                   static_cast<std::size_t>(i)];
      for (std::size_t a = 0; a < 3; ++a) row[a] += of_row * stencil[0].weight[a];
    }
  }
}

}  // namespace dust::resolved
