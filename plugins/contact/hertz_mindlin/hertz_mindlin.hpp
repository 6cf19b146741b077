// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../spin_damping.hpp"

#include <dust/sdk/contact_plane.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::model::hertz_mindlin {

/// Constants of a pair of materials.
struct Constants {
  double young = 0.0;        ///< [Pa] E*, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
  double shear = 0.0;        ///< [Pa] G*, 1/G* = 2(2 - nu1)(1 + nu1)/E1 + 2(2 - nu2)(1 + nu2)/E2
  double normal_root = 0.0;  ///< [Pa^(1/2)] sqrt(2 E*)
  double tangential_root = 0.0;  ///< [Pa^(1/2)] sqrt(8 G*)
  double damping = 0.0;          ///< [-] -2 beta sqrt(5/6) >= 0
  double friction = 0.0;         ///< [-] mu_s
};

/// Of \f$ h = \frac{1}{12} \omega^2 dt^2 \f$ of the contact point, \f$ \omega^2 = \frac72 k_t / m^*
/// \f$ for any pair of solid spheres: what the leapfrog makes too much of a oscillation, and by
/// what a velocity that is predicted over half a step is ahead of it; docs/theory/grains.md, eq.
/// (17).
inline constexpr double k_phase_excess = 3.5 / 12.0;  ///< h in k_t dt^2 / m*
inline constexpr double k_max_phase_excess = 0.1;     ///< [-] h where steps are too long for it
inline constexpr double k_damper_lead = 5.5;          ///< [h]

/// Damping number: \f$ -2 \beta \sqrt{5/6} \f$ with \f$ \beta = \ln e / \sqrt{\ln^2 e + \pi^2} \f$,
/// 0 < e <= 1. Exact as long as the normal force may attract while the contact opens.
/// Source: Tsuji, Tanaka, Ishida, Powder Technol. 71 (1992) 239, doi:10.1016/0032-5910(92)88030-L.
inline double damping(double restitution) {
  const double l = std::log(restitution);
  return -2.0 * std::sqrt(5.0 / 6.0) * l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
}

/// Duration [s] of an elastic impact at `speed` [m/s]:
/// \f$ T_H = 2.87 (m^{*2} / (R^* E^{*2} v))^{1/5} \f$. Source: Hertz 1882; Johnson, Contact
/// Mechanics (1985), eq. 11.24.
inline double collision_time(double young, double radius, double mass, double speed) {
  return 2.87 * std::pow(mass * mass / (radius * young * young * speed), 0.2);
}

/// Share of these times that the core derives the step from: less than 1 below a restitution of
/// 0.29, 0.6 at 0.1. The normal dampers of a grain's contacts add up: in the densest packing they
/// brake a motion against all neighbours at \f$ 4 \gamma_n / m^* \f$, and a velocity that is
/// predicted over half a step (Adams-Bashforth) is stable below one over the step, a fifteenth of a
/// collision: 0.7 of that is left here. A bound on the damper, as for the tangential one, would
/// falsify the restitution. `damping` = -2 sqrt(5/6) beta.
inline double damped_share(double damping) {
  constexpr double k_damping = 0.67;
  return std::min(1.0, k_damping / std::max(damping, k_damping));
}

/// Shortest half period [s] of the loaded contact: \f$ \pi \sqrt{m^* / (dF_n/d\delta)} \f$,
/// \f$ dF_n/d\delta = 2 E^* \sqrt{R^* \delta} \f$.
inline double half_period(double young, double radius, double mass, double overlap) {
  return std::numbers::pi *
         std::sqrt(mass /
                   std::max(2.0 * young * std::sqrt(radius * std::max(overlap, 0.0)), 1e-300));
}

/// One contact: geometry and kinematics in, force out. n points from j to i, v is the velocity of i
/// relative to j at the contact point, u their displacement since the last look [m]. SI.
struct Contact {
  double overlap, nx, ny, nz, vx, vy, vz, ux, uy, uz, radius, mass;
  double inverse_mass;      ///< [1/kg] 1 / m*
  double mx, my, mz;        ///< [N m] couple of the rolling spring on i a step ago
  double turning;           ///< [1/(kg m)] R_i/I_i - R_j/I_j
  double sx, sy, sz;        ///< [m] tangential displacement, in and out
  double stiffness;         ///< [N/m] k_t of the last step in, of this one out
  double normal_force;      ///< [N] out
  double normal_stiffness;  ///< [N/m] k_n, secant, out
  double fx, fy, fz;        ///< [N] out, on i

  // Handed from stage to stage.
  double contact_radius;  ///< [m] a = sqrt(R d)
  double keep;            ///< [-] what the displacement's part in the plane is stretched by
  double compliance;      ///< [m/N] 1 / k_t, bounded
  double vn;              ///< [m/s] of parting
  double dx, dy, dz;      ///< [N] what the damper holds against
  double total;           ///< [N] size of spring and damper together
};

// Normal force \f$ F_n = \tfrac43 E^* \sqrt{R^*}\, d^{3/2} - \gamma_n v_n \f$ and tangential force
// \f$ F_t = -k_t \xi_t - \gamma_t v_t \f$, \f$ |F_t| \le \mu_s \max(F_n, 0) \f$ for spring and
// damper together, in four stages. The caller takes the roots between them, of many contacts at
// once: see sdk::take_square_roots().
//
// The displacement is rescaled as the stiffness changes, \f$ \xi_t \sqrt{k_t} \f$ = const, so that
// a growing or shrinking overlap neither feeds nor drains the energy \f$ k_t \xi_t^2 / 2 \f$ of
// the spring (own derivation): \f$ d(\sqrt{k_t}\,\xi_t) = \sqrt{k_t}\, du_t \f$, the root on the
// right side being its mean over the step (second order). Constant displacement (the "total" form)
// would create energy while the contact is loaded, constant force while it is unloaded; forces that
// shrink with k_t on unloading (Thornton, Cummins, Cleary, Powder Technol. 233 (2013) 30,
// doi:10.1016/j.powtec.2012.08.012) create none but lose a fifth of the tangential energy of an
// elastic impact without slip, this form a twentieth. While sliding the spring is set to what the
// limit leaves beside the damper. The displacement turns with the normal and keeps its length.

inline constexpr double k_tiny = 1e-140;

/// Weight of a step's force that begins or ends like the fourth root of the overlap, as dampers do,
/// where touching or parting is less than a step off: x = `overlap` / `flight`, the way along the
/// normal in a step [m]. The tangential spring ends like that, too, but begins like x^{3/2}: there
/// it needs no weight. Held for the whole step it would be in error
/// by half of it, to first order. \f$ -\zeta(-\tfrac14, 1 + x) / x^{1/4} \f$ makes the sum over
/// looks at x, x + 1, ... the integral (Euler-Maclaurin for an algebraic end: Navot, J. Math. Phys.
/// 40 (1961) 271, doi:10.1002/sapm1961401271); this is within 0.04 of it for 0.001 < x < 1.
[[gnu::always_inline]] inline double edge_weight(double overlap, double flight) {
  const double way = std::max(flight, k_tiny);
  const double shifted = overlap + 0.006 * way;
  const double inverse = 1.0 / (way * shifted);
  const double x = overlap * shifted * inverse;
  return x < 1.0 ? 0.62 + x * (0.45 + 0.25 * x) + 0.0075 * way * way * inverse : 1.0;
}

/// The tangential force over the last steps of a contact, x steps before its end. Spring and damper
/// go like \f$ x^{1/4} (A + B (x_0^{5/4} - x^{5/4})) \f$, B by the slip at x_0, the normal force
/// like \f$ K (x^{3/2} - u_e x^{1/4}) \f$, u_e by its damper: the limit falls to zero within a step
/// or so and cuts off a force that may be anything.
/// One that is looked at once per step does not see it fall; what the last two looks give in place
/// of it adds up to the integral; docs/theory/grains.md, eq. (15).
class ForceToTheEnd {
 public:
  /// At x_0 = `steps`: spring and damper `total`, by how much the slip lets it grow in a step
  /// there, its limit `elastic_limit` without and `limit` with the normal damper, all [N].
  ForceToTheEnd(double steps, double total, double growth, double elastic_limit, double limit) {
    const double root = fourth_root(steps);
    const double u = steps * root;
    slope_ = elastic_limit / (u * root);
    // Not so that the force would change sign.
    const double size = total / root;
    growth_ = std::max(0.8 * growth / (root * root), -0.9 * std::min(slope_, size / u));
    size_ = size + growth_ * u;
    end_ = u * std::max(elastic_limit - limit, 0.0) / elastic_limit;
    cut_ = (size_ + slope_ * end_) / (slope_ + growth_);
  }
  /// The limit [N] at x.
  [[nodiscard]] double limit(double x) const {
    const double root = fourth_root(x);
    return slope_ * root * std::max(x * root - end_, 0.0);
  }
  /// \f$ \int_{x_e}^{x + 1/2} \f$ of the smaller of force and limit [N], steps being the unit.
  [[nodiscard]] double integral(double x) const {
    const double begin = std::max(x + 0.5, 0.0);
    const double u = begin * fourth_root(begin);
    const double limited = std::max(std::min(u, cut_) - end_, 0.0);
    const double to_the_cut = 0.4 * slope_ * limited * limited;
    if (u < cut_) return to_the_cut;
    return to_the_cut + (u - cut_) * (0.8 * size_ - 0.4 * growth_ * (u + cut_));
  }
  /// What is given at x as the last force. The last but one gives the rest. It fades where the end
  /// is less than 0.4 steps away: whether there is one more look hangs on the last digits there.
  [[nodiscard]] double last(double x) const {
    const double root = fourth_root(x);
    const double left = std::max(x * root - end_, 0.0) / std::max(1.25 * root, k_tiny);
    return std::min(std::min(1.0, 2.5 * left) * integral(x), limit(x));
  }
  [[nodiscard]] double last_but_one(double x) const {
    return std::clamp(integral(x) - last(x - 1.0), 0.0, limit(x));
  }
  /// Does the contact still hold at x?
  [[nodiscard]] bool holds(double x) const { return x > 0.0 && x * fourth_root(x) > end_; }

 private:
  static double fourth_root(double x) { return std::sqrt(std::sqrt(std::max(x, 0.0))); }

  double slope_;   ///< [N] mu K
  double growth_;  ///< [N] B
  double size_;    ///< [N] A + B x_0^{5/4}
  double end_;     ///< u_e = x_e^{5/4}: here the normal force is zero
  double cut_;     ///< u_c = x_c^{5/4}: here the limit is reached
};

/// \f$ a^2 = R^* d \f$ [m2].
[[gnu::always_inline]] inline double squared_contact_radius(double overlap, double radius) {
  return radius * std::max(overlap, 0.0);
}

/// The displacement into the new tangent plane; `keep`, squared, restores the old length and then
/// makes the change of k_t at constant energy; of a contact that has just begun it is zero. The
/// floor matters in the last instant of a contact alone.
[[gnu::always_inline]] inline void turn(const Constants& k, Contact& c) {
  const double kt = 8.0 * k.shear * c.contact_radius;
  const sdk::InPlane spring = sdk::in_contact_plane({c.sx, c.sy, c.sz}, {c.nx, c.ny, c.nz});
  const double floor = std::max(kt, std::max(1e-6 * c.stiffness, k_tiny));
  // One division for both reciprocals. A spring without length keeps the ratio of stiffnesses; one
  // turned up along the normal is lost.
  const double in_plane = spring.squared + k_tiny;
  const double inverse = 1.0 / (in_plane * floor);
  c.keep = std::min(spring.squared_before + k_tiny, 4.0 * in_plane) * c.stiffness * inverse;
  c.compliance = inverse * in_plane;
  c.sx = spring.part.x;
  c.sy = spring.part.y;
  c.sz = spring.part.z;
}

/// Springs and dampers without limit; `total` is squared.
[[gnu::always_inline]] inline void load(const Constants& k, double time_step, Contact& c) {
  const double d = std::max(c.overlap, 0.0);
  const double kn = 4.0 / 3.0 * k.young * c.contact_radius;
  const double kt = 8.0 * k.shear * c.contact_radius;
  // Both dampers grow with the fourth root of R d: one root does for two. It stays here, where the
  // divider has nothing else to do.
  const double shared = std::sqrt(c.contact_radius * c.mass);
  const double excess =
      std::min(k_phase_excess * time_step * time_step * kt * c.inverse_mass, k_max_phase_excess);
  const double gn = k.damping * k.normal_root * shared;
  const double gt =
      std::min(k.damping * k.tangential_root * shared * (1.0 - k_damper_lead * excess),
               c.mass * (k_max_tangential_damping / time_step));
  const double tx = c.vx - c.vn * c.nx;
  const double ty = c.vy - c.vn * c.ny;
  const double tz = c.vz - c.vn * c.nz;
  // sqrt(k_t) over the step in mean, in its value at the end, for an overlap that changes evenly:
  // 0.8 (1 - r^5) / (1 - r^4) with the fourth root r of the ratio of overlaps, within 0.03; 0.8 of
  // a contact that has just begun. `keep` holds the restored length as well, which differs from 1
  // by the square of the angle turned: of third order here.
  const double bent = std::min(c.keep, 1.5);
  const double mean = (0.8 + bent * (0.3 * bent - 0.1) + 0.8 * (c.keep - bent)) * (1.0 - excess);
  const double un = c.ux * c.nx + c.uy * c.ny + c.uz * c.nz;
  c.sx = c.keep * c.sx + mean * (c.ux - un * c.nx);
  c.sy = c.keep * c.sy + mean * (c.uy - un * c.ny);
  c.sz = c.keep * c.sz + mean * (c.uz - un * c.nz);
  c.dx = gt * tx;
  c.dy = gt * ty;
  c.dz = gt * tz;
  c.fx = -kt * c.sx - c.dx;
  c.fy = -kt * c.sy - c.dy;
  c.fz = -kt * c.sz - c.dz;
  c.total = c.fx * c.fx + c.fy * c.fy + c.fz * c.fz;
  c.stiffness = kt;
  c.normal_force = kn * d - gn * c.vn;
  c.normal_stiffness = kn;
}

/// What the leapfrog makes of the swing that tangential and rolling spring have together: the force
/// as it will be, \f$ F + \tfrac{1}{12} dt^2 \ddot F \f$, by the couple's part of \f$ \ddot F
/// \f$, \f$ k_t (R_i/I_i - R_j/I_j)\, M \times n \f$; docs/theory/grains.md, eq. (18). The couple
/// is that of a step ago: of an order higher.
[[gnu::always_inline]] inline void add_rolling(double time_step, Contact& c) {
  const double most = c.mass * (k_max_phase_excess / k_phase_excess);
  const double by = std::min(c.stiffness * time_step * time_step, most) * (1.0 / 12.0) * c.turning;
  c.fx += by * (c.my * c.nz - c.mz * c.ny);
  c.fy += by * (c.mz * c.nx - c.mx * c.nz);
  c.fz += by * (c.mx * c.ny - c.my * c.nx);
  c.total = c.fx * c.fx + c.fy * c.fy + c.fz * c.fz;
}

/// Below zero where a contact begins or ends within a step, and where it may end within two. What
/// only is within reach of a bridge does neither.
[[gnu::always_inline]] inline double distance_from_edge(double time_step, const Contact& c) {
  const double way = c.vn * time_step;
  const double edge =
      std::min(c.overlap - std::abs(way), c.normal_force - 2.5 * c.normal_stiffness * way);
  return c.overlap > 0.0 ? edge : 0.0;
}

/// Where a contact begins or ends within a step, dampers and what ends get their weight. Returns by
/// what the tangential force of the last two steps is to be multiplied after slide().
inline double weigh_edge(double friction, double time_step, Contact& c) {
  const double d = c.overlap;
  if (!(d > 0.0)) return 1.0;
  const double elastic = c.normal_stiffness * d;
  const double damped = c.normal_force;
  const double edge = edge_weight(d, std::abs(c.vn) * time_step);
  c.normal_force = elastic + edge * (damped - elastic);
  if (c.vn <= 0.0) {
    c.fx += (1.0 - edge) * c.dx;
    c.fy += (1.0 - edge) * c.dy;
    c.fz += (1.0 - edge) * c.dz;
    c.total = c.fx * c.fx + c.fy * c.fy + c.fz * c.fz;
    return 1.0;
  }
  const double limit = friction * std::max(c.normal_force, 0.0);
  const double speed = c.vn + 0.5 * damped / c.mass * time_step;
  if (!(speed > 0.0 && limit > 0.0 && c.total > 0.0)) return 1.0;
  const double total = std::sqrt(c.total);
  const double steps = d / (speed * time_step);
  // The spring's growth is along the tangential part of the velocity alone; the force has no other.
  const double slip =
      (c.vx - c.vn * c.nx) * c.fx + (c.vy - c.vn * c.ny) * c.fy + (c.vz - c.vn * c.nz) * c.fz;
  const double growth = -c.stiffness * time_step * slip / total;
  const ForceToTheEnd force(steps, total, growth, friction * elastic, friction * damped);
  if (force.holds(steps - 2.0)) return 1.0;
  const double given = force.holds(steps - 1.0) ? force.last_but_one(steps) : force.last(steps);
  return std::min(given, limit) / std::min(total, limit);
}

/// Coulomb: spring and damper share the limit.
[[gnu::always_inline]] inline void slide(const Constants& k, Contact& c) {
  const double fn = c.normal_force;
  const double limit = k.friction * std::max(fn, 0.0);
  const double cap = std::min(1.0, limit / std::max(c.total, k_tiny));
  const double hold = cap < 1.0 ? 0.0 : 1.0;
  const double back = (hold - 1.0) * c.compliance;
  c.sx = hold * c.sx + back * (cap * c.fx + c.dx);
  c.sy = hold * c.sy + back * (cap * c.fy + c.dy);
  c.sz = hold * c.sz + back * (cap * c.fz + c.dz);
  c.fx = fn * c.nx + cap * c.fx;
  c.fy = fn * c.ny + cap * c.fy;
  c.fz = fn * c.nz + cap * c.fz;
}

}  // namespace dust::model::hertz_mindlin
