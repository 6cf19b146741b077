// SPDX-License-Identifier: Apache-2.0
#include "base/lanes.hpp"
#include "contact/approach.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/impl.hpp"
#include "particles/motion/leapfrog.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace dust::particles {
namespace {

/// Allowed deviation during a watch, as a share of that of the list: the list's check, made only
/// when a watch ends, triggers at 0.7 of its allowance, so that 0.7 + k_watch_share stays below 1.
constexpr double k_watch_share = 1.0 / 6.0;
/// No more than a grain flies in so many coarse steps: what rests side by side in a bed need not be
/// looked at. Its own speed counts, or that of the fast ones among all, of whom one may hit it: the
/// fastest, but no more than this often the root mean square, lest a stray grain above a bed at
/// rest has all of the bed look far.
constexpr double k_reach_steps = 16.0;
constexpr double k_fast = 4.0;
/// [-] and no less than this share of a diameter.
constexpr double k_least_reach = 0.004;

}  // namespace

void Dem::Impl::record_inner_list() {
  ListTuner::InnerStatistics s{.was_left = must_watch, .steps = since_watch};
  for (const Chunk& c : chunks) {
    s.entries += static_cast<std::int64_t>(c.pairs.size() + c.surfaces.size());
    s.contacts += c.contacts;
  }
  tuner.record(s);
}

bool Dem::Impl::may_meet_surface(std::size_t i, const Surface& surface) const {
  const double* p = store.position.data() + 4 * i;
  const double* v = store.velocity(i);
  const double horizon_time = list_time(tuner.inner_lifetime());
  const double reach = p[3] + largest_range + watch_allowance[i] +
                       horizon_time * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  // The surfaces stand where the step before saw them.
  return surface.may_touch({p[0], p[1], p[2]}, reach, horizon_time + steps.coarse_step);
}

/// Whether a grain without contacts leaves its straight course by little enough.
bool Dem::Impl::flies_straight(std::size_t n) const {
  const double step = steps.coarse_step;
  if (!has_made_steps(static_cast<std::int32_t>(n))) return false;
  const double* g = gravity.data() + 4 * static_cast<std::ptrdiff_t>(store.material[n]);
  const double* action = store.action_of(n);
  double sum = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double a = g[d] + action[3] * (action[d] - store.velocity(n)[d]);
    sum += a * a;
  }
  const double horizon_time = list_time(tuner.inner_lifetime());
  const double bend = (0.5 * horizon_time + step) * horizon_time;
  const double limit = 0.5 * watch_allowance[n];
  return sum * bend * bend < limit * limit;
}

/// [m/s] of all grains, and of surfaces that come nearer.
double Dem::Impl::fastest() const {
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  double walls = 0.0;
  for (const Surface& s : surfaces) {
    if (!s.is_removed()) walls = std::max(walls, s.displacing_speed);
  }
  const double square = oneapi::tbb::parallel_reduce(
      oneapi::tbb::blocked_range<std::size_t>(0, blocks), walls * walls,
      [&](const oneapi::tbb::blocked_range<std::size_t>& range, double most) {
        const std::size_t end = std::min(store.size(), range.end() * k_block);
        for (std::size_t n = range.begin() * k_block; n < end; ++n)
          most = std::max(most, speed2(n));
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  return std::sqrt(square);
}

/// [m/s] root mean square over the grains; the same on any number of threads.
double Dem::Impl::typical_speed() const {
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  const double squares = oneapi::tbb::parallel_deterministic_reduce(
      oneapi::tbb::blocked_range<std::size_t>(0, blocks), 0.0,
      [&](const oneapi::tbb::blocked_range<std::size_t>& range, double sum) {
        const std::size_t end = std::min(store.size(), range.end() * k_block);
        for (std::size_t n = range.begin() * k_block; n < end; ++n) sum += speed2(n);
        return sum;
      },
      std::plus<>());
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(store.size(), 1)));
}

/// Ghosts are looked at by other tiles: they may not move before all contacts are done.
void Dem::Impl::wake_ghosts() {
  for (const Chunk& chunk : chunks) {
    for (const std::int32_t row : ghosts.ghosts(chunk.index)) {
      is_awake[static_cast<std::size_t>(row)] = 2;
    }
  }
}

/// How far each grain may be off its course during the next watch.
void Dem::Impl::choose_watch_allowances() {
  const double fast = std::min(fastest(), k_fast * typical_speed());
  const double least = k_least_reach * steps.classes.back().diameter;
  watch_allowance.resize(store.size());
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t end = std::min(store.size(), (b + 1) * k_block);
    for (std::size_t n = b * k_block; n < end; ++n) {
      const double speed = std::max(fast, std::sqrt(speed2(n)));
      const double reach = std::max(k_reach_steps * speed * steps.coarse_step, least);
      watch_allowance[n] = std::min(k_watch_share * trajectories.skin(n), reach);
    }
  });
}

/// Chooses, for the next steps, the entries of the lists that may come to touch and the grains that
/// stand in one of them. Nobody else feels a contact: the others fly, and make all their steps at
/// once when the watch ends.
void Dem::Impl::begin_watch() {
  is_awake.assign(store.size(), 0);
  choose_watch_allowances();
  for (const DeferredImpulse& impulse : fine_level.deferred().all()) {
    is_awake[static_cast<std::size_t>(impulse.particle)] = 1;
  }
  const contact::Courses courses{store.position.data(), store.motion.data(),
                                 watch_allowance.data()};
  // Two steps: the velocities at hand are not quite those of the step behind.
  const contact::Outlook outlook{.range = largest_range,
                                 .horizon = list_time(tuner.inner_lifetime()),
                                 .behind = 2.0 * steps.coarse_step};
  const auto surface_meets = [&](std::int32_t a, std::int32_t s) -> std::uint8_t {
    const auto row = static_cast<std::size_t>(a);
    return may_meet_surface(row, surfaces[static_cast<std::size_t>(s)]) ? 1 : 0;
  };
  ghosts.restart(chunks.size(), chunk_rows(coarse_count), coarse_count);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    thread_local std::vector<std::uint8_t> meets;
    const OuterList& near = chunk.near_pairs;
    meets.resize(near.size());
    contact::mark_approaching(courses, images, outlook, near.a.data(), near.b.data(), near.size(),
                              meets.data());
    chunk.seen_late = choose_contacts(near, chunk.pairs, meets, true);
    const OuterList& walls = chunk.near_surfaces;
    meets.resize(walls.size());
    for (std::size_t q = 0; q < walls.size(); ++q) meets[q] = surface_meets(walls.a[q], walls.b[q]);
    choose_contacts(walls, chunk.surfaces, meets, false);
    chunk.hints.assign(chunk.surfaces.size(), -1);
    ghosts.find_ghosts(chunk.tile(), chunk.pairs.a, chunk.pairs.b, chunk.places);
    const auto wake = [&](std::int32_t row) {
      if (row < chunk.end) is_awake[static_cast<std::size_t>(row)] = 1;
    };
    for (const std::int32_t row : chunk.pairs.a) wake(row);
    for (const std::int32_t row : chunk.pairs.b) wake(row);
    for (const std::int32_t row : chunk.surfaces.a) wake(row);
  });
  wake_ghosts();

  fine_level.clear_force(store.size() - coarse_count);
  std::vector<std::uint8_t> meets(near_fine.size());
  for (std::size_t q = 0; q < meets.size(); ++q) {
    const std::int32_t i = near_fine.a[q];
    const std::int32_t j = near_fine.b[q];
    if (j < 0) {
      meets[q] = surface_meets(i, -1 - j);
    } else {
      contact::mark_approaching(courses, images, outlook, &i, &j, 1, &meets[q]);
    }
  }
  counters.contacts_seen_late += choose_contacts(near_fine, fine, meets, false);
  for (const Chunk& c : chunks) counters.contacts_seen_late += c.seen_late;
  for (std::size_t e = 0; e < fine.size(); ++e) {
    is_awake[static_cast<std::size_t>(fine.a[e])] = 1;
    if (fine.b[e] >= 0) {
      std::uint8_t& state = is_awake[static_cast<std::size_t>(fine.b[e])];
      state = std::max(state, std::uint8_t{1});
    }
  }

  const auto gather = [&](Awake& awake, std::size_t begin, std::size_t end) {
    awake.rows.clear();
    awake.start.clear();
    const auto take = [&](std::size_t n) {
      awake.rows.push_back(static_cast<std::int32_t>(n));
      const double* p = store.position.data() + 4 * n;
      const double* v = store.velocity(n);
      awake.start.push_back(
          {{p[0], p[1], p[2]},
           {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])},
           static_cast<float>(watch_allowance[n])});
    };
    for (std::size_t n = begin; n < end; ++n) {
      if (is_awake[n] == 0 && (all_step || !flies_straight(n))) is_awake[n] = 1;
      if (is_awake[n] == 1) take(n);
    }
    awake.own = awake.rows.size();
    for (std::size_t n = begin; n < end; ++n) {
      if (is_awake[n] == 2) take(n);
    }
  };
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    gather(chunk.awake, static_cast<std::size_t>(chunk.begin), static_cast<std::size_t>(chunk.end));
  });
  gather(fine_awake, coarse_count, store.size());
  ghosts.plan();
  deferred.restart(chunks.size());
  flying = static_cast<std::int64_t>(store.size() - fine_awake.rows.size());
  for (const Chunk& c : chunks) flying -= static_cast<std::int64_t>(c.awake.rows.size());
  since_watch = 0;
  is_watching = true;
  must_watch = false;
}

namespace {

/// Rows as the kernel sees them.
struct FlyingRows {
  std::size_t begin = 0;
  std::size_t end = 0;
  const std::uint8_t* is_awake = nullptr;
  double* position = nullptr;
  double* motion = nullptr;
  double* impulse = nullptr;
  const double* action = nullptr;
  const double* decay = nullptr;
  const std::int32_t* material = nullptr;
  const double* gravity = nullptr;
};

/// `count` steps of the leapfrog at once for those asleep.
DUST_KERNEL void fly_rows(const FlyingRows& r, double step, std::int64_t count, bool has_fluid) {
  using lanes::Lanes;
  const auto row_of = [](double* p, std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(p + 4 * n);
  };
  const auto velocity = [&r](std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(r.motion + GrainStore::k_motion_stride * n);
  };
  const auto half_velocity = [&r](std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(r.motion + GrainStore::k_motion_stride * n + 4);
  };
  const auto fixed =
      [](const double* p, std::size_t n) __attribute__((always_inline))->const Lanes& {
    return *reinterpret_cast<const Lanes*>(p + 4 * n);
  };
  const Lanes three{1.0, 1.0, 1.0, 0.0};
  const Lanes fourth{0.0, 0.0, 0.0, 1.0};
  const auto total = static_cast<double>(count);
  for (std::size_t n = r.begin; n < r.end; ++n) {
    if (r.is_awake[n] != 0) continue;
    const Lanes push = fixed(r.gravity, static_cast<std::size_t>(r.material[n])) * step * three;
    const Lanes old = half_velocity(n) * three;
    double decay = 1.0;
    Lanes first = push;
    if (has_fluid) {
      decay = r.decay[2 * n];
      const Lanes target = fixed(r.action, n) * three;
      leapfrog::first_change(old, push, target, decay, r.decay[2 * n + 1], first);
    }
    const auto flight = leapfrog::FreeFlight::of(count, decay);
    const Lanes half = old + first * flight.g;
    row_of(r.position, n) += (old * total + first * flight.h) * step;
    velocity(n) = (half + first * (0.5 * flight.power)) + fourth * velocity(n);
    half_velocity(n) = half + fourth * half_velocity(n);
    if (has_fluid) {
      const Lanes whole_push = push * total;
      const double inverse_mass = velocity(n)[3];
      Lanes received;
      leapfrog::drag_impulse(half, old, whole_push, inverse_mass, received);
      row_of(r.impulse, n) += received;
    }
  }
}

}  // namespace

/// Ends the watch: who flew makes the steps of the watch, and the lists are looked after.
void Dem::Impl::land() {
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(),
                            [&](std::size_t c) { fall_in(chunks[c].pairs); });
  if (!is_watching) return;
  is_watching = false;
  if (since_watch == 0) return;
  record_inner_list();
  counters.flown_steps += flying * since_watch;
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  wants.assign(blocks, 0);
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t begin = b * k_block;
    const std::size_t end = std::min(store.size(), begin + k_block);
    fly_rows({.begin = begin,
              .end = end,
              .is_awake = is_awake.data(),
              .position = store.position.data(),
              .motion = store.motion.data(),
              .impulse = store.impulse.data(),
              .action = store.action.data(),
              .decay = store.decay.data(),
              .material = store.material.data(),
              .gravity = gravity.data()},
             steps.coarse_step, since_watch, has_fluid);
    bool wants_mending = false;
    bool wants_rebuild = false;
    check_course(begin, end, wants_mending, wants_rebuild);
    wants[b] = wants_rebuild ? 2 : wants_mending ? 1 : 0;
  });
  for (std::size_t b = 0; b < blocks; ++b) {
    must_mend = must_mend || wants[b] != 0;
    must_rebuild = must_rebuild || wants[b] == 2;
  }
}

}  // namespace dust::particles
