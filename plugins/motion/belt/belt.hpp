// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace dust::model::belt {

/// Surface velocity of a belt: \f$ v = U\, a \times n / |a \times n| \f$, a the pulley's axis, n
/// the outward normal. With a = +y and n = +z this is +x; it turns round the pulleys with the
/// normal. The idlers of a trough lean the surface to the axis: the speed stays U. Where the normal
/// is within k_smallest_sine of the axis, as on the faces at the ends of a pulley, the direction of
/// the belt is lost and the speed goes to zero.
struct Velocity {
  double x, y, z;
};
inline constexpr double k_smallest_sine = 0.02;

inline Velocity velocity(double speed, double ax, double ay, double az, double nx, double ny,
                         double nz) {
  const double cosine = ax * nx + ay * ny + az * nz;
  // Exactly U where both are square to each other.
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, k_smallest_sine * k_smallest_sine));
  const double u = speed / sine;
  return {u * (ay * nz - az * ny), u * (az * nx - ax * nz), u * (ax * ny - ay * nx)};
}

}  // namespace dust::model::belt
