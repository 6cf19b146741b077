// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstdint>

namespace dust::resolved {

/// A sphere as the fluid meets it in a fluid step: at the step's beginning.
struct Sphere {
  std::int64_t id = -1;
  sdk::Vec3 position;
  sdk::Vec3 velocity;
  sdk::Vec3 rotation;   ///< [rad/s]
  double radius = 0.0;  ///< [m]

  /// After `time` [s] of the step, at the velocity of its beginning.
  [[nodiscard]] sdk::Vec3 position_after(double time) const { return position + velocity * time; }
};

/// What a sphere is given: over a fluid step, about its centre.
struct Impulse {
  sdk::Vec3 linear;   ///< [N s]
  sdk::Vec3 angular;  ///< [N m s]

  Impulse& operator+=(const Impulse& other) {
    linear += other.linear;
    angular += other.angular;
    return *this;
  }
  Impulse& operator-=(const Impulse& other) {
    linear -= other.linear;
    angular -= other.angular;
    return *this;
  }
};

}  // namespace dust::resolved
