// SPDX-License-Identifier: Apache-2.0
#include "bodies/body_set.hpp"

#include <algorithm>
#include <stdexcept>

namespace dust::bodies {

using sdk::Vec3;

SurfacePoint Body::nearest(Vec3 point) const {
  if (frame_angle == 0.0) return shape->nearest(point);
  const Vec3 local = frame_origin + rotate(point - frame_origin, frame_axis, -frame_angle);
  SurfacePoint s = shape->nearest(local);
  s.normal = rotate(s.normal, frame_axis, frame_angle);
  return s;
}

Vec3 Body::lateral_axis() const { return rotate(shape->lateral_axis(), frame_axis, frame_angle); }

Vec3 Body::surface_velocity(Vec3 point, Vec3 normal, double time) const {
  Vec3 v;
  if (!motion) return v;
  sdk::SurfaceBatch batch{.count = 1,
                          .time = time,
                          .axis = lateral_axis(),
                          .x = &point.x,
                          .y = &point.y,
                          .z = &point.z,
                          .normal_x = &normal.x,
                          .normal_y = &normal.y,
                          .normal_z = &normal.z,
                          .velocity_x = &v.x,
                          .velocity_y = &v.y,
                          .velocity_z = &v.z};
  motion->surface_velocity(batch);
  return v;
}

Triangles Body::triangles(Vec3 min, Vec3 max, double edge) const {
  // The shape clips in its own frame: give it a box that holds the domain in any orientation.
  Triangles t = shape->triangles(min, max, edge);
  for (Vec3& p : t) p = frame_origin + rotate(p - frame_origin, frame_axis, frame_angle);
  return t;
}

Body make_body(const scenario::Setup& setup, const scenario::BodySpec& spec,
               std::unique_ptr<sdk::Motion> motion) {
  Body body;
  body.name = spec.name;
  body.material = spec.material;
  body.motion = std::move(motion);
  const auto& catalogue = shape_catalogue();
  const auto kind = std::find_if(catalogue.begin(), catalogue.end(),
                                 [&](const ShapeKind& k) { return k.name == spec.shape.name; });
  if (kind == catalogue.end()) throw std::logic_error("unknown shape " + spec.shape.name);
  body.shape = kind->make(spec.shape.values);
  if (spec.frame >= 0) {
    const auto& frame = setup.frames.at(static_cast<std::size_t>(spec.frame));
    body.frame_origin = frame.origin;
    body.frame_axis = frame.axis / norm(frame.axis);
    body.frame_angle = frame.angle;
  }
  return body;
}

}  // namespace dust::bodies
