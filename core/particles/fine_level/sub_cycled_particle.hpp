// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "particles/fine_level/deferred_impulse.hpp"
#include "particles/fine_level/fine_scene.hpp"
#include "particles/motion/leapfrog.hpp"

#include <cstdint>

namespace dust::particles {

/// A vector of the translation and one of the rotation: velocities [m/s], [rad/s], displacements
/// [m], [rad], or impulses [N s], [N m s].
struct LinearAngular {
  sdk::Vec3 linear, angular;
};

/// Drag on a sub-cycled particle: it relaxes towards `target` at `rate`.
struct SubCycledDrag {
  double rate = 0.0;   ///< [1/s]
  sdk::Vec3 target;    ///< [m/s]
  sdk::Vec3 received;  ///< [N s] impulse so far
  double over = -1.0;  ///< [s] that `factors` are of
  leapfrog::Relaxation factors;
};

/// A coarse particle that is sub-cycled: its own step without fine particles, and what those have
/// added to it.
struct CoarseMotion {
  LinearAngular velocity;  ///< over the step
  LinearAngular kick;      ///< what the step has added to the velocity
  LinearAngular added;     ///< displacement by fine particles
};

/// A particle while it is sub-cycled: a fine one, or a coarse one that a cluster is near, which has
/// made its coarse step and is followed along it with impulses; docs/theory/grains.md, eq. (12).
struct SubCycledParticle {
  std::int32_t particle = 0;
  bool is_coarse = false;
  double radius = 0.0, inverse_mass = 0.0, weight = 1.0;
  sdk::Vec3 position, gravity;
  LinearAngular velocity;       ///< predicted to the instant of the position
  LinearAngular half_velocity;  ///< after the last kick
  double since_kick = 0.0;      ///< [s]
  LinearAngular displacement;   ///< of the last sub-step
  LinearAngular impulse;        ///< of the contacts in this sub-step
  sdk::Vec3 force;              ///< [N] mean over the last sub-step
  SubCycledDrag drag;           ///< of a fine one
  CoarseMotion coarse;          ///< of a coarse one
};

/// One sub-step [s]: kick by the impulses with exact drag, drift, prediction.
void advance(SubCycledParticle& p, double sub_step);

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
