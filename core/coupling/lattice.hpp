// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dust::coupling {

/// Share of a cell outside all bodies below which the cell counts as closed: it holds no grain
/// volume. A grain pressed against a body then shares its volume among the open cells around, and
/// the void fraction of a sliver does not jump with each grain.
inline constexpr double k_least_open = 0.1;

/// Distance from the sides, in cells, at which points on or beyond them are taken to be.
inline constexpr double k_off_side = 1e-5;

/// Where a point lies along one axis.
struct AxisPlace {
  int cell = 0;          ///< cell, clamped into the grid
  double face_part = 0;  ///< position between the faces `cell` and `cell` + 1, 0..1
  int middle = 0;        ///< cell whose centre is the next one below, -1..count-1
  double middle_part = 0;
};
using Place = std::array<AxisPlace, 3>;

/// The eight faces of one component around a point, and what the exchange needs to know of them.
struct Stencil {
  std::array<std::ptrdiff_t, 8> face;   ///< where a field is read (halo faces where they lie)
  std::array<std::ptrdiff_t, 8> home;   ///< where the face is accounted (periodic images wrapped)
  std::array<double, 8> weight;         ///< trilinear, sum 1
  std::array<double, 8> void_fraction;  ///< at the face: mean of its two cells
  std::array<double, 8> open;  ///< open share of the face's control volume, 0 = takes nothing

  static constexpr std::size_t size() { return 8; }
};

/// Indices of the grid with its sides: where a cell or a face outside the grid is accounted.
class Lattice {
 public:
  Lattice(const fluid::Grid& grid, const fluid::CellField& open_fraction);

  /// After bodies have moved.
  void set_open_fraction(const fluid::CellField& open_fraction);

  [[nodiscard]] const fluid::Grid& grid() const { return grid_; }
  [[nodiscard]] double cell_volume() const { return cell_volume_; }
  [[nodiscard]] double open_fraction(std::ptrdiff_t cell) const { return open_cell_[cell]; }
  [[nodiscard]] double open_share(int d, std::ptrdiff_t face) const { return open_face_[d][face]; }

  /// Padded index of a cell; outside the grid that of its periodic image, else of the nearest one.
  [[nodiscard]] std::ptrdiff_t cell(int i, int j, int k) const {
    return offset(cells_[0], i) + offset(cells_[1], j) + offset(cells_[2], k);
  }
  /// The same, but only for open cells of the domain; -1 elsewhere.
  [[nodiscard]] std::ptrdiff_t open_cell(int i, int j, int k) const;
  /// (i, j, k) of a padded index.
  [[nodiscard]] std::array<int, 3> indices(std::ptrdiff_t cell) const;
  /// Open cell nearest to `position` [m] among the 125 around it, -1 if there is none.
  [[nodiscard]] std::ptrdiff_t nearest_open_cell(const double* position) const;
  /// The six neighbours of a cell given by padded index, -1 where there is no open cell.
  [[nodiscard]] std::array<std::ptrdiff_t, 6> open_neighbours(std::ptrdiff_t cell) const;

  /// Place of a point [m]; points outside the domain are taken to its side or wrapped.
  [[nodiscard]] Place place(const double* position) const {
    return {axis_place(0, position[0]), axis_place(1, position[1]), axis_place(2, position[2])};
  }
  [[nodiscard]] std::ptrdiff_t cell(const Place& p) const {
    return cell(p[0].cell, p[1].cell, p[2].cell);
  }
  /// The cell whose void fraction a grain at `p` has: its own, or an open neighbour's if closed.
  [[nodiscard]] std::ptrdiff_t host_cell(const Place& p, const double* position) const {
    const std::ptrdiff_t own = cell(p);
    if (open_cell_[own] >= k_least_open) return own;
    const std::ptrdiff_t other = nearest_open_cell(position);
    return other >= 0 ? other : own;
  }

  /// Faces of component d around `p`, with void fractions from the padded field `eps`.
  void stencil(int d, const Place& p, const fluid::CellField& eps, Stencil& s) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const int first = p[d].cell;
    const std::array<std::ptrdiff_t, 3> along{
        offset(cells_[d], first - 1), offset(cells_[d], first), offset(cells_[d], first + 1)};
    for (int n = 0; n < 4; ++n) {
      const int ie = p[e].middle + (n & 1);
      const int jf = p[f].middle + (n >> 1);
      const std::ptrdiff_t column = offset(cells_[e], ie) + offset(cells_[f], jf);
      const std::ptrdiff_t raw = offset(places_[e], ie) + offset(places_[f], jf);
      const std::ptrdiff_t wrapped = offset(homes_[e], ie) + offset(homes_[f], jf);
      const double across = ((n & 1) != 0 ? p[e].middle_part : 1.0 - p[e].middle_part) *
                            ((n >> 1) != 0 ? p[f].middle_part : 1.0 - p[f].middle_part);
      const double below = eps[along[0] + column];
      const double own = eps[along[1] + column];
      const double above = eps[along[2] + column];
      const std::size_t a = 2 * static_cast<std::size_t>(n);
      s.face[a] = offset(places_[d], first) + raw;
      s.face[a + 1] = offset(places_[d], first + 1) + raw;
      s.home[a] = offset(homes_[d], first) + wrapped;
      s.home[a + 1] = offset(homes_[d], first + 1) + wrapped;
      s.weight[a] = across * (1.0 - p[d].face_part);
      s.weight[a + 1] = across * p[d].face_part;
      s.void_fraction[a] = 0.5 * (below + own);
      s.void_fraction[a + 1] = 0.5 * (own + above);
      s.open[a] = open_face_[d][s.home[a]];
      s.open[a + 1] = open_face_[d][s.home[a + 1]];
    }
  }
  /// The face below (side 0) or above (1) a cell of the domain along d.
  struct Face {
    std::ptrdiff_t place;  ///< where a field is read
    std::ptrdiff_t home;   ///< where it is accounted
    std::ptrdiff_t below;  ///< padded indices of its cells
    std::ptrdiff_t above;
  };
  [[nodiscard]] Face face(int d, int i, int j, int k, int side) const {
    std::array<int, 3> at{i, j, k};
    at[static_cast<std::size_t>(d)] += side;
    const std::ptrdiff_t above = cell(at[0], at[1], at[2]);
    return {offset(places_[0], at[0]) + offset(places_[1], at[1]) + offset(places_[2], at[2]),
            offset(homes_[0], at[0]) + offset(homes_[1], at[1]) + offset(homes_[2], at[2]),
            cell(at[0] - (d == 0), at[1] - (d == 1), at[2] - (d == 2)), above};
  }

  /// Value of component d in the cell at `p` from its two faces, weighted by their open shares:
  /// the transpose of giving each face half of a cell. 0 if both are closed.
  [[nodiscard]] double cell_mean(int d, const Place& p, const std::vector<double>& field) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const std::ptrdiff_t column = offset(homes_[e], p[e].cell) + offset(homes_[f], p[f].cell);
    const std::ptrdiff_t low = offset(homes_[d], p[d].cell) + column;
    const std::ptrdiff_t high = offset(homes_[d], p[d].cell + 1) + column;
    const double share_low = open_face_[d][low];
    const double share_high = open_face_[d][high];
    const double sum = share_low + share_high;
    return sum > 0.0 ? (share_low * field[low] + share_high * field[high]) / sum : 0.0;
  }

  /// Slope [1/m] of a cell field along d at `p`, between the same two faces with the same weights.
  [[nodiscard]] double cell_slope(int d, const Place& p, const fluid::CellField& field) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const std::ptrdiff_t column = offset(cells_[e], p[e].cell) + offset(cells_[f], p[f].cell);
    const std::ptrdiff_t home = offset(homes_[e], p[e].cell) + offset(homes_[f], p[f].cell);
    const double share_low = open_face_[d][offset(homes_[d], p[d].cell) + home];
    const double share_high = open_face_[d][offset(homes_[d], p[d].cell + 1) + home];
    const double sum = share_low + share_high;
    if (!(sum > 0.0)) return 0.0;
    const double below = field[offset(cells_[d], p[d].cell - 1) + column];
    const double own = field[offset(cells_[d], p[d].cell) + column];
    const double above = field[offset(cells_[d], p[d].cell + 1) + column];
    return (share_low * (own - below) + share_high * (above - own)) * inverse_spacing_[d] / sum;
  }

  /// Copies face 0 to the last face along each periodic direction.
  void close_periodic(int d, std::vector<double>& field) const;

 private:
  using Offsets = std::vector<std::ptrdiff_t>;  ///< of the indices -2 .. count + 1
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
  std::array<std::vector<float>, 3> open_face_;
  std::array<Offsets, 3> cells_;   ///< wrapped or clamped
  std::array<Offsets, 3> places_;  ///< where the array holds it
  std::array<Offsets, 3> homes_;   ///< wrapped where periodic, else where the array holds it
};

}  // namespace dust::coupling
