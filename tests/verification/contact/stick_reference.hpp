// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace dust::test {

/// A sphere that meets a plane and sticks to it, with one tangential direction: the laws' own
/// differential equations, for an integration of fourth order. Friction is so high that its limit
/// is met in the last instants of the contact alone; without it there 0.2 % of the patch speed
/// would be missed.
struct StickCase {
  enum class Normal { hertz, hooke };
  enum class Rolling { none, epsd2, epsd };
  Normal normal = Normal::hertz;
  Rolling rolling = Rolling::none;
  double effective_young = 0.0, effective_shear = 0.0;   ///< [Pa] hertz
  double normal_stiffness = 0.0, stiffness_ratio = 0.0;  ///< [N/m], [-] hooke
  double radius = 0.0, density = 0.0;
  double speed = 0.0;       ///< [m/s] towards the plane
  double tangential = 0.0;  ///< [m/s] of the centre along it
  double restitution = 1.0, friction = 100.0;
  double rolling_friction = 0.8, rolling_damping = 0.1;  ///< mu_r; eta_r of epsd
  /// What cohesion makes of an overlap [m].
  struct Adhesion {
    double contact_overlap;  ///< [m] that the contact law sees
    double attraction;       ///< [N]
  };
  std::function<Adhesion(double)> adhesion = [](double d) { return Adhesion{d, 0.0}; };
  double tear = 0.0;  ///< [m] overlap at which the contact ends
  /// [m/s] of the plane along itself at a time [s] after the first touch.
  std::function<double(double)> wall = [](double) { return 0.0; };

  [[nodiscard]] double mass() const {
    return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
  [[nodiscard]] double damping() const {
    const double l = std::log(restitution);
    return -2.0 * l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
  }
  /// Normal force [N] at an overlap [m] and its rate [m/s].
  [[nodiscard]] double normal_force(double overlap, double rate) const {
    const double d = std::max(overlap, 0.0);
    if (normal == Normal::hooke) {
      return overlap < 0.0
                 ? 0.0
                 : normal_stiffness * d + damping() * std::sqrt(normal_stiffness * mass()) * rate;
    }
    const double a = std::sqrt(radius * d);
    return 4.0 / 3.0 * effective_young * a * d +
           damping() * std::sqrt(5.0 / 6.0) * std::sqrt(2.0 * effective_young * a * mass()) * rate;
  }
};

struct StickResult {
  double normal, tangential;  ///< [m/s] of the centre, after the contact
  double surface;  ///< [m/s] radius times spin; the patch moves with tangential + surface
  [[nodiscard]] double patch() const { return tangential + surface; }
  /// Twice the tangential energy per mass [m2/s2].
  [[nodiscard]] double energy() const { return tangential * tangential + 0.4 * surface * surface; }
};

/// Unknowns: overlap d, its rate, tangential velocity v, surface velocity s = R omega, spring
/// y = sqrt(k_t) xi (its rate is sqrt(k_t) times the slip: the energy y^2 / 2 is kept while k_t
/// changes), rolling couple M over R. Classical Runge-Kutta steps of a 50,000th of the contact;
/// the result changes by less than 1e-6 with half of them.
inline StickResult integrate(const StickCase& c) {
  using State = std::array<double, 6>;
  const double m = c.mass();
  const double r = c.radius;
  const double damping = c.damping();
  const bool is_hertz = c.normal == StickCase::Normal::hertz;
  struct Springs {
    double kn, kt, normal, slip, force, limit;
  };
  const auto springs = [&](double t, const State& x) -> Springs {
    const auto [overlap, u, v, s, y, couple] = x;
    const double d = c.adhesion(overlap).contact_overlap;
    Springs k{};
    double gt = 0.0;
    if (is_hertz) {
      const double a = std::sqrt(r * std::max(d, 0.0));
      k.kn = 4.0 / 3.0 * c.effective_young * a;
      k.kt = 8.0 * c.effective_shear * a;
      gt = damping * std::sqrt(5.0 / 6.0) * std::sqrt(k.kt * m);
    } else if (d >= 0.0) {
      k.kn = c.normal_stiffness;
      k.kt = c.stiffness_ratio * k.kn;
      gt = damping * std::sqrt(k.kt * (2.0 / 7.0) * m);
    }
    k.normal = c.normal_force(d, u);
    k.slip = v + (1.0 - 0.5 * overlap / r) * s - c.wall(t);
    k.force = std::sqrt(k.kt) * y + gt * k.slip;
    k.limit = c.friction * std::max(k.normal, 0.0);
    return k;
  };
  const auto rate = [&](double t, const State& x) -> State {
    const auto [d, u, v, s, y, couple] = x;
    const auto [kn, kt, normal, slip, total, limit] = springs(t, x);
    const double lever = 1.0 - 0.5 * d / r;
    const double force = std::clamp(total, -limit, limit);
    double turning = 0.0, brake = 0.0;  // rate of the couple, dashpot, both over R
    if (c.rolling == StickCase::Rolling::epsd2) turning = -kt * s;
    if (c.rolling == StickCase::Rolling::epsd) {
      const double kr = 2.25 * kn * c.rolling_friction * c.rolling_friction;
      turning = -kr * s;
      const double most = c.rolling_friction * std::abs(normal);
      if (std::abs(couple) < most) {
        brake = -2.0 * c.rolling_damping * std::sqrt(1.4 * m * kr) * s;
        brake = std::clamp(brake, -most - couple, most - couple);
      }
    }
    return {u,
            (c.adhesion(d).attraction - normal) / m,
            -force / m,
            (-2.5 * lever * force + 2.5 * (couple + brake)) / m,
            std::sqrt(kt) * slip,
            turning};
  };
  const double contact =
      is_hertz ? 2.87 * std::pow(m * m / (r * c.effective_young * c.effective_young * c.speed), 0.2)
               : std::numbers::pi * std::sqrt(m / c.normal_stiffness);
  const double dt = contact / 50000.0;
  State x{0.0, c.speed, c.tangential, 0.0, 0.0, 0.0};
  double t = 0.0;
  const auto moved = [](const State& from, const State& by, double h) {
    State to;
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + h * by[k];
    return to;
  };
  do {
    const State k1 = rate(t, x);
    const State k2 = rate(t + 0.5 * dt, moved(x, k1, 0.5 * dt));
    const State k3 = rate(t + 0.5 * dt, moved(x, k2, 0.5 * dt));
    const State k4 = rate(t + dt, moved(x, k3, dt));
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += dt / 6.0 * (k1[k] + 2.0 * k2[k] + 2.0 * k3[k] + k4[k]);
    }
    t += dt;
    // While it slides, the spring holds what the limit leaves beside the damper.
    const Springs k = springs(t, x);
    const double most = c.rolling_friction * std::abs(k.normal);
    x[5] = std::clamp(x[5], -most, most);
    const double excess = k.force - std::clamp(k.force, -k.limit, k.limit);
    if (k.kt > 0.0) x[4] -= excess / std::sqrt(k.kt);
  } while (x[0] > c.tear);
  return {-x[1], x[2], x[3]};
}

}  // namespace dust::test
