// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::particles {

/// Where the energy of the particles is and where it has gone [J], each particle with its
/// statistical weight; docs/theory/energy.md, eq. (1).
struct EnergyBalance {
  // At this instant.
  double translation = 0.0, rotation = 0.0;             ///< kinetic
  double elastic_normal = 0.0, elastic_friction = 0.0;  ///< in the springs of the contacts
  // Since the start.
  double entered = 0.0, left = 0.0;  ///< kinetic energy of particles that came and went
  double gravity = 0.0;              ///< work of gravity less buoyancy
  double walls = 0.0;                ///< work of moving walls and bodies
  double fluid = 0.0;                ///< work of drag and of all else that the fluid does
  double lost_normal = 0.0;          ///< by the damper of the normal direction
  double lost_friction = 0.0;        ///< by sliding and by the tangential damper
  double lost_rolling = 0.0;         ///< by rolling, with what its springs hold

  /// What has come less what is there and what is lost: zero but for the integration.
  [[nodiscard]] double error() const {
    return entered - left + gravity + walls + fluid - lost_normal - lost_friction - lost_rolling -
           translation - rotation - elastic_normal - elastic_friction;
  }
  /// The energy that has been turned over: all that came in, and all that was lost.
  [[nodiscard]] double turned_over() const {
    return entered + std::abs(gravity) + std::abs(walls) + std::abs(fluid) + std::abs(lost_normal) +
           std::abs(lost_friction) + std::abs(lost_rolling);
  }
  /// error() / turned_over(); 0 where nothing was.
  [[nodiscard]] double relative_error() const {
    const double all = turned_over();
    return all > 0.0 ? error() / all : 0.0;
  }
};

}  // namespace dust::particles
