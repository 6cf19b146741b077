// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/list_tuner.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

/// Long inner lists in beds at rest, short ones where particles collide all the time: the longer a
/// straight trajectory is supposed, the sooner somebody is off it.
constexpr std::int64_t k_longest_inner = 64;
constexpr std::int64_t k_shortest_inner = 8;
/// Where half of the pairs looked at touch, as in beds. Particles that fly would have many to look
/// at.
constexpr std::int64_t k_longest_inner_in_bed = 256;

constexpr std::int64_t k_shortest_outer = 16;
constexpr std::int64_t k_longest_outer = 4096;
constexpr double k_max_flight_steps = 1e6;

/// The least skin in diameters, and what one level more adds.
constexpr double k_skin = 0.15;
constexpr double k_skin_per_level = 0.15;
constexpr std::int64_t k_widest_level = 7;
/// Pairs per particle below which skins are widened after a list that ended early, and above which
/// they are narrowed.
constexpr double k_few_pairs = 3.0;
constexpr double k_many_pairs = 6.0;

}  // namespace

/// A list that had to end before half of its lifetime makes the next one shorter, one that lasted
/// longer.
void ListTuner::record(const InnerStatistics& s) {
  if (s.was_left && 2 * s.steps < inner_lifetime_) {
    inner_lifetime_ = std::max(inner_lifetime_ / 2, k_shortest_inner);
  } else if (s.steps >= inner_lifetime_) {
    inner_lifetime_ *= 2;
  }
  const bool is_bed = 2 * s.contacts > s.entries;
  inner_lifetime_ = std::min(inner_lifetime_, is_bed ? k_longest_inner_in_bed : k_longest_inner);
}

std::int64_t ListTuner::begin_outer(double flight_steps) {
  const auto most = static_cast<std::int64_t>(std::min(flight_steps, k_max_flight_steps));
  outer_lifetime_ = std::min(next_outer_lifetime_, std::max(k_shortest_outer, most));
  return outer_lifetime_;
}

/// Lists are made for so long that the lifetime adds little to what the skins list anyhow.
void ListTuner::record(const OuterStatistics& s) {
  const std::int64_t base = s.close_pairs + s.particles / 2;
  const std::int64_t more = 10 * (s.pairs - s.close_pairs);
  if (s.is_half_used || more > 4 * base) {
    next_outer_lifetime_ = std::max(outer_lifetime_ / 2, k_shortest_outer);
  } else if (more < base) {
    next_outer_lifetime_ = std::min((4 * more < base ? 4 : 2) * outer_lifetime_, k_longest_outer);
  }
  if (s.is_early && may_widen_skins(s.pairs, s.particles)) {
    ++skin_level_;
  } else if (static_cast<double>(s.pairs) > k_many_pairs * static_cast<double>(s.particles)) {
    skin_level_ = std::max<std::int64_t>(skin_level_ - 1, 0);
  }
}

double ListTuner::skin_in_diameters() const {
  return k_skin + k_skin_per_level * static_cast<double>(skin_level_);
}

bool ListTuner::may_widen_skins(std::int64_t pairs, std::int64_t particles) const {
  return skin_level_ < k_widest_level &&
         static_cast<double>(pairs) < k_few_pairs * static_cast<double>(particles);
}

ListTuner::State ListTuner::state() const {
  return {outer_lifetime_, next_outer_lifetime_, skin_level_, inner_lifetime_};
}

void ListTuner::restore(const State& s) {
  outer_lifetime_ = s.outer_lifetime;
  next_outer_lifetime_ = s.next_outer_lifetime;
  skin_level_ = s.skin_level;
  inner_lifetime_ = s.inner_lifetime;
}

}  // namespace dust::particles
