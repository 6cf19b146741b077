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
enum class Beyond { fixed, gradient, periodic };

/// What geometry and viscous stencils need to know of the six sides.
struct SideKinds {
  std::array<sdk::SideRules, 6> rules;
  std::array<bool, 3> is_periodic{false, false, false};

  [[nodiscard]] Beyond beyond(int component, int direction, int is_high) const {
    if (is_periodic[direction]) return Beyond::periodic;
    const auto& r = rules[2 * direction + is_high];
    const auto rule = component == direction ? r.normal_velocity : r.tangential_velocity;
    return rule == sdk::SideRule::fixed ? Beyond::fixed : Beyond::gradient;
  }
  /// Is the velocity through this side an unknown, driven by a pressure given outside?
  [[nodiscard]] bool is_pressure_side(int direction, int is_high) const {
    return !is_periodic[direction] &&
           rules[2 * direction + is_high].normal_velocity != sdk::SideRule::fixed;
  }
};

/// Points of bodies' surfaces at which the fluid needs the surface velocity, grouped by body.
struct WallPoints {
  std::vector<double> x, y, z, normal_x, normal_y, normal_z;
  std::array<std::vector<double>, 3> velocity;
  std::vector<std::size_t> body_begin;  ///< first point of each body, and the end

  void evaluate(const bodies::BodySet& bodies, double time);
};

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
/// fluid.
struct GhostFace {
  std::int32_t at = 0;
  std::int32_t wall_point = 0;
  double factor = 0.0;  ///< 0 deep inside
  bool is_crossed =
      false;  ///< part of the face is open: fluid passes, continuity has the last word
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

/// given: on a side with given velocity, or outside the domain; plain: unknown with the plain
/// stencil; cut: unknown, stencil in the list `cut`; inside: in a body, in the list `ghost`.
enum class FaceKind : std::uint8_t { given, plain, cut, inside };

inline bool is_unknown(FaceKind k) { return k == FaceKind::plain || k == FaceKind::cut; }

/// What the bodies and the sides make of the grid. Built once: bodies do not move.
struct Geometry {
  CellField open_fraction;  ///< share of the cell outside bodies
  FaceField open_area;      ///< share of the face outside bodies
  std::array<std::vector<FaceKind>, 3> kind;
  std::array<std::array<int, 3>, 3> extent;  ///< faces per component and direction
  /// Components without unknowns (across a thin domain between walls) cost nothing.
  std::array<bool, 3> has_unknown{false, false, false};
  std::array<std::vector<CutFace>, 3> cut;             ///< in the order of rows
  std::array<std::vector<std::int32_t>, 3> cut_begin;  ///< per row (j + extent_y k), and the end
  std::array<std::vector<GhostFace>, 3> ghost;
  std::array<std::vector<OpenPart>, 3> open_part;
  WallPoints wall;
  long close_distances = 0;  ///< wall distances that were raised to k_least_distance

  static Geometry build(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                        const FaceProperties& properties);
};

/// Least distance of a face's point from a surface along the grid, in cells: bounds the viscous
/// weight. The surface is met at a place wrong by at most this share of a cell.
inline constexpr double k_least_distance = 1e-3;

}  // namespace dust::fluid
