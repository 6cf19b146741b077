// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/abutting.hpp"
#include "setup/setup.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dust::particles {

/// A side of the domain that is a wall, or a part of a body. Grains touch it once.
struct Surface {
  std::string name;
  int material = 0;
  int wall = 0;                        ///< number of the side or body among all that are surfaces
  const bodies::Body* body = nullptr;  ///< null: the plane below
  int part = 0;                        ///< of the body's shape
  sdk::Vec3 normal;                    ///< into the domain
  double offset = 0.0;                 ///< [m] dot(normal, point of the plane)
  bodies::Placement place;             ///< of the body, at the time of the last move_to()
  bool is_carried = false;             ///< the body's placement is not always the same
  bool is_turning = false;             ///< it turns, be it only where a belt bends
  double displacing_speed = 0.0;       ///< [m/s] upper bound; 0 = stands
  int opening = -1;                    ///< number of the opening in it; -1 = none
  /// Bodies that the surface's own one touches; null: none.
  std::shared_ptr<const AbuttingBodies> abutting;

  [[nodiscard]] bool is_displaced() const { return displacing_speed > 0.0; }
  /// A point of the domain in the frame that openings are given in, as the surface stood at the
  /// last move_to().
  [[nodiscard]] sdk::Vec3 in_own_frame(sdk::Vec3 point) const {
    return body != nullptr ? place.to_body(point) : point;
  }
  [[nodiscard]] bool is_removed() const { return body != nullptr && body->is_removed(); }

  /// Where a sphere touches it: infinitely far where it cannot, be it that an abutting body
  /// touches the sphere there, or where nothing is nearer than `reach` [m] to its centre.
  [[nodiscard]] bodies::SurfacePoint contact(
      sdk::Vec3 point, double reach = std::numeric_limits<double>::infinity()) const {
    if (body == nullptr) return {dot(normal, point) - offset, normal};
    bodies::SurfacePoint near = body->contact(part, point, reach, place);
    if (abutting != nullptr) leave_to_abutting(point, reach, near);
    return near;
  }
  /// The nearest point of its body, whichever part of it or abutting body touches a sphere there:
  /// for predictions, in whose time a sphere may pass from one to another, and for places in a
  /// body, however deep.
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 point) const {
    if (body == nullptr) return {dot(normal, point) - offset, normal};
    return body->nearest(point, place);
  }
  [[nodiscard]] bodies::SurfacePoint nearest_at(double time, sdk::Vec3 point) const {
    if (!is_displaced()) return nearest(point);
    return body->nearest(point, body->placement(time));
  }
  /// Whether it stands for its wall where all parts of that are asked for at once.
  [[nodiscard]] bool is_first_part() const { return part == 0; }
  /// The contacts of many spheres.
  void touch(const bodies::ClosestPoints& spheres) const {
    if (body != nullptr) {
      body->touch(part, spheres, place);
      if (abutting != nullptr) leave_to_abutting(spheres);
      return;
    }
    for (std::size_t n = 0; n < spheres.count; ++n) {
      spheres.put(n, {dot(normal, {spheres.x[n], spheres.y[n], spheres.z[n]}) - offset, normal});
    }
  }
  /// The same at another time [s] than that of the last move_to().
  [[nodiscard]] bodies::SurfacePoint contact_at(
      double time, sdk::Vec3 point, double reach = std::numeric_limits<double>::infinity()) const {
    if (!is_displaced()) return contact(point, reach);
    return body->contact(part, point, reach, body->placement(time));
  }
  /// Whether a sphere that moves by at most `reach` [m], its radius included, may touch the surface
  /// within `duration` [s] after the last move_to(), however the surface moves.
  [[nodiscard]] bool may_touch(sdk::Vec3 point, double reach, double duration) const {
    if (is_removed()) return false;
    reach += displacing_speed * duration;
    if (body != nullptr) return body->is_within(part, point, reach, place);
    return dot(normal, point) - offset < reach;
  }
  /// Numbers of the parts of its body of which that holds, ascending.
  void find_touchable_parts(sdk::Vec3 point, double reach, double duration,
                            std::vector<std::int32_t>& parts) const {
    parts.clear();
    if (is_removed()) return;
    body->find_within(point, reach + displacing_speed * duration, place, parts);
  }

 private:
  void leave_to_abutting(sdk::Vec3 point, double reach, bodies::SurfacePoint& near) const;
  void leave_to_abutting(const bodies::ClosestPoints& spheres) const;
};

/// Puts bodies that move to their place at `time` [s].
void move_to(double time, std::span<Surface> surfaces);

/// The surfaces where they stand at `time` [s]: where some move, copies in `moved`.
std::span<const Surface> surfaces_at(double time, std::span<const Surface> surfaces,
                                     std::vector<Surface>& moved);

std::vector<Surface> surfaces_of(const scenario::Setup& setup, const bodies::BodySet& bodies);

/// How points of the surface move at two times. Rotations are asked for of both or of neither.
void find_motion(const Surface& surface, const bodies::PointsOnSurface& points,
                 const bodies::SurfaceMotion& now, const bodies::SurfaceMotion& earlier);

}  // namespace dust::particles
