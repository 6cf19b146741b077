// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/motion.hpp"
#include "dust/sdk/vec3.hpp"

namespace dust::bodies {

/// Where a rigid body is at one instant and how it moves: \f$ x = M x_0 + b \f$,
/// \f$ v(x) = a + \Omega \times x \f$.
struct Placement {
  sdk::Vec3 column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< of M
  sdk::Vec3 shift;                                          ///< [m] b
  sdk::Vec3 velocity;                                       ///< [m/s] a, at the origin
  sdk::Vec3 spin;                                           ///< [rad/s] Omega
  bool is_turned = false;                                   ///< M is not the unit matrix

  [[nodiscard]] sdk::Vec3 turn(sdk::Vec3 v) const {
    return is_turned ? v.x * column[0] + v.y * column[1] + v.z * column[2] : v;
  }
  [[nodiscard]] sdk::Vec3 to_domain(sdk::Vec3 x) const { return turn(x) + shift; }
  [[nodiscard]] sdk::Vec3 to_body(sdk::Vec3 x) const {
    const sdk::Vec3 q = x - shift;
    return is_turned ? sdk::Vec3{dot(q, column[0]), dot(q, column[1]), dot(q, column[2])} : q;
  }
  [[nodiscard]] sdk::Vec3 velocity_at(sdk::Vec3 x) const { return velocity + cross(spin, x); }

  /// What a frame does: a turn about `origin`, at rest.
  static Placement turned(sdk::Vec3 origin, sdk::Vec3 axis, double angle) {
    Placement p;
    if (angle == 0.0) return p;
    p.is_turned = true;
    for (sdk::Vec3& c : p.column) c = rotate(c, axis, angle);
    p.shift = origin - p.turn(origin);
    return p;
  }
  static Placement of(const sdk::RigidPose& pose) {
    Placement p = turned(pose.pivot, pose.axis, pose.angle);
    p.shift += pose.shift;
    p.spin = pose.angular_velocity * pose.axis;
    p.velocity = pose.velocity - cross(p.spin, pose.pivot + pose.shift);
    return p;
  }
  /// This placement after `inner`.
  [[nodiscard]] Placement after(const Placement& inner) const {
    Placement p;
    p.is_turned = is_turned || inner.is_turned;
    for (int d = 0; d < 3; ++d) p.column[d] = turn(inner.column[d]);
    p.shift = to_domain(inner.shift);
    const sdk::Vec3 turned_spin = turn(inner.spin);
    p.spin = spin + turned_spin;
    p.velocity = velocity + turn(inner.velocity) - cross(turned_spin, shift);
    return p;
  }
};

}  // namespace dust::bodies
