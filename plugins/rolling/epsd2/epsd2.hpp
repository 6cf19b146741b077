// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../last_steps.hpp"
#include "../swing.hpp"

#include <dust/sdk/contact_plane.hpp>

#include <algorithm>
#include <cmath>

namespace dust::model::epsd2 {

/// One contact. n: unit normal, a: rotation of i relative to j since the last look [rad], m: couple
/// on i [N m], in and out.
struct Rolling {
  double nx, ny, nz, ax, ay, az;
  double radius;            ///< [m] R*
  double normal_force;      ///< [N]
  double normal_stiffness;  ///< [N/m]
  double way;               ///< [m] by which the two part in a step
  double stiffness;         ///< [N/m] k_t
  double last_stiffness;    ///< [N/m] k_t at the last look; 0 of a contact that has just begun
  double mx, my, mz;

  // Handed from stage to stage.
  double keep;   ///< [-] what the couple's part across the new normal is stretched by
  double size;   ///< [N m] of the couple without limit
  double lever;  ///< [m] of what the tangential force adds to it
};

// Couple of an elastic-plastic spring without dashpot:
// \f$ \Delta M = -k_r \Delta\theta_r,\; k_r = k_t R^{*2},\; |M| \le \mu_r R^* |F_n| \f$.
// \f$ \Delta\theta_r \f$ is the relative rotation without its part about the normal, k_t the mean
// over the step (second order). M turns with the contact and keeps its length. A damped contact
// pulls before it ends: where F_n goes through zero, so does M, which begins anew. Source: model C
// of Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269, doi:10.1016/j.powtec.2010.09.030, with
// k_r of Iwashita and Oda, J. Eng. Mech. 124 (1998) 285.
//
// In three stages; the caller takes the roots between them, of many contacts at once: see
// sdk::take_square_roots().

inline constexpr double k_tiny = 1e-290;

/// The couple across the new normal; `keep`, squared, restores the old size.
[[gnu::always_inline]] inline void turn(Rolling& c) {
  const sdk::InPlane couple = sdk::in_contact_plane({c.mx, c.my, c.mz}, {c.nx, c.ny, c.nz});
  c.keep = couple.squared_before / std::max(couple.squared, k_tiny);
  c.mx = couple.part.x;
  c.my = couple.part.y;
  c.mz = couple.part.z;
}

/// The spring without limit; `size` is squared.
[[gnu::always_inline]] inline void roll(double time_step, const TurningSides& sides, Rolling& c) {
  const double an = c.ax * c.nx + c.ay * c.ny + c.az * c.nz;
  const double last = c.last_stiffness > 0.0 ? c.last_stiffness : c.stiffness;
  const double excess =
      phase_excess(c.stiffness * c.radius * c.radius, time_step, sides.inverse_inertia);
  c.lever = lever_of_force(excess, sides);
  const SpringPart pulling = part_since_pulling(c.normal_force, 1.5 * c.normal_stiffness * c.way);
  const double kr =
      0.5 * (last + c.stiffness) * c.radius * c.radius * (1.0 - excess) * pulling.of_step;
  c.keep *= pulling.kept;
  c.mx = c.keep * c.mx - kr * (c.ax - an * c.nx);
  c.my = c.keep * c.my - kr * (c.ay - an * c.ny);
  c.mz = c.keep * c.mz - kr * (c.az - an * c.nz);
  c.size = c.mx * c.mx + c.my * c.my + c.mz * c.mz;
}
[[gnu::always_inline]] inline void limit(double friction, Rolling& c) {
  const double most = friction * c.radius * std::abs(c.normal_force);
  const double cut = std::min(1.0, most / std::max(c.size, k_tiny));
  c.mx = cut * c.mx;
  c.my = cut * c.my;
  c.mz = cut * c.mz;
}

}  // namespace dust::model::epsd2
