// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::test {

/// A sphere that meets a plane, with one tangential direction.
struct ScalarCase {
  double effective_young, effective_shear;  ///< [Pa] E*, G*
  double density, radius;
  double speed;             ///< [m/s] towards the plane
  double tangential = 0.0;  ///< [m/s] of the centre
  double spin = 0.0;        ///< [rad/s] adds radius times spin to the slip
  double restitution = 1.0, friction = 0.0;
};

/// How the tangential spring follows the changing stiffness, and where the contact point is.
enum class SpringForm {
  rescaled,  ///< xi sqrt(k_t) kept; the contact point halves the overlap: the engine's law
  total      ///< xi kept, F = k_t(d) xi; the contact point at the full radius
};

struct ScalarResult {
  double normal, tangential;  ///< [m/s] of the centre
  double surface;             ///< [m/s] radius times spin
  [[nodiscard]] double slip() const { return tangential + surface; }
};

/// The same physics once more, as scalars: damped Hertz normal force, tangential spring and damper
/// of one coefficient, both within mu max(F_n, 0); forward steps so small that their number does
/// not show (a 20,000th of the contact: changes below 1e-4 when halved).
inline ScalarResult impact(const ScalarCase& c, SpringForm form) {
  const double mass = c.density * 4.0 / 3.0 * std::numbers::pi * std::pow(c.radius, 3);
  const double l = std::log(c.restitution);
  const double damping =
      -2.0 * std::sqrt(5.0 / 6.0) * l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
  const double dt =
      2.87 *
      std::pow(mass * mass / (c.radius * c.effective_young * c.effective_young * c.speed), 0.2) /
      20000.0;
  double overlap = 0.0, towards = c.speed, along = c.tangential, surface = c.radius * c.spin;
  double spring = 0.0, stiffness = 0.0;
  for (;;) {
    overlap += towards * dt;
    if (overlap < 0.0) break;
    const double root = std::sqrt(c.radius * overlap);
    const double kt = 8.0 * c.effective_shear * root;
    const double gt = damping * std::sqrt(kt * mass);
    const double fn = 4.0 / 3.0 * c.effective_young * root * overlap +
                      damping * std::sqrt(2.0 * c.effective_young * root * mass) * towards;
    const double lever = form == SpringForm::rescaled ? 1.0 - 0.5 * overlap / c.radius : 1.0;
    const double slip = along + lever * surface;
    if (form == SpringForm::rescaled && stiffness > 0.0) spring *= std::sqrt(stiffness / kt);
    stiffness = kt;
    spring += slip * dt;
    double force = kt * spring + gt * slip;
    const double limit = c.friction * std::max(fn, 0.0);
    if (std::abs(force) > limit) {
      force = std::copysign(limit, force);
      spring = (force - gt * slip) / kt;
    }
    towards -= fn / mass * dt;
    along -= force / mass * dt;
    surface -= 2.5 * lever * force / mass * dt;
  }
  return {-towards, along, surface};
}

}  // namespace dust::test
