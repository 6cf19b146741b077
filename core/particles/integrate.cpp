// SPDX-License-Identifier: Apache-2.0
#include "base/lanes.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dust::particles {

/// Rows ahead that are fetched: those that waited lie apart.
constexpr std::size_t k_ahead = 24;

/// Rows as the kernel sees them.
struct AwakeRows {
  const std::int32_t* rows = nullptr;  ///< null: all from `first` on
  std::size_t count = 0;
  double* position = nullptr;
  double* motion = nullptr;
  double* spin = nullptr;
  double* force =
      nullptr;  ///< of the k-th row n, at 8 (by_row (n - first) + by_place k); zeros are left
  std::size_t by_row = 0;
  std::size_t by_place = 0;
  std::size_t first = 0;
  const double* action = nullptr;
  double* impulse = nullptr;
  const double* decay = nullptr;
  const std::int32_t* material = nullptr;
  const double* gravity = nullptr;
};

namespace {

using lanes::Lanes;
/// The rows of two grains side by side.
typedef double Wide __attribute__((vector_size(64), may_alias));

template <class V>
constexpr int k_rows = sizeof(V) / sizeof(Lanes);

// Vectors wider than a clone knows are not returned: the compiler warns of it even where nothing is
// called.

/// What stands in the fourth column, in all four.
__attribute__((always_inline)) inline void take_fourth(const Lanes& v, Lanes& all) {
  all = __builtin_shufflevector(v, v, 3, 3, 3, 3);
}
__attribute__((always_inline)) inline void take_fourth(const Wide& v, Wide& all) {
  all = __builtin_shufflevector(v, v, 3, 3, 3, 3, 7, 7, 7, 7);
}
__attribute__((always_inline)) inline void set_side_by_side(const Lanes& a, const Lanes& b,
                                                            Wide& both) {
  both = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
__attribute__((always_inline)) inline void set_all(const Lanes& four, Lanes& all) { all = four; }
__attribute__((always_inline)) inline void set_all(const Lanes& four, Wide& all) {
  set_side_by_side(four, four, all);
}

/// Of one grain, or two that follow each other, what stands first in a line and what stands behind
/// it.
__attribute__((always_inline)) inline void split(const double* lines, std::size_t n, Lanes& first,
                                                 Lanes& second) {
  lanes::load(lines + GrainStore::k_motion_stride * n, first);
  lanes::load(lines + GrainStore::k_motion_stride * n + 4, second);
}
__attribute__((always_inline)) inline void split(const double* lines, std::size_t n, Wide& first,
                                                 Wide& second) {
  const Wide* const line = reinterpret_cast<const Wide*>(lines + GrainStore::k_motion_stride * n);
  first = __builtin_shufflevector(line[0], line[1], 0, 1, 2, 3, 8, 9, 10, 11);
  second = __builtin_shufflevector(line[0], line[1], 4, 5, 6, 7, 12, 13, 14, 15);
}
__attribute__((always_inline)) inline void join(const Lanes& first, const Lanes& second,
                                                std::size_t n, double* lines) {
  lanes::store(lines + GrainStore::k_motion_stride * n, first);
  lanes::store(lines + GrainStore::k_motion_stride * n + 4, second);
}
__attribute__((always_inline)) inline void join(const Wide& first, const Wide& second,
                                                std::size_t n, double* lines) {
  Wide* const line = reinterpret_cast<Wide*>(lines + GrainStore::k_motion_stride * n);
  line[0] = __builtin_shufflevector(first, second, 0, 1, 2, 3, 8, 9, 10, 11);
  line[1] = __builtin_shufflevector(first, second, 4, 5, 6, 7, 12, 13, 14, 15);
}

/// Leapfrog with drag integrated exactly between the kicks:
/// \f$ v' = v E + u (1 - E) + a \phi \tau \f$, E = exp(-k tau), phi = (1 - E) / (k tau), tau the
/// lag of v plus half the step. The velocity for the next forces is predicted to the instant of the
/// new positions (Vyas et al., Comput. Phys. Commun. 310 (2025) 109524,
/// doi:10.1016/j.cpc.2025.109524).
///
/// One row, or two that follow each other; `f`: their forces and torques in turn.
template <class V, bool has_fluid>
__attribute__((always_inline)) inline void step_rows(const AwakeRows& r, double step, std::size_t n,
                                                     double* f) {
  const auto at = [n](double* p) __attribute__((always_inline))->V& {
    return *reinterpret_cast<V*>(p + 4 * n);
  };
  const double half_step = 0.5 * step;
  V three;
  V fourth;
  set_all(Lanes{1.0, 1.0, 1.0, 0.0}, three);
  set_all(Lanes{0.0, 0.0, 0.0, 1.0}, fourth);
  const auto gravity_of = [&](std::size_t m) __attribute__((always_inline))->const Lanes& {
    return lanes::row(r.gravity, r.material[m]);
  };
  V force;
  V torque;
  V weight;
  if constexpr (k_rows<V> == 1) {
    force = reinterpret_cast<const Lanes*>(f)[0];
    torque = reinterpret_cast<const Lanes*>(f)[1];
    weight = gravity_of(n);
  } else {
    const Lanes* const rows = reinterpret_cast<const Lanes*>(f);
    set_side_by_side(rows[0], rows[2], force);
    set_side_by_side(rows[1], rows[3], torque);
    set_side_by_side(gravity_of(n), gravity_of(n + 1), weight);
  }
  for (int k = 0; k < 2 * k_rows<V>; ++k) reinterpret_cast<Lanes*>(f)[k] = Lanes{};
  V inverse_mass;
  V radius;
  V last;
  V old_row;
  split(r.motion, n, last, old_row);
  take_fourth(last, inverse_mass);
  take_fourth(at(r.position), radius);
  V kick = V{} + step;
  V ahead = V{} + 0.5;  // what is left of the step after the kick, in kicks
  bool is_new = false;
  for (int k = 0; k < k_rows<V>; ++k) is_new |= old_row[4 * k + 3] != half_step;
  if (is_new) [[unlikely]] {
    take_fourth(old_row, kick);
    kick += half_step;
    ahead = half_step / kick;
  }
  const V acceleration = force * inverse_mass + weight;
  const V old = old_row * three;
  const V push = acceleration * kick * three;
  V half = old + push;
  if constexpr (has_fluid) {
    V e;
    V phi;
    const double* const decay = r.decay + 2 * n;
    if constexpr (k_rows<V> == 1) {
      e = V{} + decay[0];
      phi = V{} + decay[1];
    } else {
      const Lanes d = *reinterpret_cast<const Lanes*>(decay);
      e = __builtin_shufflevector(d, d, 0, 0, 0, 0, 2, 2, 2, 2);
      phi = __builtin_shufflevector(d, d, 1, 1, 1, 1, 3, 3, 3, 3);
    }
    const V action = *reinterpret_cast<const V*>(r.action + 4 * n);
    if (is_new) [[unlikely]] {
      for (int k = 0; k < 4 * k_rows<V>; ++k) {
        if (kick[k] == step) continue;
        const double x = action[k / 4 * 4 + 3] * kick[k];
        e[k] = std::exp(-x);
        phi[k] = x > 0.0 ? -std::expm1(-x) / x : 1.0;
      }
    }
    const V target = action * three;
    half = old + (target - old) * (1.0 - e) + push * phi;
    at(r.impulse) += (half - old - push) / inverse_mass;
    ahead *= e;
  }
  const V now = half + ahead * (half - old);
  at(r.position) += half * step;
  join(now + fourth * inverse_mass, half + fourth * half_step, n, r.motion);
  // I = 2/5 m R^2
  const V spin = torque * (2.5 * inverse_mass / (radius * radius));
  V old_turn;
  split(r.spin, n, last, old_turn);
  const V turn = old_turn + spin * kick;
  join(turn + spin * half_step, turn, n, r.spin);
}

/// The rows of a grain soon to come.
template <bool has_fluid>
__attribute__((always_inline)) inline void expect(const AwakeRows& r, std::size_t n) {
  __builtin_prefetch(r.position + 4 * n, 1);
  for (const double* p : {r.motion, r.spin}) {
    __builtin_prefetch(p + GrainStore::k_motion_stride * n, 1);
  }
  if constexpr (has_fluid) {
    __builtin_prefetch(r.action + 4 * n);
    __builtin_prefetch(r.impulse + 4 * n, 1);
    __builtin_prefetch(r.decay + 2 * n);
  }
}

template <bool has_fluid>
__attribute__((always_inline)) inline void integrate(const AwakeRows& r, double step) {
  if (r.rows == nullptr) {
    // In twos: they begin with a cache line.
    const std::size_t end = r.first + r.count;
    std::size_t n = r.first;
    for (; n + 2 <= end; n += 2) {
      expect<has_fluid>(r, std::min(n + k_ahead, end - 1));
      step_rows<Wide, has_fluid>(r, step, n, r.force + 8 * (n - r.first));
    }
    if (n < end) step_rows<Lanes, has_fluid>(r, step, n, r.force + 8 * (n - r.first));
    return;
  }
  for (std::size_t k = 0; k < r.count; ++k) {
    const auto n = static_cast<std::size_t>(r.rows[k]);
    expect<has_fluid>(r, static_cast<std::size_t>(r.rows[std::min(k + k_ahead, r.count - 1)]));
    step_rows<Lanes, has_fluid>(r, step, n,
                                r.force + 8 * (r.by_row * (n - r.first) + r.by_place * k));
  }
}

DUST_KERNEL void integrate_dry(const AwakeRows& r, double step) { integrate<false>(r, step); }
DUST_KERNEL void integrate_in_fluid(const AwakeRows& r, double step) { integrate<true>(r, step); }

}  // namespace

/// The named rows; `force` holds eight numbers per row, from row `first` on or in the order of
/// `rows`, and is left at zero, or is null: no force.
void Dem::Impl::integrate_awake(std::span<const std::int32_t> rows, std::size_t first,
                                double* force, ForceOrder order) {
  alignas(64) double no_force[8] = {};
  const bool has_force = force != nullptr;
  AwakeRows r = awake_rows();
  r.rows = rows.data();
  r.count = rows.size();
  r.force = has_force ? force : no_force;
  r.by_row = has_force && order == ForceOrder::by_row ? 1 : 0;
  r.by_place = has_force && order == ForceOrder::by_place ? 1 : 0;
  r.first = first;
  (has_fluid ? integrate_in_fluid : integrate_dry)(r, steps.coarse_step);
}

/// All rows [first, first + count), `first` even; `force` by row.
void Dem::Impl::integrate_all(std::size_t first, std::size_t count, double* force) {
  AwakeRows r = awake_rows();
  r.count = count;
  r.force = force;
  r.first = first;
  (has_fluid ? integrate_in_fluid : integrate_dry)(r, steps.coarse_step);
}

AwakeRows Dem::Impl::awake_rows() {
  return {.position = store.position.data(),
          .motion = store.motion.data(),
          .spin = store.spin.data(),
          .action = store.action.data(),
          .impulse = store.impulse.data(),
          .decay = store.decay.data(),
          .material = store.material.data(),
          .gravity = gravity.data()};
}

/// Whether the step in hand ends with a look at how far everybody is off the supposed course.
bool Dem::Impl::is_check_due() const { return (since_watch + 1) % check_every(watch_length) == 0; }

/// `done`: steps of the watch, this one included.
void Dem::Impl::check(Chunk& chunk, std::int64_t done) const {
  chunk.wants_watch = false;
  check_awake(chunk.awake, done, check_every(watch_length), chunk.wants_watch);
}

void Dem::Impl::integrate() {
  const bool is_check = is_check_due();
  ++since_watch;
  ++since_rebuild;
  ++counters.steps;
  counters.particle_steps += static_cast<std::int64_t>(store.size());
  each_waiting([&](Chunk& chunk) {
    resume_course(chunk, Movers::shared);
    integrate_awake(std::span(chunk.awake.rows).subspan(chunk.moved),
                    static_cast<std::size_t>(chunk.begin), chunk.force.data(),
                    ForceOrder::by_place);
    if (is_check) check(chunk, since_watch);
  });
  if (is_check) {
    for (const Chunk& c : chunks) {
      must_watch = must_watch || c.wants_watch;
    }
  }
  if (coarse_count < store.size()) {
    fine_pass();
    // Dust squeezed out between coarse grains goes off at several m/s: looked after at every step.
    check_awake(fine_awake, since_watch, 1, must_watch);
  } else {
    left_overs.clear();
  }
}

}  // namespace dust::particles
