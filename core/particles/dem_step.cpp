// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"
#include "particles/motion/free_flight.hpp"
#include "particles/motion/integrate.hpp"
#include "particles/particle_error.hpp"
#include "particles/store/row_order.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

/// A step of the solver: the pair lists, when one ends and what follows; the coarse particles, tile
/// by tile (TileStep); the fine level.
namespace dust::particles {
namespace {

/// Rebuilds between two sorts of the rows where no particle came or went.
constexpr std::int64_t k_sort_every = 4;
/// Fine particles per task.
constexpr std::size_t k_fine_particles = 256;

}  // namespace

/// Before every coarse step; in most steps two comparisons.
void Dem::Impl::update_pair_lists() {
  if (inner.life().is_over() || outer.is_rebuild_due()) synchronise();
  if (outer.is_update_due()) {
    if (outer.update(list_scene(), tuner)) {
      ++counters.list_repairs;
    } else {
      outer.require(OuterList::Due::rebuild);
    }
  }
  if (outer.is_rebuild_due()) rebuild();
  if (!inner.life().is_running()) prune();
}

void Dem::Impl::prune() {
  fine_level.clear_force(store.size() - tiling.coarse_count);
  counters.missed_contact_onsets += inner.prune({.scene = list_scene(),
                                                 .outer = outer,
                                                 .lifetime = tuner.inner_lifetime(),
                                                 .impulses = fine_level.deferred().all()},
                                                tile_step.ghosts());
  tile_step.begin_list(inner.tiles());
}

/// Ends the inner list, if there is one: histories to rows, particles in free flight catch up, and
/// what the outer list relies on is looked at, up to where the next inner list will end.
void Dem::Impl::synchronise() {
  inner.return_histories();
  if (!inner.life().is_running()) return;
  inner.end();
  const std::int64_t steps_made = inner.life().steps();
  if (steps_made == 0) return;
  tuner.record(ListTuner::InnerStatistics{.was_left = inner.life().is_skin_used_up(),
                                          .steps = steps_made,
                                          .entries = inner.entries(),
                                          .contacts = tile_step.contact_forces().contacts()});
  counters.free_flight_steps += inner.ballistic_count() * steps_made;
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  std::vector<OuterList::Due> due(blocks, OuterList::Due::nothing);
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t begin = b * k_block;
    const std::size_t end = std::min(store.size(), begin + k_block);
    advance_free_flight(motion_rows(), inner.activity(), begin, end, conditions.step(), steps_made);
    due[b] = look_at_outer_list(begin, end);
  });
  for (const OuterList::Due d : due) outer.require(d);
}

/// The outer list holds as long as no particle has left its reference trajectory by more than its
/// skin. An update is asked for early enough for the next look. A fine particle of 10 um pressed
/// between two of 600 um (soft as particles are made to be) comes off with up to the speed at which
/// its elastic energy sets it free, some 10 m/s: more than its skin in one step. The list is
/// updated then, at the cost of a partner that may be missed (counted when the next inner list is
/// pruned). A coarse particle that does this is an error.
OuterList::Due Dem::Impl::look_at_outer_list(std::size_t begin, std::size_t end) const {
  const ListScene scene = list_scene();
  const std::int64_t ahead = tuner.inner_lifetime();
  OuterList::Due due = OuterList::Due::nothing;
  for (std::size_t n = begin; n < end; ++n) {
    const Deviation off = outer.deviation(scene, n, ahead);
    const double skin = outer.trajectories().skin(n);
    if (off.asks_for_another(skin)) due = std::max(due, OuterList::Due::update);
    if (conditions.domain.is_far_out(store.position(n))) {
      due = std::max(due, OuterList::Due::rebuild);
    }
    if (off.now2 <= skin * skin) continue;
    if (!std::isfinite(off.now2)) throw_not_a_number(contact_scene(), inner, n);
    if (tiling.is_coarse(static_cast<std::int32_t>(n))) {
      throw_particle_error(
          contact_scene(), inner, n,
          "moved farther from its predicted trajectory than its skin allows between two checks",
          "speeds far above the expected one: give time.expected_speed or a smaller "
          "time.dem_step");
    }
  }
  return due;
}

/// A new outer list; contacts keep their histories, whatever their particles' new rows are.
void Dem::Impl::rebuild() {
  ++counters.rebuilds;
  gather_wall_loads();
  conditions.domain.wrap(store);
  ContactCarrier contacts = inner.release(store.size());
  reorder_if_due(contacts);
  has_weights = store.has_weights(tiling.coarse_count);
  outer.build(list_scene(), tuner);
  inner.adopt(outer, contacts);
  tile_step.restart(outer.tiles(), wall_loads);
  accounts.energy.restart(outer.tiles());
  fine_level.clear_force(store.size() - tiling.coarse_count);
}

void Dem::Impl::reorder_if_due(ContactCarrier& contacts) {
  if (!outer.is_reorder_due() && counters.rebuilds % k_sort_every != 0) return;
  const RowOrder sorted =
      morton_order(store.contact_rows().position, store.size(), conditions.domain.min(),
                   conditions.largest_diameter(), conditions.steps.coarse_limit);
  tiling = Tiling::of(sorted.coarse_count);
  reorder_rows(sorted.order);
  contacts.renumber(sorted.order);
}

void Dem::Impl::begin_step(double now, bool keeps_force) {
  conditions.time = now;
  particles::move_to(now, conditions.surfaces);
  tile_step.begin(tiling.coarse_count, keeps_force);
  accounts.energy.begin_step();
}

void Dem::Impl::end_step() {
  inner.end_step();
  outer.count_step();
  ++counters.steps;
  counters.particle_steps += static_cast<std::int64_t>(store.size());
}

/// The particles of the finer rates make their sub-steps.
void Dem::Impl::advance_fine() {
  if (tiling.coarse_count == store.size()) {
    fine_level.clear_deferred();
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
            conditions.step());
      });
  fine_level.sub_cycle(scene);
  // Dust squeezed out between coarse particles goes off at several m/s: looked at in every step.
  const std::int32_t bad = inner.check_fine(list_scene());
  if (bad >= 0) throw_not_a_number(contact_scene(), inner, static_cast<std::size_t>(bad));
}

ListScene Dem::Impl::list_scene() const {
  return {.particles = store,
          .tiling = tiling,
          .laws = conditions.laws,
          .surfaces = conditions.surfaces,
          .images = conditions.domain.images(),
          .gravity = conditions.gravity,
          .origin = conditions.domain.min(),
          .step = conditions.step(),
          .largest_diameter = conditions.largest_diameter()};
}

ContactScene Dem::Impl::contact_scene() const {
  return {.particles = store,
          .laws = conditions.laws,
          .surfaces = conditions.surfaces,
          .images = conditions.domain.images(),
          .step = conditions.step(),
          .time = conditions.time,
          .has_weights = has_weights};
}

ContactScene Dem::Impl::contact_scene_at(double time, std::span<const Surface> surfaces) const {
  ContactScene scene = contact_scene();
  scene.surfaces = surfaces;
  scene.time = time;
  return scene;
}

OpeningMarks Dem::Impl::opening_marks() {
  return {conditions.openings, conditions.opening_rounding, store.touched_openings()};
}

StepScene Dem::Impl::step_scene() {
  ContactScene contacts = contact_scene();
  contacts.opening_marks = opening_marks();
  if (accounts.work.is_on()) contacts.work = &accounts.work;
  if (accounts.energy.is_on()) contacts.energy = &accounts.energy;
  return {.particles = store,
          .lists = inner,
          .impulses = fine_level.deferred(),
          .list_scene = list_scene(),
          .contacts = contacts,
          .motion = motion_rows()};
}

FineScene Dem::Impl::fine_scene() {
  return {.laws = conditions.laws,
          .surfaces = conditions.surfaces,
          .steps = conditions.steps,
          .images = conditions.domain.images(),
          .gravity = conditions.gravity,
          .particles = store,
          .coarse_count = tiling.coarse_count,
          .active = inner.fine_active().all(),
          .contacts = inner.fine().view(),
          .time = conditions.time,
          .wall_loads = wall_loads,
          .opening_marks = opening_marks(),
          .work = accounts.work.is_on() ? &accounts.work : nullptr,
          .contact_force = tile_step.contact_force()};
}

}  // namespace dust::particles
