// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dust::coupling {

/// Columns of a batch of grains: where each lies between the faces and the middles of the cells
/// along each axis, as numbers of the padded arrays. A face of component d is numbered by the sum
/// of `face` along d and `middle` along the two others, or the next ones.
struct StencilBatch {
  static constexpr std::size_t k_size = 256;
  /// A group is worked on four grains at a time: what is written behind its end belongs to the next
  /// group, which writes it again, or to none.
  static constexpr std::size_t k_room = k_size + 4;
  using Reals = std::array<double, k_room>;
  using Numbers = std::array<std::int32_t, k_room>;

  std::array<Reals, 3> face_part;    ///< between the faces around the grain, 0..1
  std::array<Reals, 3> middle_part;  ///< between the middles of cells around it, 0..1
  std::array<Numbers, 3> face;       ///< of the lower face: of the cell, too
  std::array<Numbers, 3> face_step;  ///< to the upper one
  std::array<Numbers, 3> middle;
  std::array<Numbers, 3> middle_step;
  std::size_t count = 0;
  std::array<double, 4 * k_size> position;  ///< [m] and radius, of those placed

  /// Grains in a row that have the same faces around them: where each group begins, and the end.
  std::array<std::uint16_t, k_size + 1> group;
  std::size_t groups = 0;

  [[nodiscard]] const double* position_of(std::size_t q) const { return &position[4 * q]; }
  [[nodiscard]] double radius(std::size_t q) const { return position[4 * q + 3]; }
};

/// Whether it is worth the while to look the faces up once per group.
[[nodiscard]] inline bool has_large_groups(const StencilBatch& s) {
  constexpr std::size_t k_long = 4;  // about as fast either way
  return k_long * s.groups <= s.count;
}
/// Number of the cell that particle q of the batch lies in.
[[nodiscard]] inline std::ptrdiff_t cell_of(const StencilBatch& s, std::size_t q) {
  return static_cast<std::ptrdiff_t>(s.face[0][q]) + s.face[1][q] + s.face[2][q];
}

/// The eight faces of one grain: the same arithmetic wherever they are visited.
struct Corners {
  std::int32_t base, along, across, up;
  double low, high, near, far, below, above;
};
__attribute__((always_inline)) inline Corners corners(const StencilBatch& s, int d, int e, int f,
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
  const std::int32_t* storages = nullptr;  ///< by index + 2
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

/// What a batch of grains gives by one component, to the coefficient and to the source.
struct FaceContributions {
  StencilBatch::Reals drag;      ///< [kg/(m3 s)] to the coefficient, times w eps
  StencilBatch::Reals velocity;  ///< [m/s] times the drag to the source, times w eps
  StencilBatch::Reals extra;     ///< [N/m3] to the source, times w
  /// [m/s] slip besides that of the faces, times eps around the grain: what the grain makes itself,
  /// less the part of the slip before that the tangent of its drag takes back.
  StencilBatch::Reals flux_difference;
};
/// What the contributions are made of; `coefficient` is the same for all components.
struct ContributionInputs {
  const double* coefficient;        ///< [kg/(m3 s)] W K / (eps^2 V)
  StencilBatch::Reals deferred;     ///< [N/m3] residual per cell volume and step
  StencilBatch::Reals gain;         ///< [-] of the drag, by the grain's own solids at the faces
  StencilBatch::Reals open, fluid;  ///< sums over the faces
};
/// Sums of the contributions of a group over each of its eight faces, weighted by w.
struct GroupContributions {
  std::array<double, 8> drag, push, extra;
};

/// Fills the columns of one axis from `position` (x of the first grain, 4 numbers per grain) of
/// `stencils.count` grains.
void place_along(const AxisView& axis, const double* position, int d, StencilBatch& stencils);
/// Finds the groups, once all axes are placed.
void find_groups(StencilBatch& stencils);

// Columns written have StencilBatch::k_room.
void sum_faces(const StencilBatch& stencils, int d, const FaceColumns& faces,
               const FaceSumColumns& sums);
/// The same, and flux = sum(w eps (u - v)).
void sample_faces(const StencilBatch& stencils, int d, const FaceColumns& faces, const double* u,
                  const double* v, const FaceSumColumns& sums, double* flux);
/// slip = flux / eps, and ratio = (fluid / open) / eps, 1 without open faces: void fraction at the
/// faces over that around the grain; docs/theory/coupling.md, eq. (4), (7).
void slip_of_faces(std::size_t count, const double* eps, const FaceSumColumns& sums,
                   const double* flux, double* slip, double* ratio);
/// drag and extra from `input`; 0 for grains with less than `least_open` around them. `is_density`:
/// the residual is received by the open share, not by the fluid's.
void find_contributions(std::size_t count, const ContributionInputs& input, double least_open,
                        bool is_density, FaceContributions& contributions);
/// given = scale drag sum(w a e (eps (u - v) + flux difference)), e = 1 for `is_density`, else eps.
void evaluate_faces(const StencilBatch& stencils, int d, const FaceColumns& faces, const double* u,
                    const FaceContributions& contributions, double scale, bool is_density,
                    double* given);
/// Adds up the contributions of one group.
void sum_group(const StencilBatch& stencils, int d, std::size_t group,
               const FaceContributions& contributions, GroupContributions& sum);

}  // namespace dust::coupling
