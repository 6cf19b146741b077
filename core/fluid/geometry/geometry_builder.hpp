// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/body_field.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/geometry/skew_stencils.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace dust::fluid {

/// Makes a Geometry. geometry_builder.cpp: what is open, which faces hold unknowns.
/// wall_stencils.cpp: the faces next to surfaces and their images.
class GeometryBuilder {
 public:
  GeometryBuilder(const Grid& grid, const bodies::BodySet& bodies, const SideKinds& sides,
                  const FaceProperties& properties, TimeInterval interval,
                  const Geometry* static_geometry, BodyField::Which which);

  Geometry build();
  void measure_cells();
  CellField take_open_fraction() { return std::move(g_.open_fraction); }

 private:
  using Hit = BodyField::Hit;
  using Vec3 = sdk::Vec3;
  /// Instants at which the shares of faces next to bodies that move are measured, per interval.
  static constexpr int k_instants = 8;

  [[nodiscard]] Hit nearest(Vec3 p) const { return field_.nearest(p); }
  [[nodiscard]] bool is_inside(Vec3 p) const { return field_.is_inside(p); }
  [[nodiscard]] double wall_distance(Vec3 from, Vec3 to) const {
    return field_.wall_distance(from, to);
  }
  /// Are the movers so far that what lies within `reach` of the point is as without them?
  [[nodiscard]] bool is_as_static(const BodyField& field, Vec3 p, double reach) const {
    return static_geometry_ != nullptr && field.is_far_from_moving_bodies(p, reach);
  }
  void measure_faces(int d);
  /// Is a surface so near to the face's cells that something may lie between them?
  [[nodiscard]] bool is_near(int d, const std::array<int, 3>& c, std::ptrdiff_t o) const;
  /// From a face towards its neighbour: what lies between them.
  struct Neighbour {
    sdk::Vec3 from, there;
    bool is_solid = false;       ///< the neighbour is in a body
    std::optional<double> thin;  ///< [m] to a body thinner than the way
    [[nodiscard]] bool is_wall() const { return is_solid || thin.has_value(); }
  };
  struct LookAt {
    bool is_closed = false;       ///< the neighbour
    bool may_be_blocked = false;  ///< by a thin body
    bool is_at_end = false;       ///< the neighbour is beyond a periodic side
  };
  [[nodiscard]] Neighbour look(sdk::Vec3 from, int dir, int side, LookAt at) const;
  /// Cells whose points in the fluid have a thin body between them have nothing to do with each
  /// other. A way through the grid from one side of the body to the other crosses it somewhere, and
  /// there it meets such a face: nothing leaks.
  void find_blocked(int d);
  bool add_blocked(int d, const std::array<int, 3>& c, Vec3 lower, Vec3 upper);
  [[nodiscard]] BlockedFace blocked_face(int d, const std::array<int, 3>& c, Vec3 from, Vec3 to,
                                         double way) const;
  void find_unknowns(int d);
  std::int32_t add_wall_point(Vec3 near) {
    const Hit hit = nearest(near);
    points_.push_back({near - hit.distance * hit.normal, hit.normal, hit.body});
    return static_cast<std::int32_t>(points_.size() - 1);
  }
  void find_cut(int d);
  /// Fills the two weights of one direction; true if they differ from the plain stencil's.
  bool stencil(int d, int dir, const std::array<int, 3>& c, std::ptrdiff_t o, CutFace& face);
  /// What a face's stencil meets on one side of it along one direction.
  struct StencilSide {
    double distance;       ///< [m]
    double share = 1.0;    ///< of the stress, where the viscosity jumps
    bool is_wall = false;  ///< a body's surface
    bool is_free = false;  ///< nothing that holds the fluid
  };
  static void set_weights(const std::array<StencilSide, 2>& sides, double h, int dir,
                          CutFace& face);
  bool meet_boundary(int d, int dir, int side, double h, CutFace& face, StencilSide& here) const;
  void find_open_parts(int d);
  [[nodiscard]] bool has_fixed(int d, int dir) const {
    return ghost_rule(sides_, d, dir, 0) == GhostRule::fixed ||
           ghost_rule(sides_, d, dir, 1) == GhostRule::fixed;
  }
  [[nodiscard]] std::ptrdiff_t wrapped(std::ptrdiff_t o, int dir, int c, int step) const;
  void find_ghosts(int d);
  /// The image lies on the normal through the ghost, as far outside that it needs fluid faces only.
  void find_image(int d, Vec3 p, const Hit& hit, double depth, double scale,
                  GhostFace& ghost) const;
  /// Trilinear weights of component `d` at `p`; false if a face inside a body carries weight.
  bool interpolation(int d, Vec3 p, GhostFace& ghost) const;
  void sort_wall_points();

  const Grid& grid_;
  const bodies::BodySet& bodies_;
  const SideKinds& sides_;
  const FaceProperties& properties_;
  const Geometry* static_geometry_;
  BodyField field_;                                  ///< at the end of the interval
  std::vector<BodyField> instants_;                  ///< if bodies move
  double smear_ = 0.0;                               ///< [s]
  double near_ = 0.0;                                ///< [m]
  CellField distance_;                               ///< [m] of cell centres; empty without bodies
  std::array<std::vector<std::uint8_t>, 3> closed_;  ///< 1 in a body at the end, 2 blocked
  Geometry g_;
  std::vector<SurfacePoint> points_;
};

}  // namespace dust::fluid
