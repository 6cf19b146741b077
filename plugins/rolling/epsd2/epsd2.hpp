// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace dust::model::epsd2 {

/// One contact. n: unit normal, w: angular velocity of i relative to j [rad/s], m: couple on i [N
/// m], in and out.
struct Rolling {
  double nx, ny, nz, wx, wy, wz;
  double radius;        ///< [m] R*
  double normal_force;  ///< [N]
  double stiffness;     ///< [N/m] k_t
  double mx, my, mz;
};

/// Couple of an elastic-plastic spring without dashpot:
/// \f$ \Delta M = -k_r \Delta\theta_r,\; k_r = k_t R^{*2},\; |M| \le \mu_r R^* |F_n| \f$.
/// \f$ \Delta\theta_r \f$ is the relative rotation without its part about the normal. M turns with
/// the contact and keeps its length.
/// Source: model C of Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269,
/// doi:10.1016/j.powtec.2010.09.030, with k_r of Iwashita and Oda, J. Eng. Mech. 124 (1998) 285.
[[gnu::always_inline]] inline void evaluate(double friction, double time_step, Rolling& c) {
  constexpr double k_tiny = 1e-290;
  const double wn = c.wx * c.nx + c.wy * c.ny + c.wz * c.nz;
  const double mn = c.mx * c.nx + c.my * c.ny + c.mz * c.nz;
  const double px = c.mx - mn * c.nx;
  const double py = c.my - mn * c.ny;
  const double pz = c.mz - mn * c.nz;
  const double old2 = c.mx * c.mx + c.my * c.my + c.mz * c.mz;
  const double new2 = px * px + py * py + pz * pz;
  const double keep = std::sqrt(old2 / std::max(new2, k_tiny));
  const double step = c.stiffness * c.radius * c.radius * time_step;
  const double mx = keep * px - step * (c.wx - wn * c.nx);
  const double my = keep * py - step * (c.wy - wn * c.ny);
  const double mz = keep * pz - step * (c.wz - wn * c.nz);
  const double size = std::sqrt(mx * mx + my * my + mz * mz);
  const double limit = friction * c.radius * std::abs(c.normal_force);
  const double cut = std::min(1.0, limit / std::max(size, k_tiny));
  c.mx = cut * mx;
  c.my = cut * my;
  c.mz = cut * mz;
}

}  // namespace dust::model::epsd2
