// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace dust::model {

/// How the two sides of a contact answer to a couple, for solid spheres. A wall has no inverse
/// mass.
struct TurningSides {
  double inverse_inertia;  ///< [1/(kg m2)] 1/I_i + 1/I_j
  double inertia;          ///< [kg m2] its reciprocal
  double turning;          ///< [1/(kg m)] R_i/I_i - R_j/I_j: what a couple does to the slip

  [[gnu::always_inline]] TurningSides(double radius_i, double radius_j, double inverse_mass_i,
                                      double inverse_mass_j) {
    const double radii = radius_i * radius_j;
    const double both = inverse_mass_i * radius_j * radius_j + inverse_mass_j * radius_i * radius_i;
    // One division for both reciprocals.
    const double all = 1.0 / (radii * both);
    const double inverse = all * both;
    inverse_inertia = 2.5 * both * inverse * inverse;
    inertia = 0.4 * radii * radii * radii * all;
    turning = 2.5 * inverse * (inverse_mass_i * radius_j - inverse_mass_j * radius_i);
  }
};

/// Of h where steps are too long for it.
inline constexpr double k_max_phase_excess = 0.1;
/// [h] By how much the velocity that dampers see is ahead of that of the swing.
inline constexpr double k_damper_lead = 5.5;

/// What the leapfrog makes too much of the swing of a rolling spring of `stiffness` [N m/rad]:
/// \f$ h = \frac{1}{12} k_r dt^2 (1/I_i + 1/I_j) \f$; docs/theory/grains.md, eq. (18).
[[gnu::always_inline]] inline double phase_excess(double stiffness, double time_step,
                                                  double inverse_inertia) {
  return std::min(stiffness * time_step * time_step * (1.0 / 12.0) * inverse_inertia,
                  k_max_phase_excess);
}

/// A couple [N m] as a vector.
struct Couple {
  double x, y, z;
};

/// What a force tangential to a contact, turned by a right angle, adds to the couple of a spring of
/// this excess: \f$ \tfrac{1}{12} dt^2 k_r (R_i/I_i - R_j/I_j) \f$ [m].
[[gnu::always_inline]] inline double lever_of_force(double excess, const TurningSides& sides) {
  return excess * sides.turning * sides.inertia;
}

/// What the tangential part of `force` [N] on i adds to the couple of a spring: the couple as it
/// will be, \f$ M + \tfrac{1}{12} dt^2 \ddot M \f$, by the force's part of \f$ \ddot M \f$. None
/// where it could pass the limit: there the spring does not swing.
[[gnu::always_inline]] inline Couple couple_of_force(double lever, sdk::Vec3 n, sdk::Vec3 force,
                                                     double size, double limit) {
  const Couple c{lever * (n.y * force.z - n.z * force.y), lever * (n.z * force.x - n.x * force.z),
                 lever * (n.x * force.y - n.y * force.x)};
  const double most = size + std::abs(c.x) + std::abs(c.y) + std::abs(c.z);
  const double given = most < limit ? 1.0 : 0.0;
  return {given * c.x, given * c.y, given * c.z};
}

}  // namespace dust::model
