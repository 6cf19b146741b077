// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

/// The fine level in the steps of the solver.
namespace dust::particles {
namespace {

/// Fine particles per task.
constexpr std::size_t k_fine_particles = 256;

}  // namespace

FineScene Dem::Impl::fine_scene() {
  return {.laws = laws,
          .surfaces = surfaces,
          .steps = steps,
          .images = images,
          .gravity = gravity,
          .particles = store,
          .coarse_count = coarse_count,
          .active = fine_awake.rows,
          .contacts = fine.view(history_stride),
          .time = time,
          .wall_loads = wall_loads,
          .contact_force = contact_force};
}

/// The particles of the finer rates make their sub-steps.
void Dem::Impl::advance_fine() {
  if (coarse_count == store.size()) {
    fine_level.forget_deferred();
    return;
  }
  const FineScene scene = fine_scene();
  fine_level.form_clusters(scene);
  const std::span<const std::int32_t> rows = fine_awake.rows;
  oneapi::tbb::parallel_for(
      std::size_t{0}, (rows.size() + k_fine_particles - 1) / k_fine_particles, [&](std::size_t b) {
        const std::size_t first = b * k_fine_particles;
        integrate_awake(rows.subspan(first, std::min(k_fine_particles, rows.size() - first)), 0,
                        nullptr, ForceOrder::by_row);
      });
  fine_level.sub_cycle(scene);
  // Dust squeezed out between coarse grains goes off at several m/s: looked after at every step.
  check_awake(fine_awake, since_watch, 1, must_watch);
}

/// Before a chunk's grains move: those that fine ones were near go on with the velocity that they
/// ended the last step with.
void Dem::Impl::resume_course(const Chunk& chunk, Movers movers) {
  for (const DeferredImpulse& impulse : fine_level.deferred().of(chunk.begin, chunk.end)) {
    const bool is_shared = is_awake[static_cast<std::size_t>(impulse.particle)] == 2;
    if (movers != Movers::all && is_shared != (movers == Movers::shared)) continue;
    impulse.act_on(store);
  }
}

}  // namespace dust::particles
