// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace dust::model::cdt {

/// What the relative rotation is divided by to give the couple's direction.
enum class NormalisedBy {
  rolling,  ///< the part across the normal: the couple has its full size
  rotation  ///< the whole, with its part about the normal: the couple is smaller
};

/// Largest couple [m* R*^2 omega/dt], for the sake of grains with several contacts.
inline constexpr double k_stop = 0.05;

/// One contact. n: unit normal, w: angular velocity of i relative to j [rad/s], m: couple on i [N
/// m], out.
struct Rolling {
  double nx, ny, nz, wx, wy, wz;
  double radius;        ///< [m] R*
  double mass;          ///< [kg] m*
  double normal_force;  ///< [N]
  double mx, my, mz;
};

/// Constant couple against the relative rolling velocity:
/// \f$ M = -\mu_r R^* |F_n|\, \omega_r / |\omega_r| \f$, but at most
/// \f$ \tfrac1{20} m^* R^{*2} |\omega_r| / \Delta t \f$. \f$ \omega_r \f$ is the relative angular
/// velocity without its part about the normal.
///
/// The second bound takes at most an eighth of the rotation in a step: 2/5 m* R*^2 is never above
/// the inertia of the relative rotation of two spheres. The rate a law sees is carried half a step
/// ahead, which is stable while the couples of all contacts of a grain take less than the whole of
/// it in a step. They add up: two walls of a corner brake each axis, and so do eight of twelve
/// equal neighbours, of each a 32nd and twice that where neighbours turn against each other; the
/// tangential dampers brake the spin as well. At half a rotation for each contact a grain in a
/// corner would spin for ever (own derivation).
///
/// The couple vanishes with the velocity: it cannot hold a grain on a slope. Below the threshold,
/// \f$ \tan\theta < \mu_r \f$, the second bound balances the weight,
/// \f$ \tfrac1{20} m R^2 \omega / \Delta t = m g R \sin\theta \f$ with \f$ v = \omega R \f$, and
/// the grain creeps at \f$ v = 20 g \sin\theta\, \Delta t \f$ (own derivation; verified in
/// tests/verification/contact). Without the bound, as in other codes, the couple of constant size
/// changes its sign from step to step, and holds the grain as little. For heaps take epsd2.
/// Source: model A of Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269,
/// doi:10.1016/j.powtec.2010.09.030; Zhou, Wright, Yang, Xu, Yu, Physica A 269 (1999) 536,
/// doi:10.1016/S0378-4371(99)00183-1.
///
/// With NormalisedBy::rotation as in LIGGGHTS (`rolling_friction cdt`), which normalises the
/// relative rotation first and takes its part about the normal away then: \f$ |M| = \mu_r R^* |F_n|
/// \sin\alpha \f$, alpha between the rotation and the normal. The bound is the same.
template <NormalisedBy by = NormalisedBy::rolling>
[[gnu::always_inline]] inline void evaluate(double friction, double time_step, Rolling& c) {
  constexpr double k_tiny = 1e-290;
  const double wn = c.wx * c.nx + c.wy * c.ny + c.wz * c.nz;
  const double rx = c.wx - wn * c.nx;
  const double ry = c.wy - wn * c.ny;
  const double rz = c.wz - wn * c.nz;
  constexpr bool k_is_whole = by == NormalisedBy::rotation;
  const double speed = k_is_whole ? std::sqrt(c.wx * c.wx + c.wy * c.wy + c.wz * c.wz)
                                  : std::sqrt(rx * rx + ry * ry + rz * rz);
  const double limit = friction * c.radius * std::abs(c.normal_force);
  const double stop = k_stop * c.mass * c.radius * c.radius / time_step;
  // Zero without load, also for a grain that turns.
  const double slope = std::min(limit / std::max(speed, k_tiny), stop);
  c.mx = -slope * rx;
  c.my = -slope * ry;
  c.mz = -slope * rz;
}

}  // namespace dust::model::cdt
