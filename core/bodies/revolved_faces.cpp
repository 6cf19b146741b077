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

}  // namespace

void Revolved::expect_spheres(double largest_radius) {
  has_faces_ = false;
  for (const Edge& e : edges_) {
    if (!e.is_of_hole()) continue;
    hole_min_ = std::min(e.from.r, e.to.r);
    hole_max_ = std::max(e.from.r, e.to.r);
    has_faces_ = largest_radius > hole_min_;
  }
}

/// Where the nearest point is on the wall of the hole or on its rim.
bool Revolved::is_in_hole(const Foot& foot, double r, double z) const {
  if (foot.edge->is_of_hole()) return true;
  if (!foot.is_corner) return false;
  const ProfilePoint corner{r - foot.distance * foot.normal_r, z - foot.distance * foot.normal_z};
  const double near = 1e-9 * hole_max_;
  const auto is_at = [&](ProfilePoint p) {
    return std::abs(p.r - corner.r) <= near && std::abs(p.z - corner.z) <= near;
  };
  return std::any_of(edges_.begin(), edges_.end(), [&](const Edge& e) {
    return e.is_of_hole() && (is_at(e.from) || is_at(e.to));
  });
}

Vec3 Revolved::face_direction(int face) const {
  const double angle = 2.0 * std::numbers::pi * face / k_faces;
  return std::cos(angle) * side_ + std::sin(angle) * cross(axis_, side_);
}

/// A face touches the circle in its middle. The sphere touches it where it is nearest, if that is
/// between the folds to the next faces.
SurfacePoint Revolved::contact_of_face(int face, const Place& place) const {
  const Vec3 direction = face_direction(face);
  const double along = dot(place.across, direction);
  const double aside = dot(place.across, cross(axis_, direction));
  const Foot foot = foot_of(along, place.z);
  if (!is_in_hole(foot, along, place.z)) return k_none;
  const double r = along - foot.distance * foot.normal_r;
  if (std::abs(aside) > r * std::tan(std::numbers::pi / k_faces)) return k_none;
  return {foot.distance, foot.normal_r * direction + foot.normal_z * axis_};
}

SurfacePoint Revolved::contact(int part, Vec3 point, double) const {
  if (!has_faces_) return nearest(point);
  const Place place = place_of(point);
  const Foot foot = foot_of(place.r, place.z);
  const bool is_of_faces = is_in_hole(foot, place.r, place.z);
  if (part > 0) return is_of_faces ? contact_of_face(part - 1, place) : k_none;
  if (is_of_faces) return k_none;
  return {foot.distance, foot.normal_r * place.outward + foot.normal_z * axis_};
}

bool Revolved::is_within(int part, Vec3 point, double reach) const {
  if (!(nearest(point).distance < reach)) return false;
  if (part == 0) return true;
  const Place place = place_of(point);
  const Vec3 direction = face_direction(part - 1);
  const double half_width = hole_max_ * std::tan(std::numbers::pi / k_faces);
  return hole_min_ - dot(place.across, direction) < reach &&
         std::abs(dot(place.across, cross(axis_, direction))) - half_width < reach;
}

}  // namespace dust::bodies
