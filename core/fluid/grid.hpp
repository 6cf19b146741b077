// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "dust/sdk/voidage_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dust::fluid {

/// Uniform Cartesian staggered grid. Cells are (i, j, k), 0 <= i < count; every array carries a
/// halo, so that neighbours of edge cells exist. Component d of a face field at (i, j, k) sits on
/// the lower face of cell (i, j, k) in direction d; the last face of a row is in the halo.
struct Grid {
  static constexpr int k_halo = 2;    ///< cells outside on each side in y and z
  static constexpr int k_margin = 8;  ///< in x, so that rows start on a cache line

  sdk::Vec3 origin;
  sdk::Vec3 spacing;
  std::array<int, 3> count{1, 1, 1};
  std::array<bool, 3> is_periodic{false, false, false};
  std::array<std::ptrdiff_t, 3> stride{1, 1, 1};
  std::size_t size = 0;  ///< of a padded array

  static Grid make(sdk::Vec3 min, sdk::Vec3 max, std::array<int, 3> cells,
                   std::array<bool, 3> periodic) {
    Grid g;
    g.origin = min;
    g.count = cells;
    g.is_periodic = periodic;
    for (int d = 0; d < 3; ++d) g.spacing[d] = (max[d] - min[d]) / cells[d];
    const std::ptrdiff_t row = (cells[0] + 2 * k_margin + 7) / 8 * 8;
    const int ny = cells[1] + 2 * k_halo;
    const int nz = cells[2] + 2 * k_halo;
    // The rows of a flat grid lie one after the other, not apart by the halo's.
    const bool is_flat = cells[1] == 1;
    g.stride[1] = is_flat ? row * nz : row;
    g.stride[2] = is_flat ? row : row * ny;
    g.size = static_cast<std::size_t>(row) * ny * nz;
    return g;
  }

  /// [m] of the domain where it is periodic, else 0.
  [[nodiscard]] sdk::Vec3 period() const {
    sdk::Vec3 lengths;
    for (int d = 0; d < 3; ++d) {
      if (is_periodic[static_cast<std::size_t>(d)]) lengths[d] = count[d] * spacing[d];
    }
    return lengths;
  }
  /// The image of a place that lies between periodic sides.
  [[nodiscard]] sdk::Vec3 inside(sdk::Vec3 place) const {
    const sdk::Vec3 length = period();
    for (int d = 0; d < 3; ++d) {
      if (length[d] > 0.0) place[d] -= length[d] * std::floor((place[d] - origin[d]) / length[d]);
    }
    return place;
  }
  /// Layer of cells across d that `x` [m] lies in, be it beyond the grid.
  [[nodiscard]] int layer_of(int d, double x) const {
    return static_cast<int>(std::floor((x - origin[d]) / spacing[d]));
  }
  /// The cell that a place lies in, or the nearest one to a place beyond the grid.
  [[nodiscard]] std::array<int, 3> cell_at(sdk::Vec3 place) const {
    std::array<int, 3> cell{};
    for (int d = 0; d < 3; ++d) {
      const auto n = static_cast<std::size_t>(d);
      cell[n] = std::clamp(layer_of(d, place[d]), 0, count[n] - 1);
    }
    return cell;
  }
  [[nodiscard]] std::ptrdiff_t index(int i, int j, int k) const {
    return i + k_margin + stride[1] * (j + k_halo) + stride[2] * (k + k_halo);
  }
  [[nodiscard]] sdk::Vec3 centre(int i, int j, int k) const {
    return {origin.x + (i + 0.5) * spacing.x, origin.y + (j + 0.5) * spacing.y,
            origin.z + (k + 0.5) * spacing.z};
  }
  /// Centre of the lower face in direction d of cell (i, j, k).
  [[nodiscard]] sdk::Vec3 face(int d, int i, int j, int k) const {
    sdk::Vec3 p = centre(i, j, k);
    p[d] -= 0.5 * spacing[d];
    return p;
  }
  /// [m] Largest edge of a cell, directions of one cell left out.
  [[nodiscard]] double largest_spacing() const {
    double largest = 0.0;
    for (int d = 0; d < 3; ++d) {
      if (count[d] > 1 && spacing[d] > largest) largest = spacing[d];
    }
    return largest;
  }
  [[nodiscard]] double cell_volume() const { return spacing.x * spacing.y * spacing.z; }
  [[nodiscard]] sdk::GridShape shape() const {
    return {origin, spacing, {count[0], count[1], count[2]}};
  }
};

/// A number per cell, padded (Grid::index).
using CellField = std::vector<double>;

/// A number per face and direction, padded.
struct FaceField {
  std::array<std::vector<double>, 3> component;

  FaceField() = default;
  explicit FaceField(const Grid& grid) {
    for (auto& c : component) c.assign(grid.size, 0.0);
  }
};

/// What the grains do to the fluid during one fluid step, per face. The momentum equation divided
/// by the local void fraction reads
///   rho (du/dt + u . grad u) = -grad p + div tau - coefficient u + source ,
/// u interstitial at the face, p without its hydrostatic part. `coefficient` is implicit.
struct Exchange {
  FaceField coefficient;  ///< [kg/(m3 s)] >= 0
  FaceField source;       ///< [N/m3]
};

}  // namespace dust::fluid
