// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dust::coupling {

/// Columns of a batch of grains: where each lies between the faces and the middles of the cells
/// along each axis, as numbers of the padded arrays. A face of component d is numbered by the sum
/// of `face` along d and `middle` along the two others, or the next ones.
struct SpotBatch {
  static constexpr std::size_t k_size = 256;
  using Reals = std::array<double, k_size>;
  using Numbers = std::array<std::int32_t, k_size>;

  std::array<Reals, 3> face_part;    ///< between the faces around the grain, 0..1
  std::array<Reals, 3> middle_part;  ///< between the middles of cells around it, 0..1
  std::array<Numbers, 3> face;       ///< of the lower face: of the cell, too
  std::array<Numbers, 3> face_step;  ///< to the upper one
  std::array<Numbers, 3> middle;
  std::array<Numbers, 3> middle_step;

  /// Number of the cell that the grain lies in.
  [[nodiscard]] std::ptrdiff_t cell(std::size_t q) const {
    return static_cast<std::ptrdiff_t>(face[0][q]) + face[1][q] + face[2][q];
  }
};

/// The eight faces of one grain: the same arithmetic wherever they are visited.
struct Corners {
  std::int32_t base, along, across, up;
  double low, high, near, far, below, above;
};
__attribute__((always_inline)) inline Corners corners(const SpotBatch& s, int d, int e, int f,
                                                      std::size_t q) {
  Corners c;
  c.base = s.face[d][q] + s.middle[e][q] + s.middle[f][q];
  c.along = s.face_step[d][q];
  c.across = s.middle_step[e][q];
  c.up = s.middle_step[f][q];
  c.high = s.face_part[d][q];
  c.low = 1.0 - c.high;
  c.far = s.middle_part[e][q];
  c.near = 1.0 - c.far;
  c.above = s.middle_part[f][q];
  c.below = 1.0 - c.above;
  return c;
}
/// Calls look(face, weight) for each of the eight.
template <class Look>
__attribute__((always_inline)) inline void for_corners(const Corners& c, const Look& look) {
  const double w0 = c.near * c.below;
  const double w1 = c.far * c.below;
  const double w2 = c.near * c.above;
  const double w3 = c.far * c.above;
  look(c.base, w0 * c.low);
  look(c.base + c.along, w0 * c.high);
  look(c.base + c.across, w1 * c.low);
  look(c.base + c.across + c.along, w1 * c.high);
  look(c.base + c.up, w2 * c.low);
  look(c.base + c.up + c.along, w2 * c.high);
  look(c.base + c.up + c.across, w3 * c.low);
  look(c.base + c.up + c.across + c.along, w3 * c.high);
}

/// One axis of the grid for place_along.
struct AxisView {
  double origin = 0.0;           ///< [m]
  double inverse_spacing = 0.0;  ///< [1/m]
  int count = 1;
  bool is_periodic = false;
  const std::int32_t* homes = nullptr;  ///< by index + 2
};

/// What is looked up at faces: void fraction and open share.
struct FaceColumns {
  const double* void_fraction = nullptr;
  const float* open = nullptr;
};

/// Sums over the eight faces of component d around each grain, w the trilinear weights:
/// open = sum(w a), fluid = sum(w a eps).
struct FaceSumColumns {
  double* open = nullptr;
  double* fluid = nullptr;
};

/// Fills the columns of one axis from `position` (x of the first grain, 4 numbers per grain).
void place_along(const AxisView& axis, const double* position, std::size_t count, int d,
                 SpotBatch& spots);
void sum_faces(const SpotBatch& spots, int d, std::size_t count, const FaceColumns& faces,
               const FaceSumColumns& sums);
/// The same, and flux = sum(w eps (u - v)).
void look_at_faces(const SpotBatch& spots, int d, std::size_t count, const FaceColumns& faces,
                   const double* u, const double* v, const FaceSumColumns& sums, double* flux);
/// given = factor sum(w a e (eps (u - v) + disturbance)), e = 1 for `is_density`, else eps.
void settle_faces(const SpotBatch& spots, int d, std::size_t count, const FaceColumns& faces,
                  const double* u, const double* v, const double* disturbance, const double* factor,
                  bool is_density, double* given);

}  // namespace dust::coupling
