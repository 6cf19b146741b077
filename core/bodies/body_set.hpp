// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/placement.hpp"
#include "bodies/shape.hpp"
#include "dust/sdk/motion.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dust::bodies {

/// Points of a surface, and what is asked about them at one instant.
struct PointsOnSurface {
  std::size_t count = 0;
  sdk::VectorColumns position;  ///< [m]
  sdk::VectorColumns normal;    ///< [-] outward
};
struct SurfaceMotion {
  double time = 0.0;                   ///< [s]
  sdk::MutableVectorColumns velocity;  ///< [m/s] out
  /// [rad/s] out: angular velocity of the surface, also of a belt where it bends round a pulley.
  /// Null: not asked.
  sdk::MutableVectorColumns rotation;
};

/// A solid in the domain: shape, place, material and motion.
struct Body {
  std::string name;
  std::string group;
  int material = 0;
  std::unique_ptr<Shape> shape;
  /// Act one after the other on the body as the scenario puts it; none = at rest.
  std::vector<std::unique_ptr<sdk::Motion>> motions;
  sdk::Vec3 frame_origin;
  sdk::Vec3 frame_axis{0, 1, 0};
  double frame_angle = 0.0;
  /// [m] Farthest point of the surface from the axis of each motion that turns the body.
  std::vector<double> axis_distances;
  std::optional<scenario::SuctionSpec> suction;
  /// [s] When it was taken away.
  double removed_at = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_removed() const {
    return removed_at < std::numeric_limits<double>::infinity();
  }
  /// Whether the surface goes to other places with time. A drum that turns about its own axis does
  /// not: only its surface velocity counts.
  [[nodiscard]] bool displaces() const;
  [[nodiscard]] Placement placement(double time) const;
  /// Whether a motion carries or turns it, be it in its own place; if not, its placement is always
  /// the same.
  [[nodiscard]] bool is_carried() const;

  /// Nearest surface point in the domain's frame, as the scenario puts the body or at a placement.
  [[nodiscard]] SurfacePoint nearest(sdk::Vec3 point) const;
  [[nodiscard]] SurfacePoint nearest(sdk::Vec3 point, const Placement& at) const;
  /// Of a sphere at a placement, see Shape::nip_at.
  [[nodiscard]] std::string nip_at(sdk::Vec3 point, double radius, const Placement& at) const;
  /// The same for a part, see Shape::contact, touch, is_within and find_within.
  [[nodiscard]] SurfacePoint contact(int part, sdk::Vec3 point, double reach,
                                     const Placement& at) const;
  void touch(int part, const ClosestPoints& spheres, const Placement& at) const;
  [[nodiscard]] bool is_within(int part, sdk::Vec3 point, double reach, const Placement& at) const {
    return shape->is_within(part, at.to_body(point), reach);
  }
  void find_within(sdk::Vec3 point, double reach, const Placement& at,
                   std::vector<std::int32_t>& parts) const {
    shape->find_within(at.to_body(point), reach, parts);
  }
  /// Velocities [m/s] of surface points at batch.time; batch.axis is not read.
  void surface_velocities(const sdk::SurfaceBatch& batch) const;
  /// The same of a placement that is known, that at batch.time.
  void surface_velocities(const sdk::SurfaceBatch& batch, const Placement& at) const;
  /// How points of the surface move at instants of one placement.
  void find_motion(const PointsOnSurface& points, const Placement& at,
                   std::span<const SurfaceMotion> instants) const;
  /// Whether its surface ever turns, be it only round a pulley.
  [[nodiscard]] bool is_turning() const;
  /// The same at one point (for set-up and tests).
  [[nodiscard]] sdk::Vec3 surface_velocity(sdk::Vec3 point, sdk::Vec3 normal, double time) const;
  /// Upper bound [m/s] of the speed of any point of the surface at any time.
  [[nodiscard]] double largest_speed() const;
  /// Upper bound [m/s] of the speed at which the body's surface shifts to other places; 0 for
  /// bodies that stand, whatever their surface does.
  [[nodiscard]] double largest_displacing_speed() const;
  /// The surface where the scenario puts the body, or at a placement.
  [[nodiscard]] Triangles triangles(sdk::Vec3 min, sdk::Vec3 max, double edge) const;
  [[nodiscard]] Triangles triangles(sdk::Vec3 min, sdk::Vec3 max, double edge,
                                    const Placement& at) const;

 private:
  void add_in_blocks(const PointsOnSurface& points, const Placement& at,
                     std::span<const SurfaceMotion> instants) const;
  void find_bends(const sdk::SurfaceBatch& block, const Placement& at, double* const* bend) const;
  void add_at_point(const PointsOnSurface& points, std::size_t q, const Placement& at,
                    std::span<const SurfaceMotion> instants) const;
  void add_along_surface(sdk::SurfaceBatch block, std::size_t first, double factor,
                         const double* const* bend, std::span<const SurfaceMotion> instants) const;
};

using BodySet = std::vector<Body>;

/// [m] Length of the pieces that curved surfaces are written in: a share of the domain's diagonal,
/// about 2 mm where the domain is half a metre, finer than the eye tells from round.
[[nodiscard]] double written_edge(sdk::Vec3 min, sdk::Vec3 max);

/// Makes the body of a specification; the caller supplies the motions.
Body make_body(const scenario::Setup& setup, const scenario::BodySpec& spec,
               std::vector<std::unique_ptr<sdk::Motion>> motions);
Body make_body(const scenario::Setup& setup, const scenario::BodySpec& spec,
               std::unique_ptr<sdk::Motion> motion);
/// Whether any of a scenario's bodies goes to other places or is taken away: then surfaces are
/// written with each frame.
[[nodiscard]] bool do_surfaces_change(const scenario::Setup& setup, const BodySet& bodies);

}  // namespace dust::bodies
