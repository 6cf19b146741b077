// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/prediction.hpp"

#include "contact/nearest_image.hpp"
#include "particles/motion/free_acceleration.hpp"
#include "particles/time_steps.hpp"

#include <algorithm>
#include <cmath>

namespace dust::particles {
namespace {

using sdk::Vec3;

/// Gap, in radii of the fine particle, below which a partner always counts as in reach.
constexpr double k_reach_margin = 0.05;
/// Of a Hertz contact, the half period at its deepest over its duration: pi / sqrt(15/8) / 2.94. A
/// collision then has the same step on its way in, where its speed counts, and at its deepest,
/// where the overlap does.
constexpr double k_deepest = 0.78;

double sum_of_parts(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// A partner as it stood at the beginning of the step. A coarse one has made its step along a
/// straight line.
struct Partner {
  Vec3 velocity, position;

  Partner(const FineScene& scene, std::size_t j) {
    const ParticleStore& s = scene.particles;
    const bool is_fine = j >= scene.coarse_count;
    velocity = vector_of(is_fine ? s.velocity(j) : s.half_velocity(j));
    position = vector_of(s.position(j));
    if (!is_fine) position -= scene.steps.coarse_step * velocity;
  }
};

/// A cheap answer for most entries of a list: true only if the partner is out of reach by the rule
/// of predict_contact(). Sums of components stand for the norms they bound, so there is no root.
bool is_far(const FineScene& scene, std::size_t i, std::size_t j, double extra_speed) {
  const ParticleStore& s = scene.particles;
  const double step = scene.steps.coarse_step;
  const Vec3 position = vector_of(s.position(i));
  const Partner other(scene, j);
  const Vec3 d = contact::nearest_image(scene.images, &other.position.x, &position.x);
  const double radius = s.radius(i);
  const Vec3 free = free_acceleration(scene.particles, scene.gravity, i);
  const double speed = sum_of_parts(vector_of(s.velocity(i)) - other.velocity) +
                       sum_of_parts(free) * step + extra_speed;
  const double reach =
      (1.0 + k_reach_margin) * radius + s.radius(j) + scene.laws.largest_range() + speed * step;
  return dot(d, d) > reach * reach;
}

/// The two sides of a contact as they approach each other.
struct Approach {
  double gap = 0.0;               ///< [m]
  double effective_radius = 0.0;  ///< [m]
  double effective_mass = 0.0;    ///< [kg]
  double surface_speed = 0.0;     ///< [m/s] of a surface
  Vec3 normal;                    ///< from the partner
  Vec3 relative;                  ///< [m/s] velocity of the fine particle, less a particle's
  std::int32_t law = 0;
};

Approach approach_to_surface(const FineScene& scene, std::size_t i, std::int32_t number) {
  const ParticleStore& s = scene.particles;
  const Surface& surface = scene.surface(number);
  const double radius = s.radius(i);
  const auto point = surface.nearest(vector_of(s.position(i)));
  return {.gap = point.distance - radius,
          .effective_radius = radius,
          .effective_mass = 1.0 / s.inverse_mass(i),
          .surface_speed = surface.displacing_speed,
          .normal = point.normal,
          .relative = vector_of(s.velocity(i)),
          .law = scene.laws.index(s.material(i), surface.material)};
}

Approach approach_to_particle(const FineScene& scene, std::size_t i, std::size_t j) {
  const ParticleStore& s = scene.particles;
  const Vec3 position = vector_of(s.position(i));
  const double radius = s.radius(i);
  const double partner = s.radius(j);
  const Partner other(scene, j);
  const Vec3 d = contact::nearest_image(scene.images, &other.position.x, &position.x);
  const double distance = std::max(norm(d), 1e-300);
  return {.gap = distance - radius - partner,
          .effective_radius = radius * partner / (radius + partner),
          .effective_mass = 1.0 / (s.inverse_mass(i) + s.inverse_mass(j)),
          .normal = d / distance,
          .relative = vector_of(s.velocity(i)) - other.velocity,
          .law = scene.laws.index(s.material(i), s.material(j))};
}

/// [s] that a contact needs which is approached at this speed, or has this overlap already.
double stable_step(const PairLaws& laws, const Approach& a, double speed) {
  double overlap = std::max(-a.gap, 0.0);
  if (laws.cohesion) {
    overlap = std::max(overlap, laws.cohesion->resting_overlap(a.effective_radius));
  }
  return std::min(
             laws.contact->collision_time(a.effective_radius, a.effective_mass,
                                          std::max(speed, 1e-12)),
             laws.contact->half_period(a.effective_radius, a.effective_mass, overlap) / k_deepest) /
         k_steps_per_collision;
}

}  // namespace

ContactPrediction predict_contact(const FineScene& scene, std::size_t entry, double extra_speed) {
  const double step = scene.steps.coarse_step;
  const auto i = static_cast<std::size_t>(scene.contacts.a[entry]);
  const std::int32_t b = scene.contacts.b[entry];
  const bool is_touching = scene.contacts.is_touching[entry] != 0;
  if (b >= 0 && !is_touching && is_far(scene, i, static_cast<std::size_t>(b), extra_speed)) {
    return {};
  }
  const Approach a = b < 0 ? approach_to_surface(scene, i, -1 - b)
                           : approach_to_particle(scene, i, static_cast<std::size_t>(b));
  double gain = norm(free_acceleration(scene.particles, scene.gravity, i)) * step;
  if (b < 0) gain += a.surface_speed;
  ContactPrediction out;
  out.speed = norm(a.relative) + gain;
  const PairLaws& laws = scene.law(a.law);
  // The laws' range is that of the largest particles; dust feels sand from much nearer.
  const double range = laws.cohesion ? laws.range_of(a.effective_radius) : laws.range;
  const double margin = k_reach_margin * scene.particles.radius(i) + range;
  out.is_near = is_touching || a.gap < (out.speed + extra_speed) * step + margin;
  if (!out.is_near) return out;
  const double approach = std::max(0.0, -dot(a.relative, a.normal)) + gain + extra_speed;
  out.stable_step = stable_step(laws, a, approach);
  return out;
}

}  // namespace dust::particles
