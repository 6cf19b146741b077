// SPDX-License-Identifier: Apache-2.0
#include "bodies/revolved.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

/// The inside of a hole as flat faces, for spheres that are wider than it.
namespace dust::bodies {
namespace {

using sdk::Vec3;

constexpr SurfacePoint k_none{std::numeric_limits<double>::infinity(), {0, 0, 1}};
constexpr int k_faces = 24;  ///< folds of 15 degrees
/// Of a face, over its distance from the axis.
const double k_half_width = std::tan(std::numbers::pi / k_faces);

}  // namespace

void Revolved::expect_spheres(double largest_radius) {
  faces_.clear();
  const auto wall =
      std::find_if(edges_.begin(), edges_.end(), [](const Edge& e) { return e.is_of_hole(); });
  if (wall == edges_.end()) return;
  hole_min_ = std::min(wall->from.r, wall->to.r);
  hole_max_ = std::max(wall->from.r, wall->to.r);
  if (!(largest_radius > hole_min_)) return;
  for (int n = 0; n < k_faces; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / k_faces;
    const Vec3 direction = std::cos(angle) * side_ + std::sin(angle) * cross(axis_, side_);
    faces_.push_back({direction, cross(axis_, direction)});
  }
}

/// Where the nearest point is on the wall of the hole or on its rim.
bool Revolved::is_in_hole(const Foot& foot) const {
  if (foot.edge->is_of_hole()) return true;
  if (foot.corner == nullptr) return false;
  const auto is_corner = [&](ProfilePoint p) {
    return p.r == foot.corner->r && p.z == foot.corner->z;
  };
  return std::any_of(edges_.begin(), edges_.end(), [&](const Edge& e) {
    return e.is_of_hole() && (is_corner(e.from) || is_corner(e.to));
  });
}

/// A face touches the circle in its middle. The sphere touches it where it is nearest, if that is
/// between the folds to the next faces.
SurfacePoint Revolved::contact_of_face(const Face& face, const Place& place) const {
  const double along = dot(place.across, face.direction);
  const double aside = dot(place.across, face.sideways);
  const Foot foot = foot_of(along, place.z);
  if (!is_in_hole(foot)) return k_none;
  const double r = along - foot.distance * foot.normal_r;
  if (std::abs(aside) > k_half_width * r) return k_none;
  return {foot.distance, foot.normal_r * face.direction + foot.normal_z * axis_};
}

SurfacePoint Revolved::contact(int part, Vec3 point, double) const {
  if (faces_.empty()) return nearest(point);
  const Place place = place_of(point);
  const Foot foot = foot_of(place.r, place.z);
  const bool is_of_faces = is_in_hole(foot);
  if (part > 0) return is_of_faces ? contact_of_face(face_of(part), place) : k_none;
  if (is_of_faces) return k_none;
  return {foot.distance, foot.normal_r * place.outward + foot.normal_z * axis_};
}

bool Revolved::is_within(int part, Vec3 point, double reach) const {
  if (!(nearest(point).distance < reach)) return false;
  if (part == 0) return true;
  const Place place = place_of(point);
  const Face& face = face_of(part);
  return hole_min_ - dot(place.across, face.direction) < reach &&
         std::abs(dot(place.across, face.sideways)) - k_half_width * hole_max_ < reach;
}

}  // namespace dust::bodies
