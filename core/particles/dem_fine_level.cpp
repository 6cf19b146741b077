// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"
#include "particles/motion/integrate.hpp"

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
          .coarse_count = tiling.coarse_count,
          .active = inner.fine_active().all(),
          .contacts = inner.fine().view(),
          .time = time,
          .wall_loads = wall_loads,
          .contact_force = contact_force};
}

/// The particles of the finer rates make their sub-steps.
void Dem::Impl::advance_fine() {
  if (tiling.coarse_count == store.size()) {
    fine_level.forget_deferred();
    return;
  }
  const FineScene scene = fine_scene();
  fine_level.form_clusters(scene);
  const std::span<const std::int32_t> rows = inner.fine_active().all();
  oneapi::tbb::parallel_for(
      std::size_t{0}, (rows.size() + k_fine_particles - 1) / k_fine_particles, [&](std::size_t b) {
        const std::size_t first = b * k_fine_particles;
        integrate_without_force(
            motion_rows(), rows.subspan(first, std::min(k_fine_particles, rows.size() - first)),
            steps.coarse_step);
      });
  fine_level.sub_cycle(scene);
  // Dust squeezed out between coarse particles goes off at several m/s: looked at in every step.
  const std::int32_t bad = inner.check_fine(list_scene());
  if (bad >= 0) fail_as_not_a_number(static_cast<std::size_t>(bad));
}

/// Before a tile's particles move: those that fine ones were near go on with the velocity that they
/// ended the last step with.
void Dem::Impl::apply_deferred_impulses(Tile tile, Movers movers) {
  for (const DeferredImpulse& impulse : fine_level.deferred().of(tile.begin, tile.end)) {
    const bool is_shared = inner.is_shared(impulse.particle);
    if (movers != Movers::all && is_shared != (movers == Movers::shared)) continue;
    impulse.act_on(store);
  }
}

}  // namespace dust::particles
