// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace dust::test {

/// A sphere that meets a plane and sticks to it (friction has no limit but that a contact which
/// pulls does not hold), with one tangential direction: the laws' own differential equations, for
/// an integration of fourth order.
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
  double restitution = 1.0;
  double rolling_friction = 0.8, rolling_damping = 0.1;  ///< mu_r; eta_r of epsd
  double attraction = 0.0;                               ///< [N] while in touch
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
  const auto rate = [&](double t, const State& x) -> State {
    const auto [d, u, v, s, y, couple] = x;
    const double depth = std::max(d, 0.0);
    double kn = 0.0, kt = 0.0, gt = 0.0;
    if (is_hertz) {
      const double a = std::sqrt(r * depth);
      kn = 4.0 / 3.0 * c.effective_young * a;
      kt = 8.0 * c.effective_shear * a;
      gt = damping * std::sqrt(5.0 / 6.0) * std::sqrt(kt * m);
    } else if (d >= 0.0) {
      kn = c.normal_stiffness;
      kt = c.stiffness_ratio * kn;
      gt = damping * std::sqrt(kt * (2.0 / 7.0) * m);
    }
    const double normal = c.normal_force(d, u);
    const double lever = 1.0 - 0.5 * d / r;
    const double slip = v + lever * s - c.wall(t);
    const bool holds = normal > 0.0;
    const double force = holds ? std::sqrt(kt) * y + gt * slip : 0.0;
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
            (c.attraction - normal) / m,
            -force / m,
            (-2.5 * lever * force + 2.5 * (couple + brake)) / m,
            holds ? std::sqrt(kt) * slip : 0.0,
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
    const double most = c.rolling_friction * std::abs(c.normal_force(x[0], x[1]));
    x[5] = std::clamp(x[5], -most, most);
  } while (x[0] > 0.0);
  return {-x[1], x[2], x[3]};
}

}  // namespace dust::test
