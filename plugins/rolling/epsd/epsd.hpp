// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../last_steps.hpp"
#include "../swing.hpp"

#include <dust/sdk/contact_plane.hpp>

#include <algorithm>
#include <cmath>

namespace dust::model::epsd {

/// Constants of a pair of materials.
struct Constants {
  double friction = 0.0;       ///< [-] mu_r
  double damping_ratio = 0.0;  ///< [-] eta_r
};

/// Largest dashpot [I/dt], I that of the relative rotation. Those of a grain's contacts add up, the
/// tangential dampers brake its spin as well, and a velocity that is predicted over half a step
/// (Adams-Bashforth) is stable below 1/dt: eight of twelve neighbours brake each axis. Without a
/// bound a grain in a corner of three walls would spin for ever, from mu_r = 1 on.
inline constexpr double k_max_dashpot = 0.07;

/// One contact. n: unit normal, w: angular velocity of i relative to j [rad/s], a: rotation of i
/// relative to j since the last look [rad], v: velocity of i relative to j at the contact point
/// [m/s], f: force on i [N], s: couple of the spring on i [N m], in and out, m: couple on i [N m],
/// out.
struct Rolling {
  double nx, ny, nz, wx, wy, wz, ax, ay, az, vx, vy, vz, fx, fy, fz;
  double radius;                ///< [m] R*
  double mass;                  ///< [kg] m*
  double normal_force;          ///< [N]
  double stiffness;             ///< [N/m] k_n
  double tangential_stiffness;  ///< [N/m] k_t
  double last_stiffness;        ///< [N/m] k_n at the last look, below 0 if at the limit, in and out
  double way;                   ///< [m] by which the two part in a step
  double sx, sy, sz;
  double mx, my, mz;
  double before;  ///< [N m] size of the spring's couple at the last look, out
  double total;   ///< [N m] size of spring and dashpot together without limit, out
  double limit;   ///< [N m] out
};

/// Part of the step around a look during which the spring is below its limit: `above_before` and
/// `above` [N m] it was and is; where it was at it (`is_mobilised`) none is left. The dashpot ends
/// there with a jump: told by the looks alone, it would act up to half a step too long or too
/// short.
[[gnu::always_inline]] inline double part_below_limit(double above_before, double above,
                                                      bool is_mobilised) {
  const double change = std::max(above - above_before, 1e-290);
  if (above > 0.0) {
    return is_mobilised ? 0.0 : std::clamp(-above_before / change - 0.5, 0.0, 0.5);
  }
  return std::min(1.0, 0.5 - above / change);
}

/// What the dashpot is told: the relative angular velocity without its part about the normal, as it
/// is in a swing of the rolling spring (`excess`) and the tangential one; \f$ \omega +
/// \tfrac{5.5}{12} dt^2 \ddot\omega \f$, docs/theory/grains.md, eq. (18).
[[gnu::always_inline]] inline sdk::Vec3 rolling_velocity(double time_step, double excess,
                                                         const TurningSides& sides,
                                                         const Rolling& c) {
  const sdk::Vec3 n{c.nx, c.ny, c.nz};
  const double wn = c.wx * c.nx + c.wy * c.ny + c.wz * c.nz;
  const double kept = 1.0 - k_damper_lead * excess;
  const double by = k_damper_lead / 12.0 * sides.turning *
                    std::min(c.tangential_stiffness * time_step * time_step,
                             c.mass * (12.0 / 3.5 * k_max_phase_excess));
  const sdk::Vec3 turned = cross(n, {c.vx, c.vy, c.vz});
  return {kept * (c.wx - wn * c.nx) + by * turned.x, kept * (c.wy - wn * c.ny) + by * turned.y,
          kept * (c.wz - wn * c.nz) + by * turned.z};
}

/// Couple of an elastic-plastic spring with a dashpot below full mobilisation:
/// \f$ \Delta M_s = -k_r \Delta\theta_r,\; k_r = 2.25 k_n \mu_r^2 R^{*2},\;
/// |M_s| \le \mu_r R^* |F_n| \f$, k_n being the mean over the step (second order); \f$ M_d = -2
/// \eta_r \sqrt{I_r k_r}\, \omega_r \f$ while \f$ |M_s| \f$ is below its limit, else 0, bounded by
/// k_max_dashpot; the limit holds for the sum, too. \f$ \omega_r \f$ is the relative angular
/// velocity without its part about the normal, \f$ I_r \f$ that of the two about their contact, \f$
/// 1/I_r = 5/(7 m_i R_i^2) + 5/(7 m_j R_j^2) \f$. M_s turns with the contact and keeps its length.
/// A damped contact pulls before it ends: where F_n goes through zero, so does M_s, which begins
/// anew. Source: model C of Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269,
/// doi:10.1016/j.powtec.2010.09.030.
[[gnu::always_inline]] inline void evaluate(const Constants& k, double time_step,
                                            const TurningSides& sides, Rolling& c) {
  constexpr double k_tiny = 1e-290;
  const sdk::InPlane spring = sdk::in_contact_plane({c.sx, c.sy, c.sz}, {c.nx, c.ny, c.nz});
  const double reach = k.friction * c.radius;
  const double kr = 2.25 * c.stiffness * reach * reach;
  const double excess = phase_excess(kr, time_step, sides.inverse_inertia);
  const double fall = 1.5 * c.stiffness * c.way;
  const SpringPart part = part_since_pulling(c.normal_force, fall);
  const double keep =
      part.kept * std::sqrt(spring.squared_before / std::max(spring.squared, k_tiny));
  const double last = c.last_stiffness != 0.0 ? std::abs(c.last_stiffness) : c.stiffness;
  const double mean =
      2.25 * 0.5 * (last + c.stiffness) * reach * reach * (1.0 - excess) * part.of_step;
  const double an = c.ax * c.nx + c.ay * c.ny + c.az * c.nz;
  const double sx = keep * spring.part.x - mean * (c.ax - an * c.nx);
  const double sy = keep * spring.part.y - mean * (c.ay - an * c.ny);
  const double sz = keep * spring.part.z - mean * (c.az - an * c.nz);
  const double size = std::sqrt(sx * sx + sy * sy + sz * sz);
  const double limit = reach * std::abs(c.normal_force);
  const double cut = std::min(1.0, limit / std::max(size, k_tiny));
  c.sx = cut * sx;
  c.sy = cut * sy;
  c.sz = cut * sz;
  const double inertia = 3.5 * sides.inertia;
  const double above_before = std::sqrt(spring.squared_before) - limit - reach * fall;
  const double damped = part_below_limit(above_before, size - limit, c.last_stiffness < 0.0);
  const double damping = damped * std::min(2.0 * k.damping_ratio * std::sqrt(inertia * kr),
                                           sides.inertia * (k_max_dashpot / time_step));
  c.last_stiffness = cut < 1.0 ? -c.stiffness : c.stiffness;
  const sdk::Vec3 w = rolling_velocity(time_step, excess, sides, c);
  const Couple by_force = couple_of_force(lever_of_force(excess, sides), {c.nx, c.ny, c.nz},
                                          {c.fx, c.fy, c.fz}, size, limit);
  const double mx = c.sx - damping * w.x + by_force.x;
  const double my = c.sy - damping * w.y + by_force.y;
  const double mz = c.sz - damping * w.z + by_force.z;
  const double total = std::sqrt(mx * mx + my * my + mz * mz);
  const double cap = std::min(1.0, limit / std::max(total, k_tiny));
  c.mx = cap * mx;
  c.my = cap * my;
  c.mz = cap * mz;
  c.before = std::sqrt(spring.squared_before);
  c.total = total;
  c.limit = limit;
}

}  // namespace dust::model::epsd
