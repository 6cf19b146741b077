// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "resolved/roma_kernel.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dust::resolved {

/// The faces of one component around a marker.
using FaceStencil = std::array<RomaPoints, 3>;

/// [cells] Where `place` stands among the faces of component `d`, along `e`.
[[nodiscard]] inline double face_place(const fluid::Grid& grid, int d, int e, double place) {
  return (place - grid.origin[e]) / grid.spacing[e] - (d == e ? 0.0 : 0.5);
}
/// Or beyond a periodic side, which leads round.
[[nodiscard]] bool is_in_domain(const fluid::Grid& grid, sdk::Vec3 place);
[[nodiscard]] FaceStencil stencil_at(const fluid::Grid& grid, int d, sdk::Vec3 place);

/// Where faces of one component stand in a padded array: periodic sides lead round, beyond others
/// the halo is the last.
class FacePlaces {
 public:
  FacePlaces(const fluid::Grid& grid, int d) : grid_(&grid), d_(d) {}
  /// The place along `e`, in numbers of the array.
  [[nodiscard]] std::ptrdiff_t along(int e, int index) const;
  /// Whether face `index` along `e` is one of the domain, `extent` of which there are.
  [[nodiscard]] bool is_inside(int e, int index, int extent) const {
    return grid_->is_periodic[static_cast<std::size_t>(e)] || (index >= 0 && index < extent);
  }

  /// The velocity that a marker sees.
  [[nodiscard]] double mean(const FaceStencil& stencil, const double* values) const;

 private:
  const fluid::Grid* grid_;
  int d_;
};

/// Numbers at the faces of one component around a sphere, not yet wrapped: what its markers give
/// them, added up in the order of the markers.
class FacePatch {
 public:
  /// Zero at all faces that the stencils reach.
  void clear(std::span<const FaceStencil> stencils);
  void add(const FaceStencil& stencil, double amount);
  /// Calls visit(padded index, number) for faces that fluid may be driven through, in their order.
  template <class Visit>
  void each(const fluid::Grid& grid, const fluid::Geometry& geometry, int d,
            const Visit& visit) const;

 private:
  std::array<int, 3> low_{};
  std::array<int, 3> count_{};
  std::vector<double> values_;
};

template <class Visit>
void FacePatch::each(const fluid::Grid& grid, const fluid::Geometry& geometry, int d,
                     const Visit& visit) const {
  const FacePlaces places(grid, d);
  const auto& extent = geometry.extent[d];
  const double* value = values_.data();
  for (int k = low_[2]; k < low_[2] + count_[2]; ++k) {
    for (int j = low_[1]; j < low_[1] + count_[1]; ++j) {
      const bool is_row_inside =
          places.is_inside(2, k, extent[2]) && places.is_inside(1, j, extent[1]);
      const std::ptrdiff_t row = places.along(1, j) + places.along(2, k) + grid.index(0, 0, 0);
      for (int i = low_[0]; i < low_[0] + count_[0]; ++i, ++value) {
        if (!is_row_inside || *value == 0.0 || !places.is_inside(0, i, extent[0])) continue;
        const std::ptrdiff_t at = row + places.along(0, i);
        if (fluid::is_unknown(geometry.kind[d][static_cast<std::size_t>(at)])) visit(at, *value);
      }
    }
  }
}

}  // namespace dust::resolved
