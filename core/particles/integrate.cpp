// SPDX-License-Identifier: Apache-2.0
#include "base/lanes.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/impl.hpp"
#include "particles/motion/leapfrog.hpp"

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

/// What stands in the fourth column, in all four. Not returned: the compiler warns of vectors wider
/// than the base of the clones, even where nothing is called.
__attribute__((always_inline)) inline void take_fourth(const Lanes& v, Lanes& all) {
  all = __builtin_shufflevector(v, v, 3, 3, 3, 3);
}

/// One step of the leapfrog. `f`: the row's force and torque; zeros are left.
template <bool has_fluid>
__attribute__((always_inline)) inline void step_row(const AwakeRows& r, double step, std::size_t n,
                                                    double* f) {
  const double half_step = 0.5 * step;
  const Lanes three{1.0, 1.0, 1.0, 0.0};
  const Lanes fourth{0.0, 0.0, 0.0, 1.0};
  auto& position = *reinterpret_cast<Lanes*>(r.position + 4 * n);
  auto* const motion = reinterpret_cast<Lanes*>(r.motion + GrainStore::k_motion_stride * n);
  auto* const spin = reinterpret_cast<Lanes*>(r.spin + GrainStore::k_motion_stride * n);
  auto* const given = reinterpret_cast<Lanes*>(f);
  const Lanes force = given[0];
  const Lanes torque = given[1];
  given[0] = given[1] = Lanes{};
  Lanes inverse_mass;
  Lanes radius;
  take_fourth(motion[0], inverse_mass);
  take_fourth(position, radius);
  Lanes kick = Lanes{} + step;
  Lanes ahead = Lanes{} + 0.5;  // what is left of the step after the kick, in kicks
  const double lag = motion[1][3];
  const bool is_new = lag != half_step;
  if (is_new) [[unlikely]] {
    kick = Lanes{} + (lag + half_step);
    ahead = half_step / kick;
  }
  const Lanes acceleration = force * inverse_mass + lanes::row(r.gravity, r.material[n]);
  const Lanes old = motion[1] * three;
  const Lanes push = acceleration * kick * three;
  Lanes half = old + push;
  if constexpr (has_fluid) {
    Lanes e = Lanes{} + r.decay[2 * n];
    Lanes phi = Lanes{} + r.decay[2 * n + 1];
    const Lanes action = *reinterpret_cast<const Lanes*>(r.action + 4 * n);
    if (is_new) [[unlikely]] {
      const leapfrog::Relaxation drag = leapfrog::relaxation(action[3], kick[0]);
      e = Lanes{} + drag.decay;
      phi = Lanes{} + drag.mean;
    }
    const Lanes target = action * three;
    leapfrog::kick(old, push, target, e, phi, half);
    Lanes received;
    leapfrog::drag_impulse(half, old, push, inverse_mass, received);
    *reinterpret_cast<Lanes*>(r.impulse + 4 * n) += received;
    ahead *= e;
  }
  position += half * step;
  Lanes predicted;
  leapfrog::predict(half, old, ahead, predicted);
  motion[0] = predicted + fourth * inverse_mass;
  motion[1] = half + fourth * half_step;
  Lanes inverse_inertia;
  leapfrog::inverse_inertia(inverse_mass, radius, inverse_inertia);
  const Lanes turn_rate = torque * inverse_inertia;
  const Lanes turn = spin[1] + turn_rate * kick;
  spin[0] = turn + turn_rate * half_step;
  spin[1] = turn;
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
__attribute__((always_inline)) inline void integrate(const AwakeRows& given, double step) {
  const AwakeRows r = given;  // a copy: vectors of lanes may alias whatever stands in memory
  if (r.rows == nullptr) {
    const std::size_t end = r.first + r.count;
    for (std::size_t n = r.first; n < end; ++n) {
      expect<has_fluid>(r, std::min(n + k_ahead, end - 1));
      step_row<has_fluid>(r, step, n, r.force + 8 * (n - r.first));
    }
    return;
  }
  for (std::size_t k = 0; k < r.count; ++k) {
    const auto n = static_cast<std::size_t>(r.rows[k]);
    expect<has_fluid>(r, static_cast<std::size_t>(r.rows[std::min(k + k_ahead, r.count - 1)]));
    step_row<has_fluid>(r, step, n, r.force + 8 * (r.by_row * (n - r.first) + r.by_place * k));
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

/// All rows [first, first + count); `force` by row.
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
bool Dem::Impl::is_check_due() const {
  return (since_watch + 1) % check_every(tuner.inner_lifetime()) == 0;
}

/// `done`: steps of the watch, this one included.
void Dem::Impl::check(Chunk& chunk, std::int64_t done) const {
  chunk.wants_watch = false;
  check_awake(chunk.awake, done, check_every(tuner.inner_lifetime()), chunk.wants_watch);
}

}  // namespace dust::particles
