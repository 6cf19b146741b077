// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/sub_cycled_particle.hpp"

namespace dust::particles {

using sdk::Vec3;

void advance(SubCycledParticle& p, double sub_step) {
  const double kick = p.since_kick + 0.5 * sub_step;
  if (kick != p.drag.over) {
    p.drag.over = kick;
    p.drag.factors = leapfrog::relaxation(p.drag.rate, kick);
  }
  const leapfrog::Relaxation& relaxation = p.drag.factors;
  LinearAngular& half = p.half_velocity;
  const Vec3 old = half.linear;
  const Vec3 push = kick * p.gravity + p.inverse_mass * p.impulse.linear;
  leapfrog::kick(old, push, p.drag.target, relaxation.decay, relaxation.mean, half.linear);
  Vec3 by_drag;
  leapfrog::drag_impulse(half.linear, old, push, p.inverse_mass, by_drag);
  p.drag.received += by_drag;
  const double ahead = 0.5 * sub_step / kick;
  leapfrog::predict(half.linear, old, ahead * relaxation.decay, p.velocity.linear);
  p.displacement.linear = sub_step * half.linear;
  p.position += p.displacement.linear;
  double inverse_inertia = 0.0;
  leapfrog::inverse_inertia(p.inverse_mass, p.radius, inverse_inertia);
  const Vec3 angular_kick = inverse_inertia * p.impulse.angular;
  half.angular += angular_kick;
  p.velocity.angular = half.angular + ahead * angular_kick;
  p.displacement.angular = sub_step * half.angular;
  if (p.is_coarse) {
    p.coarse.added.linear += sub_step * (half.linear - p.coarse.velocity.linear);
    p.coarse.added.angular += sub_step * (half.angular - p.coarse.velocity.angular);
  }
  p.force = p.impulse.linear / kick;
  p.since_kick = 0.5 * sub_step;
  p.impulse = {};
}

SubCycledParticle load_fine(const FineScene& scene, std::int32_t particle) {
  const ParticleStore& s = scene.particles;
  const auto n = static_cast<std::size_t>(particle);
  const double* drag = s.drag(n);
  SubCycledParticle p;
  p.particle = particle;
  p.radius = s.radius(n);
  p.inverse_mass = s.inverse_mass(n);
  p.weight = s.weight(n);
  p.drag.rate = s.relaxation_rate(n);
  p.position = vector_of(s.position(n));
  p.velocity = {vector_of(s.velocity(n)), vector_of(s.rotation(n))};
  p.half_velocity = {vector_of(s.half_velocity(n)), vector_of(s.half_rotation(n))};
  p.since_kick = s.time_since_kick(n);
  p.displacement = {2.0 * p.since_kick * p.half_velocity.linear,
                    2.0 * p.since_kick * p.half_velocity.angular};
  p.drag.target = vector_of(drag);
  p.gravity = vector_of(scene.gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material(n)));
  if (s.has_fluid()) p.drag.received = vector_of(s.impulse(n));
  return p;
}

SubCycledParticle load_coarse(const FineScene& scene, const DeferredImpulses& deferred,
                              std::int32_t particle, double sub_step) {
  const ParticleStore& s = scene.particles;
  const auto n = static_cast<std::size_t>(particle);
  SubCycledParticle p;
  p.particle = particle;
  p.is_coarse = true;
  p.radius = s.radius(n);
  p.inverse_mass = s.inverse_mass(n);
  p.weight = s.weight(n);
  p.half_velocity = {vector_of(s.half_velocity(n)), vector_of(s.half_rotation(n))};
  p.coarse.velocity = p.velocity = p.half_velocity;
  p.position = vector_of(s.position(n)) - scene.steps.coarse_step * p.coarse.velocity.linear;
  p.since_kick = 0.5 * sub_step;
  // The step has left a velocity predicted from the kick, half of it less what drag takes.
  const double drag = s.decay(n);
  p.coarse.kick.linear = (2.0 / drag) * (vector_of(s.velocity(n)) - p.coarse.velocity.linear);
  p.coarse.kick.angular = 2.0 * (vector_of(s.rotation(n)) - p.coarse.velocity.angular);
  if (const DeferredImpulse* before = deferred.find(particle)) {
    p.velocity.linear += before->predicted_velocity;
    p.velocity.angular += before->predicted_angular_velocity;
  }
  return p;
}

void store_fine(const SubCycledParticle& p, ParticleStore& s, double* force) {
  const auto n = static_cast<std::size_t>(p.particle);
  for (int d = 0; d < 3; ++d) {
    s.position(n)[d] = p.position[d];
    s.velocity(n)[d] = p.velocity.linear[d];
    s.rotation(n)[d] = p.velocity.angular[d];
    s.half_velocity(n)[d] = p.half_velocity.linear[d];
    s.half_rotation(n)[d] = p.half_velocity.angular[d];
    if (s.has_fluid()) s.impulse(n)[d] = p.drag.received[d];
    force[d] = p.force[d];
  }
  s.set_time_since_kick(n, p.since_kick);
}

bool store_coarse(const SubCycledParticle& p, const FineScene& scene, DeferredImpulse& deferred) {
  const Vec3 gain = p.half_velocity.linear - p.coarse.velocity.linear;
  const Vec3 spin = p.half_velocity.angular - p.coarse.velocity.angular;
  if (dot(gain, gain) + dot(p.coarse.added.linear, p.coarse.added.linear) + dot(spin, spin) +
          dot(p.coarse.added.angular, p.coarse.added.angular) ==
      0.0) {
    return false;
  }
  const double inverse_step = 1.0 / scene.steps.coarse_step;
  ParticleStore& s = scene.particles;
  const auto n = static_cast<std::size_t>(p.particle);
  deferred.particle = p.particle;
  for (int d = 0; d < 3; ++d) {
    const auto k = 4 * n + static_cast<std::size_t>(d);
    const double mean = inverse_step * p.coarse.added.linear[d];
    const double mean_spin = inverse_step * p.coarse.added.angular[d];
    s.position(n)[d] += p.coarse.added.linear[d];
    s.velocity(n)[d] += p.velocity.linear[d] - p.coarse.velocity.linear[d];
    s.rotation(n)[d] += p.velocity.angular[d] - p.coarse.velocity.angular[d];
    s.half_velocity(n)[d] += mean;
    s.half_rotation(n)[d] += mean_spin;
    deferred.velocity[d] = gain[d] - mean;
    deferred.angular_velocity[d] = spin[d] - mean_spin;
    deferred.predicted_velocity[d] = p.velocity.linear[d] - p.half_velocity.linear[d];
    deferred.predicted_angular_velocity[d] = p.velocity.angular[d] - p.half_velocity.angular[d];
    if (!scene.contact_force.empty()) {
      scene.contact_force[k] += inverse_step * gain[d] / p.inverse_mass;
    }
  }
  return true;
}

}  // namespace dust::particles
