// SPDX-License-Identifier: Apache-2.0
#include "bodies/revolved.hpp"

#include "bodies/shape_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dust::bodies {

using sdk::Vec3;

Revolved::Revolved(Vec3 base, Vec3 axis, std::vector<ProfilePoint> profile)
    : base_(base), axis_(axis), side_(perpendicular(axis)) {
  for (std::size_t n = 0; n < profile.size(); ++n) {
    const ProfilePoint a = profile[n];
    const ProfilePoint b = profile[(n + 1) % profile.size()];
    const double length = std::hypot(b.r - a.r, b.z - a.z);
    if (length == 0.0) continue;
    edges_.push_back(
        {a, b, (b.r - a.r) / length, (b.z - a.z) / length, length, !(a.r == 0.0 && b.r == 0.0)});
  }
}

Revolved::Place Revolved::place_of(Vec3 point) const {
  const Vec3 q = point - base_;
  Place place;
  place.z = dot(q, axis_);
  place.across = q - place.z * axis_;
  place.r = norm(place.across);
  place.outward = place.r > 0.0 ? place.across / place.r : side_;
  return place;
}

SurfacePoint Revolved::nearest(Vec3 point) const {
  const Place place = place_of(point);
  const Foot foot = foot_of(place.r, place.z);
  return {foot.distance, foot.normal_r * place.outward + foot.normal_z * axis_};
}

Revolved::Foot Revolved::foot_of(double r, double z) const {
  // Inside: the edge least deep. Outside: the nearest point of all edges.
  double deepest = -std::numeric_limits<double>::infinity();
  double nearest2 = std::numeric_limits<double>::infinity();
  const Edge* face = nullptr;
  double off_r = 0.0;
  double off_z = 0.0;
  bool is_inside = true;
  const ProfilePoint* corner = nullptr;
  for (const Edge& e : edges_) {
    const double dr = r - e.from.r;
    const double dz = z - e.from.z;
    const double height = dr * e.along_z - dz * e.along_r;  // the inside is on the left
    if (!e.is_surface) continue;
    is_inside = is_inside && height <= 0.0;
    if (height <= 0.0) {
      if (height > deepest) {
        deepest = height;
        if (is_inside) face = &e;
      }
      continue;
    }
    const double s = dr * e.along_r + dz * e.along_z;
    const double t = std::clamp(s, 0.0, e.length);
    const double a = dr - t * e.along_r;
    const double b = dz - t * e.along_z;
    const double d2 = a * a + b * b;
    if (d2 >= nearest2) continue;
    nearest2 = d2;
    off_r = a, off_z = b;
    face = &e;
    corner = s == t ? nullptr : (s < t ? &e.from : &e.to);
  }
  if (is_inside || corner == nullptr) {
    // On a face the normal is the face's own, to the last bit.
    const double distance =
        is_inside ? deepest
                  : (r - face->from.r) * face->along_z - (z - face->from.z) * face->along_r;
    return {distance, face->along_z, -face->along_r, face, nullptr};
  }
  const double d = std::sqrt(nearest2);
  return {d, off_r / d, off_z / d, face, corner};
}

void Revolved::touch(int part, const ClosestPoints& spheres) const {
  for (std::size_t n = 0; n < spheres.count; ++n) {
    const Vec3 centre{spheres.x[n], spheres.y[n], spheres.z[n]};
    spheres.put(n, faces_.empty() ? Revolved::nearest(centre)
                                  : Revolved::contact(part, centre, spheres.reach[n]));
  }
}

bool Revolved::is_unchanged_by_turning(Vec3 point, Vec3 axis) const {
  if (!faces_.empty()) return false;
  const Vec3 off = point - base_;
  const Vec3 across = off - dot(off, axis_) * axis_;
  double largest = 0.0;
  for (const Edge& e : edges_) largest = std::max(largest, e.from.r);
  constexpr double k_rounding = 1e-9;
  return norm(cross(axis, axis_)) < k_rounding && norm(across) < k_rounding * largest;
}

void Revolved::find_bends(std::size_t count, const double* const* point,
                          double* const* bend) const {
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3 q = Vec3{point[0][n], point[1][n], point[2][n]} - base_;
    const Vec3 arm = q - dot(q, axis_) * axis_;
    const double by = 1.0 / std::max(dot(arm, arm), 1e-300);
    for (int d = 0; d < 3; ++d) bend[d][n] = by * arm[d];
  }
}

Triangles Revolved::triangles(Vec3, Vec3, double edge) const {
  double largest = 0.0;
  for (const Edge& e : edges_) largest = std::max(largest, e.from.r);
  const int pieces = std::clamp(
      static_cast<int>(std::ceil(2.0 * std::numbers::pi * largest / std::max(edge, 1e-9))), 24,
      360);
  const Vec3 other = cross(axis_, side_);
  const auto place = [&](double r, double z, int n) {
    const double a = 2.0 * std::numbers::pi * (n % pieces) / pieces;
    return base_ + z * axis_ + r * (std::cos(a) * side_ + std::sin(a) * other);
  };
  Triangles t;
  for (const Edge& e : edges_) {
    if (!e.is_surface) continue;
    const double r0 = e.from.r;
    const double z0 = e.from.z;
    const double r1 = e.to.r;
    const double z1 = e.to.z;
    for (int n = 0; n < pieces; ++n) {
      const Vec3 a = place(r0, z0, n);
      const Vec3 b = place(r0, z0, n + 1);
      const Vec3 c = place(r1, z1, n + 1);
      const Vec3 d = place(r1, z1, n);
      if (r0 > 0.0) t.insert(t.end(), {a, b, c});
      if (r1 > 0.0) t.insert(t.end(), {a, c, d});
    }
  }
  return t;
}

}  // namespace dust::bodies
