// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::fluid {

/// On which side of a body thinner than a cell a point of the fluid is, and which cells are there.
/// A cell's fluid is that round its centre: what is in the cell beyond the body belongs to the
/// neighbour there, and centres beyond the body are not to be interpolated with.
class ThinBodies {
 public:
  explicit ThinBodies(const Grid& grid) : grid_(grid) {}

  /// Takes the faces that such bodies part.
  void set(const Geometry& geometry);
  [[nodiscard]] std::span<const BlockedFace> faces() const { return faces_; }
  /// There is none: all points stay where they are.
  [[nodiscard]] bool is_empty() const { return cells_.empty(); }
  /// A point [m] of the fluid moved by at most one and a half cells, along the axes of the grid, so
  /// that it lies in a cell of its own side and the centres of cells round it do, too: towards the
  /// centre of its cell, as far as linear interpolation would reach beyond a body. Points away from
  /// thin bodies stay where they are.
  [[nodiscard]] sdk::Vec3 on_own_side(sdk::Vec3 point) const {
    if (cells_.empty()) return point;
    const Indices own = indices(point);
    return cell_at(own) < 0 ? point : moved(point, own);
  }

 private:
  using Indices = std::array<int, 3>;
  static constexpr std::int32_t k_none = -1;
  /// The blocked faces of a cell: low and high of x, y, z, as places in `faces_`.
  struct Cell {
    std::array<std::int32_t, 6> face{k_none, k_none, k_none, k_none, k_none, k_none};
  };

  [[nodiscard]] Indices indices(sdk::Vec3 point) const;
  /// Place in `cells_`; k_none away from thin bodies and outside the domain.
  [[nodiscard]] std::int32_t cell_at(const Indices& at) const;
  [[nodiscard]] bool is_blocked(const Indices& at, int axis, int step) const;
  [[nodiscard]] bool is_corner_blocked(const Indices& cell, const Indices& step) const;
  [[nodiscard]] sdk::Vec3 moved(sdk::Vec3 point, const Indices& own) const;
  [[nodiscard]] Indices cell_of(sdk::Vec3 point, const Indices& own) const;
  [[nodiscard]] double height_over(sdk::Vec3 point, const BlockedFace& face) const;

  const Grid& grid_;
  std::vector<BlockedFace> faces_;
  std::vector<Cell> cells_;
  std::vector<std::int32_t> near_;  ///< of each cell of the grid its place in `cells_`
};

}  // namespace dust::fluid
