// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::belt {

/// Surface velocity of a belt: \f$ v = U\, a \times n \f$, a the pulley's axis, n the outward
/// normal. With a = +y and n = +z this is +x; it turns round the pulleys with the normal.
struct Velocity {
  double x, y, z;
};
constexpr Velocity velocity(double speed, double ax, double ay, double az, double nx, double ny,
                            double nz) {
  return {speed * (ay * nz - az * ny), speed * (az * nx - ax * nz), speed * (ax * ny - ay * nx)};
}

/// Speed at `time` [s] of a belt that sets off at `start` [s] and gathers speed evenly for `ramp`
/// [s].
constexpr double speed_at(double speed, double start, double ramp, double time) {
  if (time < start) return 0.0;
  return time - start < ramp ? speed * (time - start) / ramp : speed;
}

}  // namespace dust::model::belt
