// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace my_rolling {

/// One contact. n: unit normal, w: angular velocity of i relative to j [rad/s], m: couple [N m].
struct Rolling {
  double nx, ny, nz, wx, wy, wz;
  double radius;        ///< [m] R*
  double normal_force;  ///< [N]
  double mx, my, mz;
};

/// Couple against rolling, constant above a small rotation that keeps it smooth through rest:
/// \f$ M = -\mu_r R^* |F_n| \, w_r / \sqrt{w_r^2 + w_0^2} \f$, w_r without its part about n.
/// Source: model A of Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269, smoothed.
[[gnu::always_inline]] inline void evaluate(double friction, double smooth_below, Rolling& c) {
  const double along = c.wx * c.nx + c.wy * c.ny + c.wz * c.nz;
  const double wx = c.wx - along * c.nx;
  const double wy = c.wy - along * c.ny;
  const double wz = c.wz - along * c.nz;
  const double size = std::sqrt(wx * wx + wy * wy + wz * wz + smooth_below * smooth_below);
  const double couple = friction * c.radius * std::abs(c.normal_force) / size;
  c.mx = -couple * wx;
  c.my = -couple * wy;
  c.mz = -couple * wz;
}

}  // namespace my_rolling
