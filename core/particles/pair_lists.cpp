// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"
#include "particles/motion/free_flight.hpp"
#include "particles/row_order.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

/// The pair lists in the steps of the solver: when one ends, and what follows.
namespace dust::particles {
namespace {

/// Rebuilds between two sorts of the rows where no particle came or went.
constexpr std::int64_t k_sort_every = 4;

}  // namespace

/// Before every coarse step; in most steps two comparisons.
void Dem::Impl::neighbours() {
  if (inner.life().is_over() || outer.is_rebuild_due()) land();
  if (outer.is_update_due()) {
    if (outer.update(list_scene(), tuner)) {
      ++counters.mends;
    } else {
      outer.require(OuterList::Due::rebuild);
    }
  }
  if (outer.is_rebuild_due()) rebuild();
  if (!inner.life().is_running()) prune();
}

void Dem::Impl::prune() {
  fine_level.clear_force(store.size() - tiling.coarse_count);
  counters.contacts_seen_late += inner.prune({.scene = list_scene(),
                                              .outer = outer,
                                              .lifetime = tuner.inner_lifetime(),
                                              .impulses = fine_level.deferred().all(),
                                              .all_active = all_step},
                                             ghosts);
  deferred.restart(inner.tiles());
}

/// Ends the inner list, if there is one: histories to rows, particles in free flight catch up, and
/// what the outer list relies on is looked at, up to where the next inner list will end.
void Dem::Impl::land() {
  inner.return_histories();
  if (!inner.life().is_running()) return;
  inner.end();
  const std::int64_t steps_made = inner.life().steps();
  if (steps_made == 0) return;
  tuner.record(ListTuner::InnerStatistics{.was_left = inner.life().is_skin_used_up(),
                                          .steps = steps_made,
                                          .entries = inner.entries(),
                                          .contacts = contact_forces.contacts()});
  counters.flown_steps += inner.ballistic_count() * steps_made;
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  std::vector<OuterList::Due> due(blocks, OuterList::Due::nothing);
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t begin = b * k_block;
    const std::size_t end = std::min(store.size(), begin + k_block);
    advance_free_flight(motion_rows(), inner.activity(), begin, end, steps.coarse_step, steps_made);
    look_at_outer_list(begin, end, due[b]);
  });
  for (const OuterList::Due d : due) outer.require(d);
}

/// The outer list holds as long as no particle has left its reference trajectory by more than its
/// skin. An update is asked for early enough for the next look. A fine particle of 10 um pressed
/// between two of 600 um (soft as particles are made to be) comes off with up to the speed at which
/// its elastic energy sets it free, some 10 m/s: more than its skin in one step. The list is
/// updated then, at the cost of a partner that may be missed (counted when the next inner list is
/// pruned). A coarse particle that does this is an error.
void Dem::Impl::look_at_outer_list(std::size_t begin, std::size_t end, OuterList::Due& due) const {
  const ListScene scene = list_scene();
  const std::int64_t ahead = tuner.inner_lifetime();
  for (std::size_t n = begin; n < end; ++n) {
    const Deviation off = outer.deviation(scene, n, ahead);
    const double skin = outer.trajectories().skin(n);
    if (off.asks_for_another(skin)) due = std::max(due, OuterList::Due::update);
    if (is_far_out(n)) due = std::max(due, OuterList::Due::rebuild);
    if (off.now2 <= skin * skin) continue;
    if (!std::isfinite(off.now2)) fail_as_not_a_number(n);
    if (tiling.is_coarse(static_cast<std::int32_t>(n))) {
      fail(n, "moved farther off its course than its skin allows between two checks",
           "speeds far above the expected one: give time.expected_speed or a smaller "
           "time.dem_step");
    }
  }
}

/// Positions are wrapped at rebuilds only: one is due when a particle is far beyond a periodic
/// side.
bool Dem::Impl::is_far_out(std::size_t n) const {
  if (!is_periodic) return false;
  const double slack = store.position[4 * n + 3];
  for (int d = 0; d < 3; ++d) {
    const double x = store.position[4 * n + static_cast<std::size_t>(d)];
    if (images.length[d] > 0.0 && (x < domain_min[d] - slack || x > domain_max[d] + slack)) {
      return true;
    }
  }
  return false;
}

/// A new outer list; contacts keep their histories, whatever their particles' new rows are.
void Dem::Impl::rebuild() {
  ++counters.rebuilds;
  gather_wall_loads();
  wrap_periodic();
  ContactCarrier contacts = inner.release(store.size());
  reorder_if_due(contacts);
  look_at_weights();
  outer.build(list_scene(), tuner);
  inner.adopt(outer, contacts);
  contact_forces.restart(outer.tiles(), wall_loads.walls());
  phase_times.restart(outer.tiles());
  fine_level.clear_force(store.size() - tiling.coarse_count);
  contact_force.clear();  // in the order of rows that were
}

void Dem::Impl::reorder_if_due(ContactCarrier& contacts) {
  if (!outer.is_reorder_due() && counters.rebuilds % k_sort_every != 0) return;
  const RowOrder sorted = morton_order(store.position.data(), store.size(), domain_min,
                                       steps.classes.back().diameter, steps.coarse_limit);
  tiling = Tiling::of(sorted.coarse_count);
  store.reorder(sorted.order);
  outer.reorder(sorted.order);
  contacts.renumber(sorted.order);
  if (fine_level.deferred().all().empty()) return;
  std::vector<std::int32_t> new_row(sorted.order.size());
  for (std::size_t n = 0; n < new_row.size(); ++n) {
    new_row[static_cast<std::size_t>(sorted.order[n])] = static_cast<std::int32_t>(n);
  }
  fine_level.renumber(new_row);
}

void Dem::Impl::wrap_periodic() {
  if (!is_periodic) return;
  for (std::size_t n = 0; n < store.size(); ++n) {
    for (int d = 0; d < 3; ++d) {
      double& x = store.position[4 * n + static_cast<std::size_t>(d)];
      if (images.length[d] > 0.0) {
        if (x < domain_min[d]) x += images.length[d];
        if (x >= domain_max[d]) x -= images.length[d];
      }
    }
  }
}

}  // namespace dust::particles
