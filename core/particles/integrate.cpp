// SPDX-License-Identifier: Apache-2.0
#include "contact/lanes.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

namespace dust::particles {

/// Rows of one chunk as the kernel sees them, all at the chunk's first grain.
struct ChunkRows {
  std::size_t count = 0;
  double* position = nullptr;
  double* velocity = nullptr;
  double* rotation = nullptr;
  double* half_velocity = nullptr;
  double* half_rotation = nullptr;
  const double* force = nullptr;
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
DUST_KERNEL void integrate_rows(const ChunkRows& r, double step, bool has_fluid) {
  using contact::Lanes;
  const auto lanes = [](double* p, std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(p + 4 * n);
  };
  const auto fixed =
      [](const double* p, std::size_t n) __attribute__((always_inline))->const Lanes& {
    return *reinterpret_cast<const Lanes*>(p + 4 * n);
  };
  const double half_step = 0.5 * step;
  const Lanes three{1.0, 1.0, 1.0, 0.0};
  const Lanes fourth{0.0, 0.0, 0.0, 1.0};
  for (std::size_t n = 0; n < r.count; ++n) {
    const double inverse_mass = r.velocity[4 * n + 3];
    const double radius = r.position[4 * n + 3];
    const double lag = r.half_velocity[4 * n + 3];
    double kick = step;
    double ahead = 0.5;  // what is left of the step after the kick, in kicks
    if (lag != half_step) [[unlikely]] {
      kick = lag + half_step;
      ahead = half_step / kick;
    }
    const Lanes acceleration = fixed(r.force, 2 * n) * inverse_mass +
                               fixed(r.gravity, static_cast<std::size_t>(r.material[n]));
    const Lanes old = lanes(r.half_velocity, n) * three;
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
      lanes(r.impulse, n) += (half - old - push) / inverse_mass;
      ahead *= e;
    }
    const Lanes now = half + ahead * (half - old);
    lanes(r.position, n) += half * step;
    lanes(r.velocity, n) = now + fourth * inverse_mass;
    lanes(r.half_velocity, n) = half + fourth * half_step;
    // I = 2/5 m R^2
    const Lanes spin = fixed(r.force, 2 * n + 1) * (2.5 * inverse_mass / (radius * radius));
    const Lanes turn = lanes(r.half_rotation, n) + spin * kick;
    lanes(r.half_rotation, n) = turn;
    lanes(r.rotation, n) = turn + spin * half_step;
  }
}

void Dem::Impl::integrate_chunk(Chunk& chunk) {
  const auto first = static_cast<std::size_t>(chunk.begin);
  const ChunkRows rows{.count = static_cast<std::size_t>(chunk.end - chunk.begin),
                       .position = store.position.data() + 4 * first,
                       .velocity = store.velocity.data() + 4 * first,
                       .rotation = store.rotation.data() + 4 * first,
                       .half_velocity = store.half_velocity.data() + 4 * first,
                       .half_rotation = store.half_rotation.data() + 4 * first,
                       .force = chunk.force.data(),
                       .action = store.action.data() + 4 * first,
                       .impulse = store.impulse.data() + 4 * first,
                       .decay = store.decay.data() + 2 * first,
                       .material = store.material.data() + first,
                       .gravity = gravity.data()};
  integrate_rows(rows, steps.coarse_step, has_fluid);
}

void Dem::Impl::integrate() {
  const bool is_check = (since_rebuild + 1) % k_check_every == 0;
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(),
                            [&](std::size_t c) { integrate_chunk(chunks[c]); });
  ++since_rebuild;
  ++counters.steps;
  counters.particle_steps += static_cast<std::int64_t>(store.size());
  if (coarse_count < store.size()) {
    fine_pass();
    // Dust squeezed out between coarse grains goes off at several m/s: looked after at every step.
    bool wants = false;
    check_fine_course(wants);
    must_rebuild = must_rebuild || wants;
  }
  if (!is_check) return;
  for (Chunk& c : chunks) c.wants_rebuild = false;
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    check_course(static_cast<std::size_t>(chunks[c].begin), static_cast<std::size_t>(chunks[c].end),
                 chunks[c].wants_rebuild);
  });
  bool wants = false;
  for (const Chunk& c : chunks) wants = wants || c.wants_rebuild;
  if (wants) must_rebuild = true;
}

}  // namespace dust::particles
