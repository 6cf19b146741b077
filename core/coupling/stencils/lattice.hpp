// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/face_kernels.hpp"
#include "coupling/stencils/near_walls.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::coupling {

/// Share of a cell outside all bodies below which the cell counts as closed: it holds no grain
/// volume. A grain pressed against a body then shares its volume among the open cells around, and
/// the void fraction of a sliver does not jump with each grain.
inline constexpr double k_min_open = 0.1;

/// Distance from the sides, in cells, at which points on or beyond them are taken to be.
inline constexpr double k_off_side = 1e-5;

/// Where a point lies along one axis.
struct AxisPlace {
  double face_part = 0;    ///< position between the faces `cell` and `cell` + 1, 0..1
  double middle_part = 0;  ///< position between the centres of `middle` and `middle` + 1, 0..1
  int cell = 0;            ///< cell, clamped into the grid
  int middle = 0;          ///< cell whose centre is the next one below, -1..count-1
};
using Place = std::array<AxisPlace, 3>;

/// The eight faces of one component around a point, and what the exchange needs to know of them.
struct Stencil {
  std::array<std::ptrdiff_t, 8> storage;  ///< where the face is accounted (periodic images wrapped)
  std::array<double, 8> weight;           ///< trilinear, sum 1
  std::array<double, 8> void_fraction;    ///< at the face: mean of its two cells
  std::array<double, 8> open;  ///< open share of the face's control volume, 0 = takes nothing
};
[[nodiscard]] constexpr std::size_t size(const Stencil&) { return 8; }

/// Indices of the grid with its sides: where a cell or a face outside the grid is accounted.
class Lattice {
 public:
  Lattice(const fluid::Grid& grid, const fluid::CellField& open_fraction);
  // The axes point into the tables.
  Lattice(const Lattice&) = delete;
  Lattice& operator=(const Lattice&) = delete;

  /// After bodies have moved.
  void set_open_fraction(const fluid::CellField& open_fraction);

  /// After set_open_fraction(): faces between cells that a thin body keeps apart take nothing.
  void close(std::span<const fluid::BlockedFace> faces);
  /// The surfaces of bodies, whose corners reach over faces that are open for the greater part.
  void use_walls(std::vector<particles::Surface> surfaces);

  [[nodiscard]] const fluid::Grid& grid() const { return grid_; }
  [[nodiscard]] double cell_volume() const { return cell_volume_; }
  [[nodiscard]] double open_fraction(std::ptrdiff_t cell) const { return open_cell_[cell]; }
  [[nodiscard]] double open_share(int d, std::ptrdiff_t face) const { return open_face_[d][face]; }

  /// Padded index of a cell; outside the grid that of its periodic image, else of the nearest one.
  [[nodiscard]] std::ptrdiff_t cell(int i, int j, int k) const {
    return offset(cells_[0], i) + offset(cells_[1], j) + offset(cells_[2], k);
  }
  /// Padded index at which a face is accounted: periodic images wrapped, others where they lie.
  [[nodiscard]] std::ptrdiff_t storage(int i, int j, int k) const {
    return offset(storage_[0], i) + offset(storage_[1], j) + offset(storage_[2], k);
  }
  /// What an index along one axis adds to the padded index of a cell or the home of a face,
  /// periodic images wrapped however far they are. Without periods it must be inside.
  [[nodiscard]] std::ptrdiff_t offset_along(int axis, int index) const {
    const int n = grid_.count[axis];
    const bool is_wrapped = grid_.is_periodic[axis] && (index < 0 || index >= n);
    return offset(storage_[axis], is_wrapped ? ((index % n) + n) % n : index);
  }
  /// Whether a padded index is that of a cell of the domain, not of the halo.
  [[nodiscard]] bool is_in_domain(std::ptrdiff_t cell) const {
    const std::array<int, 3> at = indices(cell);
    return is_inside(0, at[0]) && is_inside(1, at[1]) && is_inside(2, at[2]);
  }
  /// Whether a body takes part of a cell.
  [[nodiscard]] bool has_bodies() const { return has_bodies_; }
  /// The surfaces of the bodies that do, as far as they were given.
  [[nodiscard]] const NearWalls& walls() const { return walls_; }
  /// Open shares of the faces of component d, by home.
  [[nodiscard]] const float* open_shares(int d) const { return open_face_[d].data(); }

  /// As cell(), but only for open cells of the domain; -1 elsewhere.
  [[nodiscard]] std::ptrdiff_t open_cell(int i, int j, int k) const {
    if (is_inside(0, i) && is_inside(1, j) && is_inside(2, k)) {
      const std::ptrdiff_t c = grid_.index(i, j, k);
      return open_cell_[c] >= k_min_open ? c : -1;
    }
    return open_image(i, j, k);
  }
  /// (i, j, k) of a padded index.
  [[nodiscard]] std::array<int, 3> indices(std::ptrdiff_t cell) const;
  /// Open cell nearest to `position` [m] among the 125 around it, -1 if there is none.
  [[nodiscard]] std::ptrdiff_t nearest_open_cell(const double* position) const;
  /// The six neighbours of a cell given by padded index, -1 where there is no open cell or a thin
  /// body lies between.
  [[nodiscard]] std::array<std::ptrdiff_t, 6> open_neighbours(std::ptrdiff_t cell) const;

  /// Place of a point [m]; points outside the domain are taken to its side or wrapped.
  [[nodiscard]] Place place(const double* position) const {
    return {axis_place(0, position[0]), axis_place(1, position[1]), axis_place(2, position[2])};
  }
  [[nodiscard]] std::ptrdiff_t cell(const Place& p) const {
    return cell(p[0].cell, p[1].cell, p[2].cell);
  }
  /// Faces of component d around `p`: where they are accounted, and their weights.
  void faces(int d, const Place& p, Stencil& s) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const std::ptrdiff_t low = offset(storage_[d], p[d].cell);
    const std::ptrdiff_t step = offset(storage_[d], p[d].cell + 1) - low;
    const std::array<std::ptrdiff_t, 2> column{low + offset(storage_[e], p[e].middle),
                                               low + offset(storage_[e], p[e].middle + 1)};
    const std::array<std::ptrdiff_t, 2> row{offset(storage_[f], p[f].middle),
                                            offset(storage_[f], p[f].middle + 1)};
    const std::array<double, 2> part_e{1.0 - p[e].middle_part, p[e].middle_part};
    const std::array<double, 2> part_f{1.0 - p[f].middle_part, p[f].middle_part};
    for (std::size_t n = 0; n < 4; ++n) {
      const double across = part_e[n & 1] * part_f[n >> 1];
      s.storage[2 * n] = column[n & 1] + row[n >> 1];
      s.storage[2 * n + 1] = s.storage[2 * n] + step;
      s.weight[2 * n] = across * (1.0 - p[d].face_part);
      s.weight[2 * n + 1] = across * p[d].face_part;
    }
  }
  /// The same with the void fractions from the padded field `eps`, and the open shares.
  void stencil(int d, const Place& p, const fluid::CellField& eps, Stencil& s) const {
    faces(d, p, s);
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const int first = p[d].cell;
    const std::array<std::ptrdiff_t, 3> along{
        offset(cells_[d], first - 1), offset(cells_[d], first), offset(cells_[d], first + 1)};
    for (std::size_t n = 0; n < 4; ++n) {
      const std::ptrdiff_t column = offset(cells_[e], p[e].middle + static_cast<int>(n & 1)) +
                                    offset(cells_[f], p[f].middle + static_cast<int>(n >> 1));
      const double own = eps[along[1] + column];
      s.void_fraction[2 * n] = 0.5 * (eps[along[0] + column] + own);
      s.void_fraction[2 * n + 1] = 0.5 * (own + eps[along[2] + column]);
      s.open[2 * n] = open_face_[d][s.storage[2 * n]];
      s.open[2 * n + 1] = open_face_[d][s.storage[2 * n + 1]];
    }
  }
  /// The face below (side 0) or above (1) a cell of the domain along d.
  struct Face {
    std::ptrdiff_t storage;  ///< where it is accounted
    std::ptrdiff_t below;    ///< padded indices of its cells
    std::ptrdiff_t above;
  };
  [[nodiscard]] Face face(int d, int i, int j, int k, int side) const {
    std::array<int, 3> at{i, j, k};
    at[static_cast<std::size_t>(d)] += side;
    const std::ptrdiff_t above = cell(at[0], at[1], at[2]);
    return {storage(at[0], at[1], at[2]),
            cell(at[0] - (d == 0), at[1] - (d == 1), at[2] - (d == 2)), above};
  }

  /// Slope [1/m] of a cell field along d at `p`, the mean over the same two faces, weighted by
  /// their open shares.
  [[nodiscard]] double cell_slope(int d, const Place& p, const fluid::CellField& field) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const std::ptrdiff_t column = offset(cells_[e], p[e].cell) + offset(cells_[f], p[f].cell);
    const std::ptrdiff_t storage = offset(storage_[e], p[e].cell) + offset(storage_[f], p[f].cell);
    const double share_low = open_face_[d][offset(storage_[d], p[d].cell) + storage];
    const double share_high = open_face_[d][offset(storage_[d], p[d].cell + 1) + storage];
    const double sum = share_low + share_high;
    if (!(sum > 0.0)) return 0.0;
    const double below = field[offset(cells_[d], p[d].cell - 1) + column];
    const double own = field[offset(cells_[d], p[d].cell) + column];
    const double above = field[offset(cells_[d], p[d].cell + 1) + column];
    return (share_low * (own - below) + share_high * (above - own)) * inverse_spacing_[d] / sum;
  }

  /// place() of a batch of grains, `stencils.count` of them at `stencils.position`, and their runs.
  void place(StencilBatch& stencils) const {
    for (int d = 0; d < 3; ++d) place_along(axes_[d], stencils.position.data(), d, stencils);
    find_groups(stencils);
  }
  /// The cell whose void fraction a grain in the cell `own` has: that, or an open neighbour's if it
  /// is closed.
  [[nodiscard]] std::ptrdiff_t host_cell(std::ptrdiff_t own, const double* position) const {
    if (open_cell_[own] >= k_min_open) return own;
    const std::ptrdiff_t other = nearest_open_cell(position);
    return other >= 0 ? other : own;
  }
  /// Value of component d in a cell from its faces `low` and `high`: the transpose of giving each
  /// face half of a cell. Closed faces count as 0: no force of the fluid's own is spent on them.
  [[nodiscard]] double face_mean(int d, std::ptrdiff_t low, std::ptrdiff_t high,
                                 const std::vector<double>& field) const {
    return 0.5 * ((open_face_[d][low] > 0.0F ? field[low] : 0.0) +
                  (open_face_[d][high] > 0.0F ? field[high] : 0.0));
  }

  /// Calls work(i, j, k, padded index) for every cell; each in one thread.
  template <class Work>
  void for_cells(const Work& work) const {
    fluid::for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
      for (int i = 0; i < grid_.count[0]; ++i) work(i, j, k, grid_.index(i, j, k));
    });
  }
  /// Copies face 0 to the last face along each periodic direction.
  void close_periodic(int d, std::vector<double>& field) const;

 private:
  using Offsets = std::vector<std::ptrdiff_t>;  ///< of the indices -2 .. count + 1
  [[nodiscard]] bool is_inside(std::size_t d, int i) const {
    return static_cast<unsigned>(i) < static_cast<unsigned>(grid_.count[d]);
  }
  [[nodiscard]] bool is_blocked(std::size_t d, std::ptrdiff_t face) const;
  void open_faces(int d);
  [[nodiscard]] bool is_in_body(sdk::Vec3 face) const;
  /// open_cell() of a cell outside the grid.
  [[nodiscard]] std::ptrdiff_t open_image(int i, int j, int k) const;
  static std::ptrdiff_t offset(const Offsets& table, int index) {
    return table[static_cast<std::size_t>(index + 2)];
  }
  [[nodiscard]] AxisPlace axis_place(int d, double x) const {
    const int n = grid_.count[d];
    double s = (x - grid_.origin[d]) * inverse_spacing_[d];
    if (grid_.is_periodic[d]) s -= n * std::floor(s / n);
    // A point on a side itself would have no open face along d.
    s = std::clamp(s, k_off_side, n - k_off_side);
    AxisPlace p;
    p.cell = std::min(static_cast<int>(s), n - 1);
    p.face_part = s - p.cell;
    const bool is_lower_half = p.face_part < 0.5;
    p.middle = p.cell - (is_lower_half ? 1 : 0);
    p.middle_part = p.face_part + (is_lower_half ? 0.5 : -0.5);
    return p;
  }
  fluid::Grid grid_;
  double cell_volume_;
  sdk::Vec3 inverse_spacing_;
  fluid::CellField open_cell_;
  bool has_bodies_ = false;
  NearWalls walls_;
  std::array<std::vector<float>, 3> open_face_;
  std::array<std::vector<std::ptrdiff_t>, 3> blocked_;  ///< by thin bodies; ascending
  std::array<Offsets, 3> cells_;                        ///< wrapped or clamped
  std::array<Offsets, 3> padded_;                       ///< where the array holds it
  std::array<Offsets, 3> storage_;  ///< wrapped where periodic, else where the array holds it
  std::array<std::vector<std::int32_t>, 3> short_storage_;
  std::array<AxisView, 3> axes_;
};

}  // namespace dust::coupling
