// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/columns.hpp"
#include "dust/sdk/model.hpp"
#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <cstddef>

namespace dust::sdk {

/// Points of a body's surface.
struct SurfaceBatch {
  std::size_t count = 0;
  double time = 0.0;       ///< [s]
  Vec3 axis;               ///< unit vector: the body's lateral axis (belt: the pulley's axis)
  VectorColumns position;  ///< [m]
  VectorColumns normal;    ///< [-] outward
  MutableVectorColumns velocity;  ///< [m/s] out: velocity of the surface
};

/// Where a rigid body is, compared with where the scenario puts it:
/// \f$ x = p + s + R(a, \varphi)(x_0 - p) \f$, and how fast that changes.
struct RigidPose {
  Vec3 shift;                     ///< [m] s
  Vec3 pivot;                     ///< [m] p, a point of the axis
  Vec3 axis{0, 0, 1};             ///< a, unit vector
  double angle = 0.0;             ///< [rad]
  Vec3 velocity;                  ///< [m/s] ds/dt
  double angular_velocity = 0.0;  ///< [rad/s]
};

/// How a body moves: as a whole (`pose`), or its surface along itself while the body stands
/// (`surface_velocity`). Both are pure functions of time and place, so that a resumed run needs
/// nothing saved. All is in the body's frame before its scenario frame turns it, except a
/// SurfaceBatch, which is in the domain's.
class Motion : public Model {
 public:
  static constexpr const char* k_kind = "motion";
  /// Velocity of the surface relative to the body.
  virtual void surface_velocity(const SurfaceBatch& batch) const {
    std::fill_n(batch.velocity.x, batch.count, 0.0);
    std::fill_n(batch.velocity.y, batch.count, 0.0);
    std::fill_n(batch.velocity.z, batch.count, 0.0);
  }
  /// Upper bound [m/s] over all times of the speed of the surface along itself and of the shift.
  [[nodiscard]] virtual double largest_speed() const = 0;

  /// Whether the body itself moves; then `pose` says where it is.
  [[nodiscard]] virtual bool moves_body() const { return false; }
  [[nodiscard]] virtual RigidPose pose(double /*time*/) const { return {}; }
  /// Upper bound [rad/s] of |angular_velocity| over all times.
  [[nodiscard]] virtual double largest_angular_velocity() const { return 0.0; }
};

}  // namespace dust::sdk
