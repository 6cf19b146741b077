// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"

#include <vector>

namespace dust::bodies {

/// A point of the profile of a solid of revolution.
struct ProfilePoint {
  double r = 0.0;  ///< [m] distance from the axis
  double z = 0.0;  ///< [m] along the axis
};

/// The solid that a convex profile sweeps out round an axis. The profile is a polygon with its
/// inside on the left; edges on the axis itself are no surface. The nearest point of the solid lies
/// in the half-plane of the axis and the point, so the distance is that to the polygon: exact, also
/// at the rims.
///
/// A sphere wider than a hole lies on it all round, where no one point is nearest for long: the
/// nearest jumps from side to side as the sphere's centre crosses the axis. For a run with such
/// spheres the inside of the hole is 24 flat faces, each of which a sphere touches by itself.
class Revolved : public Shape {
 public:
  Revolved(sdk::Vec3 base, sdk::Vec3 axis, std::vector<ProfilePoint> profile);

  [[nodiscard]] SurfacePoint nearest(sdk::Vec3 point) const override;
  void expect_spheres(double largest_radius) override;
  [[nodiscard]] int parts() const override { return 1 + static_cast<int>(faces_.size()); }
  [[nodiscard]] SurfacePoint contact(int part, sdk::Vec3 point, double reach) const override;
  void touch(int part, const ClosestPoints& spheres) const override;
  [[nodiscard]] bool is_within(int part, sdk::Vec3 point, double reach) const override;
  /// The axis itself: `motion: belt` turns the surface about it.
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return axis_; }
  [[nodiscard]] bool is_bent() const override { return true; }
  void find_bends(std::size_t count, const double* const* point,
                  double* const* bend) const override;
  [[nodiscard]] Triangles triangles(sdk::Vec3 min, sdk::Vec3 max, double edge) const override;
  [[nodiscard]] bool is_unchanged_by_turning(sdk::Vec3 point, sdk::Vec3 axis) const override;

 private:
  struct Edge {
    ProfilePoint from, to;
    double along_r = 0.0, along_z = 0.0;  ///< unit vector
    double length = 0.0;
    bool is_surface = true;

    /// Whether it looks at the axis across a hole.
    [[nodiscard]] bool is_of_hole() const { return is_surface && along_z < 0.0; }
  };
  /// A point in cylindrical coordinates, and the unit vector from the axis towards it.
  struct Place {
    sdk::Vec3 across;  ///< [m] from the axis
    sdk::Vec3 outward;
    double r = 0.0, z = 0.0;  ///< [m]
  };
  /// The point of the profile nearest to another in the half-plane.
  struct Foot {
    double distance = 0.0;                  ///< [m] negative inside
    double normal_r = 0.0, normal_z = 0.0;  ///< [-]
    const Edge* edge = nullptr;
    const ProfilePoint* corner = nullptr;  ///< an end of the edge; null on its face
  };
  [[nodiscard]] Place place_of(sdk::Vec3 point) const;
  [[nodiscard]] Foot foot_of(double r, double z) const;
  [[nodiscard]] bool is_in_hole(const Foot& foot) const;
  /// A flat face of the hole.
  struct Face {
    sdk::Vec3 direction;  ///< unit, from the axis to its middle
    sdk::Vec3 sideways;   ///< unit, along its width
  };
  [[nodiscard]] const Face& face_of(int part) const {
    return faces_[static_cast<std::size_t>(part) - 1];
  }
  [[nodiscard]] SurfacePoint contact_of_face(const Face& face, const Place& place) const;

  sdk::Vec3 base_;
  sdk::Vec3 axis_;
  sdk::Vec3 side_;  ///< unit vector across, where a point on the axis needs one
  std::vector<Edge> edges_;
  std::vector<Face> faces_;                 ///< none where no sphere is wider than the hole
  double hole_min_ = 0.0, hole_max_ = 0.0;  ///< [m] radii of the hole; 0 = none
};

}  // namespace dust::bodies
