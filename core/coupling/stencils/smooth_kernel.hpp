// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/face_void_fraction.hpp"
#include "coupling/stencils/lattice.hpp"

#include <array>
#include <cstddef>

namespace dust::coupling {

/// The faces that a grain is coupled to where its own disturbance is taken off: along each axis a
/// cubic B-spline of knots max(D, 1.25 dx), made to sum to 1 over the faces (or middles of cells)
/// it meets. The same weights gather the fluid's velocity and spread the force, and with splines as
/// wide as that neither jumps as the grain moves (docs/theory/own_disturbance.md).
class SmoothKernel {
 public:
  explicit SmoothKernel(const Lattice& lattice) : lattice_(lattice) {}

  /// What is around a grain: open fluid alone, a side of the domain or the flat surface of a body
  /// besides, or what the kernel cannot be used with: bodies of other shapes, ones that go to other
  /// places, or fewer cells along an axis than it needs.
  enum class Room { open, beside, none };
  /// Looks at a grain of `diameter` at `position` [m]. Beside a side or a surface the kernel is not
  /// wider than the halo or the faces beyond, which hold the mirrored velocity.
  Room set(const double* position, double diameter);

  /// Standard deviation [m] of the Gaussian that the grid answers like (self_disturbance), the
  /// geometric mean of the axes.
  [[nodiscard]] double width() const { return width_; }
  /// Part of a cell that takes solids [-]: its open share where bodies cut the kernel, else 1.
  [[nodiscard]] double room_in(std::ptrdiff_t cell) const {
    if (!is_cut_) return 1.0;
    const double open = lattice_.open_fraction(cell);
    return open >= k_min_open ? open : 0.0;
  }
  /// Share of the weights of component d inside the domain and outside bodies, faces on the sides
  /// not counted [-].
  [[nodiscard]] double inside(int d) const;
  /// The same of the cells.
  [[nodiscard]] double inside() const { return inside(k_cells); }
  /// What it would find of itself, spread over the cells inside: sum over the faces inside of their
  /// weights times the mean of the weights of the two cells beside, both made to sum to 1 [-].
  [[nodiscard]] double overlap(int d) const;
  /// Sum of the squares of the weights of component d [-].
  [[nodiscard]] double concentration(int d) const;
  /// Mean of a cell field.
  [[nodiscard]] double mean(const fluid::CellField& field) const {
    double sum = 0.0;
    for_cells([&](std::ptrdiff_t cell, double w) { sum += w * field[cell]; });
    return sum;
  }
  /// Weight of the face of component d below the cell (i, j, k), the part outside bodies; indices
  /// may lie beyond a period.
  [[nodiscard]] double weight(int d, std::array<int, 3> face) const;
  /// The same of the face accounted at the padded index `storage`.
  [[nodiscard]] double weight_at_storage(int d, std::ptrdiff_t storage) const;
  /// Weight of a cell.
  [[nodiscard]] double weight(std::array<int, 3> cell) const { return weight(k_cells, cell); }

  /// Calls look(home, weight) for the faces of component d; the weights sum to 1.
  template <class Look>
  __attribute__((always_inline)) inline void for_faces(int d, const Look& look) const {
    const Points& x = points(d, 0);
    const Points& y = points(d, 1);
    const Points& z = points(d, 2);
    for (std::size_t k = 0; k < z.count; ++k) {
      for (std::size_t j = 0; j < y.count; ++j) {
        const std::ptrdiff_t row = z.offset[k] + y.offset[j];
        const double across = z.weight[k] * y.weight[j];
        for (std::size_t i = 0; i < x.count; ++i) look(row + x.offset[i], across * x.weight[i]);
      }
    }
  }
  /// Sums over the faces of component d: weight times open share, and that times void fraction [-].
  struct Sums {
    double open = 0.0, fluid = 0.0;
  };
  [[nodiscard]] Sums sum_faces(int d, const FaceColumns& columns) const {
    Sums sums;
    for_faces(d, [&](std::ptrdiff_t face, double w) {
      const double part = w * columns.open[face];
      sums.open += part;
      sums.fluid += part * columns.void_fraction[face];
    });
    return sums;
  }
  /// The same for the cells around the grain: look(cell, weight).
  template <class Look>
  void for_cells(const Look& look) const {
    for_faces(k_cells, look);
  }
  /// Calls look({i, j, k}, cell); indices may lie beyond a side or a period.
  template <class Look>
  void for_indexed_cells(const Look& look) const {
    const auto& [x, y, z] = middles_;
    for (std::size_t k = 0; k < z.count; ++k) {
      for (std::size_t j = 0; j < y.count; ++j) {
        for (std::size_t i = 0; i < x.count; ++i) {
          look(std::array<int, 3>{x.first + static_cast<int>(i), y.first + static_cast<int>(j),
                                  z.first + static_cast<int>(k)},
               x.offset[i] + y.offset[j] + z.offset[k]);
        }
      }
    }
  }

 private:
  static constexpr int k_cells = 3;  ///< in place of a component: no axis has faces
  /// 4 knots of at most k_largest_ratio cells (19 points), and some for rounding.
  static constexpr std::size_t k_room = 20;
  /// What the spline meets along one axis.
  struct Points {
    int first = 0;
    int lowest = 0;  ///< first and last inside the domain, if any
    int highest = 0;
    std::size_t count = 0;
    double inside = 1.0;  ///< sum of the weights of those
    std::array<std::ptrdiff_t, k_room> offset;
    std::array<double, k_room> weight;
  };
  /// Weight of an index inside the domain, 0 beyond.
  [[nodiscard]] static double weight_at(const Points& p, int index) {
    return index < p.lowest || index > p.highest
               ? 0.0
               : p.weight[static_cast<std::size_t>(index - p.first)];
  }
  [[nodiscard]] const Points& points(int d, int axis) const {
    return (d == axis ? faces_ : middles_)[static_cast<std::size_t>(axis)];
  }
  void meet(int axis, double place, double knots, bool is_of_faces, Points& points) const;
  Room meet_domain(const double* position, double diameter, const sdk::Vec3& most_knots);
  [[nodiscard]] bool is_clear() const;
  [[nodiscard]] double plain_weight(int d, std::array<int, 3> face) const;
  /// Calls look({i, j, k}) for the faces of component d (cells) inside the domain.
  template <class Look>
  void for_inside(int d, const Look& look) const {
    const Points& x = points(d, 0);
    const Points& y = points(d, 1);
    const Points& z = points(d, 2);
    for (int k = z.lowest; k <= z.highest; ++k) {
      for (int j = y.lowest; j <= y.highest; ++j) {
        for (int i = x.lowest; i <= x.highest; ++i) look(std::array<int, 3>{i, j, k});
      }
    }
  }
  [[nodiscard]] std::ptrdiff_t accounted_at(std::array<int, 3> at) const {
    return lattice_.offset_along(0, at[0]) + lattice_.offset_along(1, at[1]) +
           lattice_.offset_along(2, at[2]);
  }
  [[nodiscard]] double overlap_of_cut(int d) const;
  [[nodiscard]] bool is_beside_plane(sdk::Vec3 position, const NearWalls::Wall& wall) const;

  const Lattice& lattice_;
  std::array<Points, 3> faces_;
  std::array<Points, 3> middles_;
  double width_ = 0.0;
  bool is_cut_ = false;  ///< a body takes some of its cells
};

}  // namespace dust::coupling
