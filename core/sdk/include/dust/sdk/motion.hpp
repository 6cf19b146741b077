// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstddef>

namespace dust::sdk {

/// Points of a body's surface.
struct SurfaceBatch {
  std::size_t count = 0;
  double time = 0.0;          ///< [s]
  Vec3 axis;                  ///< unit vector: the body's lateral axis (belt: the pulley's axis)
  const double* x = nullptr;  ///< [m]
  const double* y = nullptr;
  const double* z = nullptr;
  const double* normal_x = nullptr;  ///< [-] outward
  const double* normal_y = nullptr;
  const double* normal_z = nullptr;
  double* velocity_x = nullptr;  ///< [m/s] out: velocity of the surface
  double* velocity_y = nullptr;
  double* velocity_z = nullptr;
};

/// Velocity of a body's surface: a pure function of time and place. The geometry itself stands.
class Motion : public Model {
 public:
  static constexpr const char* k_kind = "motion";
  virtual void surface_velocity(const SurfaceBatch& batch) const = 0;
  /// Upper bound of the surface speed [m/s] over all times, for time steps and checks.
  [[nodiscard]] virtual double largest_speed() const = 0;
};

}  // namespace dust::sdk
