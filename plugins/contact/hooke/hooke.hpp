// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../spin_damping.hpp"

#include <dust/sdk/contact_plane.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::model::hooke {

/// Constants of a pair of materials.
struct Constants {
  double stiffness = 0.0;             ///< [N/m] k_n
  double tangential_stiffness = 0.0;  ///< [N/m] k_t
  double damping = 0.0;               ///< [-] -2 beta >= 0
  double friction = 0.0;              ///< [-] mu_s
};

/// Damping number: \f$ -2 \beta \f$ with \f$ \beta = \ln e / \sqrt{\ln^2 e + \pi^2} \f$,
/// 0 < e <= 1. Exact as long as the normal force may attract while the contact opens.
/// Source: solution of the damped oscillator from touch to touch.
inline double damping(double restitution) {
  const double l = std::log(restitution);
  return -2.0 * l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
}

/// Duration [s] of an elastic impact, whatever its speed: \f$ \pi \sqrt{m^* / k_n} \f$. A damped
/// one takes \f$ \sqrt{1 + (\ln e / \pi)^2} \f$ times as long.
inline double elastic_time(double stiffness, double mass) {
  return std::numbers::pi * std::sqrt(mass / stiffness);
}

/// What the core derives the step from [s]: elastic_time(), but at most \f$ 2.6\, m^* / \gamma_n
/// \f$, which is less below a restitution of 0.24. The normal dampers of a grain's contacts add up:
/// in the densest packing they brake a motion against all neighbours at four times
/// \f$ \gamma_n / m^* \f$, and a velocity that is predicted over half a step (Adams-Bashforth) is
/// stable below one over the step, a fifteenth of this time: 0.7 of that is left here. A bound on
/// the damper, as for the tangential one, would falsify the restitution.
inline double collision_time(double stiffness, double damping, double mass) {
  constexpr double k_damped = 2.6;
  const double elastic = elastic_time(stiffness, mass);
  return elastic * std::min(1.0, k_damped / std::numbers::pi / std::max(damping, 1e-290));
}

/// One contact: geometry and kinematics in, force out. n points from j to i, v is the velocity of i
/// relative to j at the contact point, u their displacement since the last look [m]. SI.
struct Contact {
  double overlap, nx, ny, nz, vx, vy, vz, ux, uy, uz, mass;
  double sx, sy, sz;            ///< [m] tangential displacement, in and out
  double normal_force;          ///< [N] out
  double normal_stiffness;      ///< [N/m] out
  double tangential_stiffness;  ///< [N/m] out
  double fx, fy, fz;            ///< [N] out, on i
};

/// Normal force \f$ F_n = k_n d - \gamma_n v_n \f$, \f$ \gamma_n = -2 \beta \sqrt{k_n m^*} \f$, and
/// tangential force \f$ F_t = -k_t \xi_t - \gamma_t v_t \f$,
/// \f$ \gamma_t = -2 \beta \sqrt{k_t \tfrac27 m^*} \f$, with \f$ |F_t| \le \mu_s \max(F_n, 0) \f$
/// for spring and damper together. 2/7 m* is the mass that the contact point of two solid spheres
/// shows in the tangent plane, for any pair of radii and masses: the damping of a contact that does
/// not slide is that of the normal direction, unless k_max_tangential_damping bounds it: at the
/// default step for a restitution below 0.23, or 0.48 with k_t = k_n. While sliding the spring is
/// set to what the limit leaves beside the damper. The displacement turns with the normal and keeps
/// its length. Without touch (d <= 0) force and displacement are zero. Source: Cundall and Strack,
/// Geotechnique 29 (1979) 47, doi:10.1680/geot.1979.29.1.47; the damping numbers follow from the
/// oscillator.
[[gnu::always_inline]] inline void evaluate(const Constants& k, double time_step, Contact& c) {
  constexpr double k_tiny = 1e-290;
  const double touch = c.overlap > 0.0 ? 1.0 : 0.0;
  const double kn = touch * k.stiffness;
  const double kt = touch * k.tangential_stiffness;
  const double gn = k.damping * std::sqrt(kn * c.mass);
  const double gt = std::min(k.damping * std::sqrt(kt * (2.0 / 7.0) * c.mass),
                             c.mass * (k_max_tangential_damping / time_step));

  const double vn = c.vx * c.nx + c.vy * c.ny + c.vz * c.nz;
  // Dampers and the tangential spring begin and end with a jump. The look within a step of it
  // counts for half a step and the way to it, x = d / (|v_n| dt): held for the whole step they
  // would be in error by half of it, to first order.
  const double x = c.overlap / std::max(std::abs(vn) * time_step, k_tiny);
  const double edge = x < 1.0 ? 0.5 + x : 1.0;
  const double fn = kn * c.overlap - edge * gn * vn;
  const double tx = c.vx - vn * c.nx;
  const double ty = c.vy - vn * c.ny;
  const double tz = c.vz - vn * c.nz;

  // Into the new tangent plane, at the old length.
  const sdk::InPlane spring = sdk::in_contact_plane({c.sx, c.sy, c.sz}, {c.nx, c.ny, c.nz});
  const double keep = std::sqrt(spring.squared_before / std::max(spring.squared, k_tiny));
  const double un = c.ux * c.nx + c.uy * c.ny + c.uz * c.nz;
  const double sx = touch * (keep * spring.part.x + c.ux - un * c.nx);
  const double sy = touch * (keep * spring.part.y + c.uy - un * c.ny);
  const double sz = touch * (keep * spring.part.z + c.uz - un * c.nz);

  // Coulomb: spring and damper share the limit.
  const double ux = edge * (-kt * sx - gt * tx);
  const double uy = edge * (-kt * sy - gt * ty);
  const double uz = edge * (-kt * sz - gt * tz);
  const double limit = k.friction * std::max(fn, 0.0);
  const double total = std::sqrt(ux * ux + uy * uy + uz * uz);
  const double cap = std::min(1.0, limit / std::max(total, k_tiny));
  const double hold = cap < 1.0 ? 0.0 : 1.0;
  const double back = touch * (hold - 1.0) / k.tangential_stiffness;

  c.sx = hold * sx + back * (cap * ux + gt * tx);
  c.sy = hold * sy + back * (cap * uy + gt * ty);
  c.sz = hold * sz + back * (cap * uz + gt * tz);
  c.normal_force = fn;
  c.normal_stiffness = kn;
  c.tangential_stiffness = kt;
  c.fx = fn * c.nx + cap * ux;
  c.fy = fn * c.ny + cap * uy;
  c.fz = fn * c.nz + cap * uz;
}

}  // namespace dust::model::hooke
