// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/boundary_condition.hpp"
#include "fluid/face_properties.hpp"
#include "fluid/grid.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace dust::fluid {

/// How one component of the velocity behaves beyond a side of the domain.
enum class GhostRule { fixed, gradient, periodic };

/// What geometry and viscous stencils need to know of the six sides.
struct SideKinds {
  std::array<sdk::SideRules, 6> rules;
  std::array<bool, 3> is_periodic{false, false, false};
};

[[nodiscard]] inline GhostRule ghost_rule(const SideKinds& sides, int component, int direction,
                                          int is_high) {
  if (sides.is_periodic[direction]) return GhostRule::periodic;
  const auto& r = sides.rules[2 * direction + is_high];
  const auto rule = component == direction ? r.normal_velocity : r.tangential_velocity;
  return rule == sdk::SideRule::fixed ? GhostRule::fixed : GhostRule::gradient;
}
/// Is the velocity through this side an unknown, driven by a pressure given outside?
[[nodiscard]] inline bool is_pressure_side(const SideKinds& sides, int direction, int is_high) {
  return !sides.is_periodic[direction] &&
         sides.rules[2 * direction + is_high].normal_velocity != sdk::SideRule::fixed;
}

/// Points of bodies' surfaces at which the fluid needs the surface velocity, grouped by body.
struct WallPoints {
  std::vector<double> x, y, z, normal_x, normal_y, normal_z;
  std::array<std::vector<double>, 3> velocity;
  std::vector<std::size_t> body_begin;  ///< first point of each body, and the end
};

/// The velocities at `time` [s].
void evaluate(WallPoints& wall, const bodies::BodySet& bodies, double time);
/// Component d of the velocity with which the surface itself shifts along its normal at point n:
/// what a surface does to the fluid behind it, whatever it does along itself.
[[nodiscard]] inline double normal_part(const WallPoints& w, int d, std::size_t n) {
  const double across = w.velocity[0][n] * w.normal_x[n] + w.velocity[1][n] * w.normal_y[n] +
                        w.velocity[2][n] * w.normal_z[n];
  return across * (d == 0 ? w.normal_x[n] : d == 1 ? w.normal_y[n] : w.normal_z[n]);
}

/// A face whose viscous stencil is not the plain one: next to a surface, to a side in x or to a
/// border of fluids of different viscosity. div(grad u) = sum_s weight_s (value_s - u), s =
/// low/high of x, y, z; value_s is the wall's velocity where wall_point >= 0, else the neighbouring
/// number of the array.
struct CutFace {
  static constexpr std::int32_t k_neighbour = -1;
  static constexpr std::int32_t k_side = -2;  ///< the side's own value, kept in the halo for sweeps
  std::int32_t at = 0;
  std::int16_t i = 0;
  std::array<std::int32_t, 6> wall_point{k_neighbour, k_neighbour, k_neighbour,
                                         k_neighbour, k_neighbour, k_neighbour};
  std::array<double, 6> weight{};  ///< [1/m2]
};

/// A face inside a body: u = wall - factor (u(image) - wall), image = its mirror point in the
/// fluid. Or a face between cells that a thin body keeps apart: u = what the body displaces through
/// it.
struct GhostFace {
  std::int32_t at = 0;
  std::int32_t wall_point = 0;
  double factor = 0.0;  ///< 0 deep inside
  bool is_partly_open =
      false;  ///< part of the face is open: fluid passes, continuity has the last word
  bool is_blocked = false;
  std::array<std::int32_t, 8> node{};
  std::array<double, 8> weight{};
};

/// A face that a surface cuts: the mean velocity through its open part is that at the middle of
/// the open part, u + sum_s weight_s (u(neighbour_s) - u). With the number at the middle of the
/// whole face instead, continuity would be wrong by a first-order term in every cut cell.
struct OpenPart {
  std::int32_t at = 0;
  std::int32_t below = 0;  ///< the cell on the low side
  std::array<std::int32_t, 2> neighbour{};
  std::array<double, 2> weight{};
};

/// A face beside a surface that moves along itself askew to the grid. Convection along the grid's
/// lines would carry the layer at such a surface across it: the errors along two lines do not
/// cancel. Here it runs along the surface.
struct SkewFace {
  std::int32_t at = 0;
  int i = 0;
  int along = 1;                 ///< axis of the grid that the surface is parallel to
  int other = 2;                 ///< the other component across that axis
  double own_part = 0.0;         ///< of the direction along the surface, across that axis
  double other_part = 0.0;       ///< the same, component `other`
  double distance = 0.0;         ///< [m]
  double inverse_length = 0.0;   ///< [1/m]
  std::int32_t begin = 0;        ///< nodes of the own component ...
  std::int32_t other_begin = 0;  ///< ... and of the other one, at the same place
  std::int32_t end = 0;
  std::int32_t wall_point = 0;  ///< next to the face
};

/// What a face, or a point of the surface, gives to the value at a SkewFace (the own component's:
/// without the face itself) and to its derivatives along and across the surface: a polynomial of
/// second degree in the way along the surface and the distance from it, by least squares.
struct SkewNode {
  std::int32_t from = 0;  ///< place of a face; -1 - n: point n of WallPoints
  double mean = 0.0;
  double slope = 0.0;   ///< [1/m]
  double ascent = 0.0;  ///< [1/m]
};

/// A face between cells that a body thinner than their distance keeps apart, and the plane of the
/// body there.
struct BlockedFace {
  std::int32_t at = 0;
  int axis = 0;
  std::array<int, 3> upper{};  ///< the cell on the high side
  sdk::Vec3 middle;            ///< [m] of the body, between the centres of the cells
  sdk::Vec3 normal;            ///< towards the upper cell
};

/// given: on a side with given velocity, or outside the domain; plain: unknown with the plain
/// stencil; cut: unknown, stencil in the list `cut`; inside: in a body, in the list `ghost`.
enum class FaceKind : std::uint8_t { given, plain, cut, inside };

inline bool is_unknown(FaceKind k) { return k == FaceKind::plain || k == FaceKind::cut; }

/// What the bodies and the sides make of the grid: once where all bodies stand, else for each
/// interval of time in which they move.
struct Geometry {
  CellField open_fraction;  ///< share of the cell outside bodies at the end of the interval
  FaceField open_area;      ///< share of the face outside bodies, mean over the interval
  std::array<std::vector<FaceKind>, 3> kind;
  std::array<std::array<int, 3>, 3> extent;  ///< faces per component and direction
  /// Components without unknowns (across a thin domain between walls) cost nothing.
  std::array<bool, 3> has_unknown{false, false, false};
  std::array<std::vector<CutFace>, 3> cut;             ///< in the order of rows
  std::array<std::vector<std::int32_t>, 3> cut_begin;  ///< per row (j + extent_y k), and the end
  std::array<std::vector<GhostFace>, 3> ghost;
  std::array<std::size_t, 3> deep_ghosts_begin{};  ///< from here on they mirror nothing
  std::array<std::vector<OpenPart>, 3> open_part;
  /// No fluid passes, whatever part of the face is open, but a body that moves displaces fluid
  /// through.
  std::vector<BlockedFace> blocked;
  std::array<std::vector<SkewFace>, 3> skew;            ///< in the order of rows
  std::array<std::vector<std::int32_t>, 3> skew_begin;  ///< as cut_begin
  std::array<std::vector<SkewNode>, 3> skew_node;
  WallPoints wall;
  long close_distances = 0;  ///< wall distances that were raised to k_min_distance
};

/// [s]
struct TimeInterval {
  double begin = 0.0;
  double end = 0.0;
};
/// `standing`: the geometry of the bodies that stand, if others move; cells far from the movers
/// take theirs from it.
Geometry build_geometry(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                        const FaceProperties& properties, TimeInterval interval,
                        const Geometry* static_geometry);
/// The geometry without the bodies that move.
Geometry build_static_geometry(const Grid& grid, const bodies::BodySet& bodies,
                               const SideKinds& sides, const FaceProperties& properties);
/// Share of the faces that fluid passes by itself: the open area, and nothing where a thin body
/// keeps the cells of a face apart. Faces 0 to count of each row.
FaceField passable_area(const Grid& grid, const Geometry& geometry);
/// Only the open fractions at `time`.
CellField open_fractions(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                         const FaceProperties& properties, double time,
                         const Geometry& static_geometry);

/// Least distance of a face's point from a surface along the grid, in cells: bounds the viscous
/// weight. The surface is met at a place wrong by at most this share of a cell.
inline constexpr double k_min_distance = 1e-3;

}  // namespace dust::fluid
