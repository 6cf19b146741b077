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
  const std::int32_t* rows = nullptr;
  std::size_t count = 0;
  double* position = nullptr;
  double* velocity = nullptr;
  double* rotation = nullptr;
  double* half_velocity = nullptr;
  double* half_rotation = nullptr;
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

/// Leapfrog with drag integrated exactly between the kicks:
/// \f$ v' = v E + u (1 - E) + a \phi \tau \f$, E = exp(-k tau), phi = (1 - E) / (k tau), tau the
/// lag of v plus half the step. The velocity for the next forces is predicted to the instant of the
/// new positions (Vyas et al., Comput. Phys. Commun. 310 (2025) 109524,
/// doi:10.1016/j.cpc.2025.109524).
DUST_KERNEL void integrate_rows(const AwakeRows& r, double step, bool has_fluid) {
  using lanes::Lanes;
  const auto row_of = [](double* p, std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(p + 4 * n);
  };
  const auto fixed =
      [](const double* p, std::size_t n) __attribute__((always_inline))->const Lanes& {
    return *reinterpret_cast<const Lanes*>(p + 4 * n);
  };
  const double half_step = 0.5 * step;
  const Lanes three{1.0, 1.0, 1.0, 0.0};
  const Lanes fourth{0.0, 0.0, 0.0, 1.0};
  for (std::size_t k = 0; k < r.count; ++k) {
    const auto n = static_cast<std::size_t>(r.rows[k]);
    const auto next = 4 * static_cast<std::size_t>(r.rows[std::min(k + k_ahead, r.count - 1)]);
    __builtin_prefetch(r.half_velocity + next, 1);
    __builtin_prefetch(r.half_rotation + next, 1);
    __builtin_prefetch(r.position + next, 1);
    __builtin_prefetch(r.velocity + next, 1);
    __builtin_prefetch(r.rotation + next, 1);
    if (has_fluid) {
      __builtin_prefetch(r.action + next);
      __builtin_prefetch(r.impulse + next, 1);
      __builtin_prefetch(r.decay + next / 2);
    }
    Lanes* f = &row_of(r.force, 2 * (r.by_row * (n - r.first) + r.by_place * k));
    const Lanes force = f[0];
    const Lanes torque = f[1];
    f[0] = f[1] = Lanes{};
    const double inverse_mass = r.velocity[4 * n + 3];
    const double radius = r.position[4 * n + 3];
    const double lag = r.half_velocity[4 * n + 3];
    double kick = step;
    double ahead = 0.5;  // what is left of the step after the kick, in kicks
    if (lag != half_step) [[unlikely]] {
      kick = lag + half_step;
      ahead = half_step / kick;
    }
    const Lanes acceleration =
        force * inverse_mass + fixed(r.gravity, static_cast<std::size_t>(r.material[n]));
    const Lanes old = row_of(r.half_velocity, n) * three;
    const Lanes push = acceleration * kick * three;
    Lanes half = old + push;
    if (has_fluid) {
      double e = r.decay[2 * n];
      double phi = r.decay[2 * n + 1];
      if (kick != step) [[unlikely]] {
        const double x = r.action[4 * n + 3] * kick;
        e = std::exp(-x);
        phi = x > 0.0 ? -std::expm1(-x) / x : 1.0;
      }
      const Lanes target = fixed(r.action, n) * three;
      half = old + (target - old) * (1.0 - e) + push * phi;
      row_of(r.impulse, n) += (half - old - push) / inverse_mass;
      ahead *= e;
    }
    const Lanes now = half + ahead * (half - old);
    row_of(r.position, n) += half * step;
    row_of(r.velocity, n) = now + fourth * inverse_mass;
    row_of(r.half_velocity, n) = half + fourth * half_step;
    // I = 2/5 m R^2
    const Lanes spin = torque * (2.5 * inverse_mass / (radius * radius));
    const Lanes turn = row_of(r.half_rotation, n) + spin * kick;
    row_of(r.half_rotation, n) = turn;
    row_of(r.rotation, n) = turn + spin * half_step;
  }
}

/// The named rows; `force` holds eight numbers per row, from row `first` on or in the order of
/// `rows`, and is left at zero, or is null: no force.
void Dem::Impl::integrate_awake(std::span<const std::int32_t> rows, std::size_t first,
                                double* force, ForceOrder order) {
  alignas(32) double no_force[8] = {};
  const bool has_force = force != nullptr;
  integrate_rows({.rows = rows.data(),
                  .count = rows.size(),
                  .position = store.position.data(),
                  .velocity = store.velocity.data(),
                  .rotation = store.rotation.data(),
                  .half_velocity = store.half_velocity.data(),
                  .half_rotation = store.half_rotation.data(),
                  .force = has_force ? force : no_force,
                  .by_row = has_force && order == ForceOrder::by_row ? std::size_t{1} : 0,
                  .by_place = has_force && order == ForceOrder::by_place ? std::size_t{1} : 0,
                  .first = first,
                  .action = store.action.data(),
                  .impulse = store.impulse.data(),
                  .decay = store.decay.data(),
                  .material = store.material.data(),
                  .gravity = gravity.data()},
                 steps.coarse_step, has_fluid);
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
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    // move_all() has been here: whoever stands in no other chunk's list has no givers to wait for.
    if (chunk.moved > 0 && chunk.moved == chunk.awake.rows.size()) return;
    take_gifts(chunk, chunk.force.data(), ForceOrder::by_place);
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
  }
}

}  // namespace dust::particles
