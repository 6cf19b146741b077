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
class Revolved : public OnePart<Revolved> {
 public:
  Revolved(sdk::Vec3 base, sdk::Vec3 axis, std::vector<ProfilePoint> profile);

  [[nodiscard]] SurfacePoint nearest(sdk::Vec3 point) const override;
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
  };

  sdk::Vec3 base_;
  sdk::Vec3 axis_;
  sdk::Vec3 side_;  ///< unit vector across, where a point on the axis needs one
  std::vector<Edge> edges_;
};

}  // namespace dust::bodies
