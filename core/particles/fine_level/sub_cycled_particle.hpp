// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "particles/fine_level/deferred_impulse.hpp"
#include "particles/fine_level/fine_scene.hpp"
#include "particles/motion/leapfrog.hpp"

#include <cstdint>

namespace dust::particles {

/// A particle while it is sub-cycled: a fine one, or a coarse one that a cluster is near, which has
/// made its coarse step and is followed along it with impulses; docs/theory/grains.md, eq. (12).
struct SubCycledParticle {
  std::int32_t particle = 0;
  bool is_coarse = false;
  double radius = 0.0, inverse_mass = 0.0, weight = 1.0, relaxation_rate = 0.0;
  sdk::Vec3 position, velocity, angular_velocity, half_velocity, half_angular_velocity;
  sdk::Vec3 target, gravity, received;
  double since_kick = 0.0;             ///< [s]
  sdk::Vec3 displacement, angle;       ///< [m], [rad] of the last sub-step
  sdk::Vec3 impulse, angular_impulse;  ///< of the contacts in this sub-step
  double relaxed_over = -1.0;          ///< [s] that `relaxation` is of
  leapfrog::Relaxation relaxation;
  sdk::Vec3 force;  ///< [N] mean over the last sub-step

  // Of a coarse one: its own step without fine particles,
  sdk::Vec3 step_velocity, step_angular_velocity;  ///< [m/s], [rad/s] over the step
  sdk::Vec3 slow_kick, slow_angular_kick;          ///< what the step has added to them
  // and what fine particles have added to that.
  sdk::Vec3 added_displacement, added_angle;  ///< [m], [rad]

  /// One sub-step: kick by the impulses with exact drag, drift, prediction.
  void advance(double sub_step);
};

/// A fine particle as it stands; the index is among all particles.
SubCycledParticle load_fine(const FineScene& scene, std::int32_t particle);
/// A coarse particle as it was before its step, for sub-steps of `sub_step` [s].
SubCycledParticle load_coarse(const FineScene& scene, const DeferredImpulses& deferred,
                              std::int32_t particle, double sub_step);
/// A fine particle back to where it came from; its force [N] to `force`.
void store_fine(const SubCycledParticle& p, ParticleStore& particles, double* force);
/// Adds to a coarse particle what fine ones have done to it, and returns what waits for its next
/// step: its row shows the mean velocity of the step, its way over its time, which springs go by.
/// Nothing was done: returns false.
bool store_coarse(const SubCycledParticle& p, const FineScene& scene, DeferredImpulse& deferred);

}  // namespace dust::particles
