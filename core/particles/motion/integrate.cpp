// SPDX-License-Identifier: Apache-2.0
#include "particles/motion/integrate.hpp"

#include "base/lanes.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/motion/leapfrog.hpp"

#include <algorithm>
#include <cmath>

namespace dust::particles {
namespace {

using lanes::Lanes;

/// Rows ahead that are fetched: active particles lie apart.
constexpr std::size_t k_ahead = 24;

/// What the kernel works on.
struct SteppingRows {
  MotionRows rows;
  const std::int32_t* particles = nullptr;  ///< null: all from `first` on
  std::size_t count = 0;
  /// Of the k-th particle n, at 8 (by_row (n - first) + by_order k); zeros are left.
  double* force = nullptr;
  std::size_t by_row = 0;
  std::size_t by_order = 0;
  std::size_t first = 0;
};

/// What stands in the fourth column, in all four. Not returned: the compiler warns of vectors wider
/// than the base of the clones, even where nothing is called.
__attribute__((always_inline)) inline void take_fourth(const Lanes& v, Lanes& all) {
  all = __builtin_shufflevector(v, v, 3, 3, 3, 3);
}

/// One step of the leapfrog. `f`: the row's force and torque; zeros are left.
template <bool has_fluid>
__attribute__((always_inline)) inline void step_row(const MotionRows& r, double step, std::size_t n,
                                                    double* f) {
  const double half_step = 0.5 * step;
  const Lanes three{1.0, 1.0, 1.0, 0.0};
  const Lanes fourth{0.0, 0.0, 0.0, 1.0};
  auto& position = *reinterpret_cast<Lanes*>(r.position + 4 * n);
  auto* const motion = reinterpret_cast<Lanes*>(r.motion + ParticleStore::k_motion_stride * n);
  auto* const spin = reinterpret_cast<Lanes*>(r.spin + ParticleStore::k_motion_stride * n);
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
  const double since_kick = motion[1][3];
  const bool is_new = since_kick != half_step;
  if (is_new) [[unlikely]] {
    kick = Lanes{} + (since_kick + half_step);
    ahead = half_step / kick;
  }
  const Lanes acceleration = force * inverse_mass + lanes::row(r.gravity, r.material[n]);
  const Lanes old = motion[1] * three;
  const Lanes push = acceleration * kick * three;
  Lanes half = old + push;
  if constexpr (has_fluid) {
    Lanes e = Lanes{} + r.decay[2 * n];
    Lanes phi = Lanes{} + r.decay[2 * n + 1];
    const Lanes drag = *reinterpret_cast<const Lanes*>(r.drag + 4 * n);
    if (is_new) [[unlikely]] {
      const leapfrog::Relaxation relaxation = leapfrog::relaxation(drag[3], kick[0]);
      e = Lanes{} + relaxation.decay;
      phi = Lanes{} + relaxation.mean;
    }
    const Lanes target = drag * three;
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

/// The rows of a particle soon to come.
template <bool has_fluid>
__attribute__((always_inline)) inline void expect(const MotionRows& r, std::size_t n) {
  __builtin_prefetch(r.position + 4 * n, 1);
  for (const double* p : {r.motion, r.spin}) {
    __builtin_prefetch(p + ParticleStore::k_motion_stride * n, 1);
  }
  if constexpr (has_fluid) {
    __builtin_prefetch(r.drag + 4 * n);
    __builtin_prefetch(r.impulse + 4 * n, 1);
    __builtin_prefetch(r.decay + 2 * n);
  }
}

template <bool has_fluid>
__attribute__((always_inline)) inline void integrate(const SteppingRows& given, double step) {
  const SteppingRows s = given;  // a copy: vectors of lanes may alias whatever stands in memory
  if (s.particles == nullptr) {
    const std::size_t end = s.first + s.count;
    for (std::size_t n = s.first; n < end; ++n) {
      expect<has_fluid>(s.rows, std::min(n + k_ahead, end - 1));
      step_row<has_fluid>(s.rows, step, n, s.force + k_force_row * (n - s.first));
    }
    return;
  }
  for (std::size_t k = 0; k < s.count; ++k) {
    const auto n = static_cast<std::size_t>(s.particles[k]);
    expect<has_fluid>(s.rows,
                      static_cast<std::size_t>(s.particles[std::min(k + k_ahead, s.count - 1)]));
    step_row<has_fluid>(s.rows, step, n,
                        s.force + k_force_row * (s.by_row * (n - s.first) + s.by_order * k));
  }
}

DUST_KERNEL void integrate_dry(const SteppingRows& r, double step) { integrate<false>(r, step); }
DUST_KERNEL void integrate_in_fluid(const SteppingRows& r, double step) {
  integrate<true>(r, step);
}

void run(const SteppingRows& r, double step) {
  (r.rows.has_drag ? integrate_in_fluid : integrate_dry)(r, step);
}

}  // namespace

void integrate_tile(const MotionRows& rows, Tile tile, double* force, double step) {
  run({.rows = rows,
       .count = tile.size(),
       .force = force,
       .first = static_cast<std::size_t>(tile.begin)},
      step);
}

void integrate_in_tile(const MotionRows& rows, Tile tile, std::span<const std::int32_t> particles,
                       double* force, double step) {
  run({.rows = rows,
       .particles = particles.data(),
       .count = particles.size(),
       .force = force,
       .by_row = 1,
       .first = static_cast<std::size_t>(tile.begin)},
      step);
}

void integrate_in_order(const MotionRows& rows, std::span<const std::int32_t> particles,
                        double* force, double step) {
  run({.rows = rows,
       .particles = particles.data(),
       .count = particles.size(),
       .force = force,
       .by_order = 1},
      step);
}

void integrate_without_force(const MotionRows& rows, std::span<const std::int32_t> particles,
                             double step) {
  alignas(64) double no_force[8] = {};
  run({.rows = rows, .particles = particles.data(), .count = particles.size(), .force = no_force},
      step);
}

}  // namespace dust::particles
