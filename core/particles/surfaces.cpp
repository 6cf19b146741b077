// SPDX-License-Identifier: Apache-2.0
#include "particles/surfaces.hpp"

#include <algorithm>

namespace dust::particles {

/// A contact that an abutting body has instead is infinitely far.
void Surface::leave_to_abutting(sdk::Vec3 point, double reach, bodies::SurfacePoint& near) const {
  if (!(near.distance < reach)) return;
  for (const AbuttingBody& other : *abutting) {
    if (!other.takes_over(point, reach, near)) continue;
    near.distance = std::numeric_limits<double>::infinity();
    return;
  }
}

void Surface::leave_to_abutting(const bodies::ClosestPoints& spheres) const {
  for (std::size_t n = 0; n < spheres.count; ++n) {
    bodies::SurfacePoint near{spheres.distance[n],
                              {spheres.normal_x[n], spheres.normal_y[n], spheres.normal_z[n]}};
    leave_to_abutting({spheres.x[n], spheres.y[n], spheres.z[n]}, spheres.reach[n], near);
    spheres.distance[n] = near.distance;
  }
}

void move_to(double time, std::span<Surface> surfaces) {
  const Surface* before = nullptr;
  for (Surface& s : surfaces) {
    if (s.is_displaced()) {
      const bool is_next_part = before != nullptr && before->body == s.body;
      s.place = is_next_part ? before->place : s.body->placement(time);
    }
    before = &s;
  }
}

std::span<const Surface> surfaces_at(double time, std::span<const Surface> surfaces,
                                     std::vector<Surface>& moved) {
  const auto is_displaced = [](const Surface& s) { return s.is_displaced(); };
  if (std::none_of(surfaces.begin(), surfaces.end(), is_displaced)) return surfaces;
  moved.assign(surfaces.begin(), surfaces.end());
  move_to(time, moved);
  return moved;
}

std::vector<Surface> surfaces_of(const scenario::Setup& setup, const bodies::BodySet& bodies) {
  std::vector<Surface> out;
  int walls = 0;
  for (int side = 0; side < 6; ++side) {
    const auto& spec = setup.domain.sides[static_cast<std::size_t>(side)];
    if (spec.grains != scenario::GrainSide::wall) continue;
    Surface s;
    s.name = scenario::k_side_names[static_cast<std::size_t>(side)];
    s.material = spec.material;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    s.normal[side / 2] = sign;
    s.offset = sign * (side % 2 == 0 ? setup.domain.min : setup.domain.max)[side / 2];
    s.wall = walls++;
    out.push_back(s);
  }
  for (const auto& body : bodies) {
    Surface s;
    s.name = body.name;
    s.material = body.material;
    s.body = &body;
    s.displacing_speed = body.largest_displacing_speed();
    s.place = body.placement(0.0);
    s.is_carried = body.is_carried();
    s.is_turning = body.is_turning();
    s.wall = walls++;
    for (s.part = 0; s.part < body.shape->parts(); ++s.part) out.push_back(s);
  }
  return out;
}

void find_motion(const Surface& surface, const bodies::PointsOnSurface& points,
                 const bodies::SurfaceMotion& now, const bodies::SurfaceMotion& earlier) {
  const bodies::SurfaceMotion both[] = {now, earlier};
  if (surface.body == nullptr) {
    for (const auto& instant : both) {
      for (const auto& columns : {instant.velocity, instant.rotation}) {
        if (columns.x == nullptr) continue;
        for (double* column : {columns.x, columns.y, columns.z}) {
          std::fill_n(column, points.count, 0.0);
        }
      }
    }
    return;
  }
  const bodies::Body& body = *surface.body;
  if (!surface.is_carried) {
    body.find_motion(points, surface.place, both);
    return;
  }
  for (const auto& instant : both) {
    body.find_motion(points, body.placement(instant.time), {&instant, 1});
  }
}

}  // namespace dust::particles
