// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/wall_sliding.hpp"

namespace dust::particles {

void WallSlidings::add(const SlidingContact& contact) {
  const double press = dot(contact.force, contact.normal);
  if (!(press > 0.0)) return;  // held by cohesion only
  const sdk::Vec3 slip = contact.velocity - dot(contact.velocity, contact.normal) * contact.normal;
  const double impulse = contact.weighted_time * press;
  sdk::WallSliding& sum = entry(contact.particle, contact.wall);
  sum.place += impulse * contact.point;
  sum.impulse += impulse;
  sum.sliding += impulse * norm(slip);
  sum.friction -= contact.weighted_time * dot(contact.force, slip);
}

sdk::WallSliding& WallSlidings::entry(std::int32_t particle, std::int32_t wall) {
  const std::size_t count = entries_.size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t at = next_ + n < count ? next_ + n : next_ + n - count;
    if (particles_[at] != particle || entries_[at].wall != wall) continue;
    next_ = at + 1;
    return entries_[at];
  }
  particles_.push_back(particle);
  entries_.push_back({.wall = wall});
  return entries_.back();
}

void WallSlidings::take(std::vector<sdk::WallSliding>& out) {
  for (sdk::WallSliding& e : entries_) {
    e.place = e.place / e.impulse;
    out.push_back(e);
  }
  particles_.clear();
  entries_.clear();
  next_ = 0;
}

}  // namespace dust::particles
