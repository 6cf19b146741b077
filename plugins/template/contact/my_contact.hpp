// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/contact_plane.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace my_contact {

struct Constants {
  double stiffness = 0.0;    ///< [N/m] k
  double ratio = 2.0 / 7.0;  ///< [-] tangential over normal stiffness
  double damping = 0.0;      ///< [-] share of critical damping, from the restitution
  double friction = 0.0;     ///< [-]
};

/// Share of critical damping that gives the restitution e exactly:
/// \f$ \zeta = -\ln e / \sqrt{\pi^2 + \ln^2 e} \f$.
inline double damping(double restitution) {
  const double log_e = std::log(restitution);
  return -log_e / std::sqrt(std::numbers::pi * std::numbers::pi + log_e * log_e);
}

/// Duration [s] of an elastic collision of effective mass m* [kg]: half a period of the spring,
/// \f$ \pi \sqrt{m^*/k} \f$, whatever the speed.
inline double collision_time(double stiffness, double mass) {
  return std::numbers::pi * std::sqrt(mass / stiffness);
}

/// One contact: inputs (v: relative velocity, u: displacement since the last look [m]), history (s:
/// tangential spring [m], in and out), outputs.
struct Contact {
  double overlap, nx, ny, nz, vx, vy, vz, ux, uy, uz, mass;
  double sx, sy, sz;
  double normal_force, tangential_stiffness, fx, fy, fz;
};

/// Linear springs with dampers, Coulomb's limit on the tangential force:
/// \f$ F_n = k d - c v_n,\; F_t = -k_t s - c_t v_t,\; |F_t| \le \mu \max(F_n, 0) \f$,
/// \f$ c = 2 \zeta \sqrt{m^* k} \f$. Source: Cundall, Strack, Geotechnique 29 (1979) 47.
[[gnu::always_inline]] inline void evaluate(const Constants& k, Contact& c) {
  constexpr double k_tiny = 1e-290;
  const double stiffness = c.overlap > 0.0 ? k.stiffness : 0.0;
  const double tangential = k.ratio * stiffness;
  const double vn = c.vx * c.nx + c.vy * c.ny + c.vz * c.nz;
  const double normal =
      stiffness * c.overlap - 2.0 * k.damping * std::sqrt(c.mass * stiffness) * vn;
  const double damper = 2.0 * k.damping * std::sqrt(c.mass * tangential);
  const double tx = c.vx - vn * c.nx;
  const double ty = c.vy - vn * c.ny;
  const double tz = c.vz - vn * c.nz;
  // The spring grows by the displacement, and not by velocity times time step, which would damp it.
  // It follows the contact: what points along the new normal is dropped.
  const auto spring =
      dust::sdk::in_contact_plane({c.sx + c.ux, c.sy + c.uy, c.sz + c.uz}, {c.nx, c.ny, c.nz});
  c.sx = spring.part.x;
  c.sy = spring.part.y;
  c.sz = spring.part.z;
  const double fx = -tangential * c.sx - damper * tx;
  const double fy = -tangential * c.sy - damper * ty;
  const double fz = -tangential * c.sz - damper * tz;
  const double size = std::sqrt(fx * fx + fy * fy + fz * fz);
  const double limit = k.friction * std::max(normal, 0.0);
  const double cut = std::min(1.0, limit / std::max(size, k_tiny));
  // A contact that slides keeps as much spring as friction can hold.
  c.sx *= cut;
  c.sy *= cut;
  c.sz *= cut;
  c.normal_force = normal;
  c.tangential_stiffness = tangential;
  c.fx = normal * c.nx + cut * fx;
  c.fy = normal * c.ny + cut * fy;
  c.fz = normal * c.nz + cut * fz;
}

}  // namespace my_contact
