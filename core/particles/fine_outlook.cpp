// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_outlook.hpp"

#include <algorithm>
#include <cmath>

namespace dust::particles {
namespace {

using sdk::Vec3;

/// Gap, in radii of the fine grain, below which a partner always counts as in reach.
constexpr double k_reach_margin = 0.05;
/// Steps per contact.
constexpr double k_steps_per_contact = 15.0;
/// Of a Hertz contact, the half period at its deepest over its duration: pi / sqrt(15/8) / 2.94. A
/// collision then has the same step on its way in, where its speed counts, and at its deepest,
/// where the overlap does.
constexpr double k_deepest = 0.78;

double sum_of_parts(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// A cheap answer for most entries of a list: true only if the partner is out of reach by the rule
/// of look_out(). Sums of components stand for the norms they bound, so there is no root.
bool is_far(const Dem::Impl& dem, std::size_t i, std::int32_t b, double extra_speed) {
  const GrainStore& s = dem.store;
  const double step = dem.steps.coarse_step;
  const auto j = static_cast<std::size_t>(b);
  const bool is_fine = j >= dem.coarse_count;
  const Vec3 position = vec(s.position.data() + 4 * i);
  const Vec3 velocity = vec(s.velocity(i));
  const Vec3 other = vec(is_fine ? s.velocity(j) : s.half_velocity(j));
  Vec3 place = vec(s.position.data() + 4 * j);
  if (!is_fine) place -= step * other;
  const Vec3 d = dem.separation(&place.x, &position.x);
  const double radius = s.position[4 * i + 3];
  const double* g = dem.gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material[i]);
  const double* action = s.action_of(i);
  const Vec3 free = vec(g) + action[3] * (vec(action) - velocity);
  const double speed = sum_of_parts(velocity - other) + sum_of_parts(free) * step + extra_speed;
  const double reach =
      (1.0 + k_reach_margin) * radius + s.position[4 * j + 3] + dem.largest_range + speed * step;
  return dot(d, d) > reach * reach;
}

}  // namespace

Outlook look_out(const Dem::Impl& dem, std::size_t entry, double extra_speed) {
  const GrainStore& s = dem.store;
  const double step = dem.steps.coarse_step;
  const auto i = static_cast<std::size_t>(dem.fine.a[entry]);
  const std::int32_t b = dem.fine.b[entry];
  const Vec3 position = vec(s.position.data() + 4 * i);
  const Vec3 velocity = vec(s.velocity(i));
  const double radius = s.position[4 * i + 3];
  if (b >= 0 && dem.fine.is_touching[entry] == 0 && is_far(dem, i, b, extra_speed)) return {};
  double gap = 0.0;
  double reduced_radius = radius;
  double mass = 1.0 / s.velocity(i)[3];
  Vec3 normal;
  Vec3 relative = velocity;
  std::int32_t law = 0;
  if (b < 0) {
    const Surface& surface = dem.surfaces[static_cast<std::size_t>(-1 - b)];
    const auto point = surface.contact(position);
    gap = point.distance - radius;
    normal = point.normal;
    law = dem.law_of(s.material[i], surface.material);
  } else {
    const auto j = static_cast<std::size_t>(b);
    const bool is_fine = j >= dem.coarse_count;
    const Vec3 other = vec(is_fine ? s.velocity(j) : s.half_velocity(j));
    Vec3 place = vec(s.position.data() + 4 * j);
    if (!is_fine) place -= step * other;
    const Vec3 d = dem.separation(&place.x, &position.x);
    const double distance = std::max(norm(d), 1e-300);
    const double partner = s.position[4 * j + 3];
    gap = distance - radius - partner;
    normal = d / distance;
    relative = velocity - other;
    reduced_radius = radius * partner / (radius + partner);
    mass = 1.0 / (s.velocity(i)[3] + s.velocity(j)[3]);
    law = dem.law_of(s.material[i], s.material[j]);
  }
  const double* g = dem.gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material[i]);
  const double* action = s.action_of(i);
  const Vec3 free = vec(g) + action[3] * (vec(action) - velocity);
  double gain = norm(free) * step;
  if (b < 0) gain += dem.surfaces[static_cast<std::size_t>(-1 - b)].displacing_speed;
  Outlook out;
  out.speed = norm(relative) + gain;
  const PairLaws& laws = dem.laws[static_cast<std::size_t>(law)];
  // The laws' range is that of the largest grains; dust feels sand from much nearer.
  const double range = laws.cohesion ? laws.range_of(reduced_radius) : laws.range;
  const double margin = k_reach_margin * radius + range;
  out.is_near = dem.fine.is_touching[entry] != 0 || gap < (out.speed + extra_speed) * step + margin;
  if (!out.is_near) return out;
  const double approach = std::max(0.0, -dot(relative, normal)) + gain + extra_speed;
  double overlap = std::max(-gap, 0.0);
  if (laws.cohesion) overlap = std::max(overlap, laws.cohesion->resting_overlap(reduced_radius));
  out.stable_step =
      std::min(laws.contact->collision_time(reduced_radius, mass, std::max(approach, 1e-12)),
               laws.contact->half_period(reduced_radius, mass, overlap) / k_deepest) /
      k_steps_per_contact;
  return out;
}

}  // namespace dust::particles
