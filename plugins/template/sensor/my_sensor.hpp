// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace my_sensor {

/// Kinetic energy [J] of mass m [kg] at the velocity (x, y, z) [m/s]: \f$ m v^2 / 2 \f$.
inline double kinetic_energy(double mass, double x, double y, double z) {
  return 0.5 * mass * (x * x + y * y + z * z);
}

}  // namespace my_sensor
