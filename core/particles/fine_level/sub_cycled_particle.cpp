// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/sub_cycled_particle.hpp"

namespace dust::particles {

using sdk::Vec3;

void SubCycledParticle::advance(double sub_step) {
  const double kick = since_kick + 0.5 * sub_step;
  if (kick != relaxed_over) {
    relaxed_over = kick;
    relaxation = leapfrog::relaxation(relaxation_rate, kick);
  }
  const Vec3 old = half_velocity;
  const Vec3 push = kick * gravity + inverse_mass * impulse;
  leapfrog::kick(old, push, target, relaxation.decay, relaxation.mean, half_velocity);
  Vec3 by_drag;
  leapfrog::drag_impulse(half_velocity, old, push, inverse_mass, by_drag);
  received += by_drag;
  const double ahead = 0.5 * sub_step / kick;
  leapfrog::predict(half_velocity, old, ahead * relaxation.decay, velocity);
  displacement = sub_step * half_velocity;
  position += displacement;
  double inverse_inertia = 0.0;
  leapfrog::inverse_inertia(inverse_mass, radius, inverse_inertia);
  const Vec3 angular_kick = inverse_inertia * angular_impulse;
  half_angular_velocity += angular_kick;
  angular_velocity = half_angular_velocity + ahead * angular_kick;
  angle = sub_step * half_angular_velocity;
  if (is_coarse) {
    added_displacement += sub_step * (half_velocity - step_velocity);
    added_angle += sub_step * (half_angular_velocity - step_angular_velocity);
  }
  force = impulse / kick;
  since_kick = 0.5 * sub_step;
  impulse = angular_impulse = {};
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
  p.relaxation_rate = drag[3];
  p.position = vector_of(s.position(n));
  p.velocity = vector_of(s.velocity(n));
  p.angular_velocity = vector_of(s.rotation(n));
  p.half_velocity = vector_of(s.half_velocity(n));
  p.half_angular_velocity = vector_of(s.half_rotation(n));
  p.since_kick = s.time_since_kick(n);
  p.displacement = 2.0 * p.since_kick * p.half_velocity;
  p.angle = 2.0 * p.since_kick * p.half_angular_velocity;
  p.target = vector_of(drag);
  p.gravity = vector_of(scene.gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material(n)));
  if (s.has_fluid()) p.received = vector_of(s.impulse(n));
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
  p.step_velocity = p.velocity = p.half_velocity = vector_of(s.half_velocity(n));
  p.step_angular_velocity = p.angular_velocity = p.half_angular_velocity =
      vector_of(s.half_rotation(n));
  p.position = vector_of(s.position(n)) - scene.steps.coarse_step * p.step_velocity;
  p.since_kick = 0.5 * sub_step;
  // The step has left a velocity predicted from the kick, half of it less what drag takes.
  const double drag = s.decay(n);
  p.slow_kick = (2.0 / drag) * (vector_of(s.velocity(n)) - p.step_velocity);
  p.slow_angular_kick = 2.0 * (vector_of(s.rotation(n)) - p.step_angular_velocity);
  if (const DeferredImpulse* before = deferred.find(particle)) {
    p.velocity += before->predicted_velocity;
    p.angular_velocity += before->predicted_angular_velocity;
  }
  return p;
}

void store_fine(const SubCycledParticle& p, ParticleStore& s, double* force) {
  const auto n = static_cast<std::size_t>(p.particle);
  for (int d = 0; d < 3; ++d) {
    s.position(n)[d] = p.position[d];
    s.velocity(n)[d] = p.velocity[d];
    s.rotation(n)[d] = p.angular_velocity[d];
    s.half_velocity(n)[d] = p.half_velocity[d];
    s.half_rotation(n)[d] = p.half_angular_velocity[d];
    if (s.has_fluid()) s.impulse(n)[d] = p.received[d];
    force[d] = p.force[d];
  }
  s.half_velocity(n)[3] = p.since_kick;
}

bool store_coarse(const SubCycledParticle& p, const FineScene& scene, DeferredImpulse& deferred) {
  const Vec3 gain = p.half_velocity - p.step_velocity;
  const Vec3 spin = p.half_angular_velocity - p.step_angular_velocity;
  if (dot(gain, gain) + dot(p.added_displacement, p.added_displacement) + dot(spin, spin) +
          dot(p.added_angle, p.added_angle) ==
      0.0) {
    return false;
  }
  const double inverse_step = 1.0 / scene.steps.coarse_step;
  ParticleStore& s = scene.particles;
  const auto n = static_cast<std::size_t>(p.particle);
  deferred.particle = p.particle;
  for (int d = 0; d < 3; ++d) {
    const auto k = 4 * n + static_cast<std::size_t>(d);
    const double mean = inverse_step * p.added_displacement[d];
    const double mean_spin = inverse_step * p.added_angle[d];
    s.position(n)[d] += p.added_displacement[d];
    s.velocity(n)[d] += p.velocity[d] - p.step_velocity[d];
    s.rotation(n)[d] += p.angular_velocity[d] - p.step_angular_velocity[d];
    s.half_velocity(n)[d] += mean;
    s.half_rotation(n)[d] += mean_spin;
    deferred.velocity[d] = gain[d] - mean;
    deferred.angular_velocity[d] = spin[d] - mean_spin;
    deferred.predicted_velocity[d] = p.velocity[d] - p.half_velocity[d];
    deferred.predicted_angular_velocity[d] = p.angular_velocity[d] - p.half_angular_velocity[d];
    if (!scene.contact_force.empty()) {
      scene.contact_force[k] += inverse_step * gain[d] / p.inverse_mass;
    }
  }
  return true;
}

}  // namespace dust::particles
