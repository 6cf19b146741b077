// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"
#include "particles/motion/integrate.hpp"

#include <algorithm>

/// The step of the coarse particles, tile by tile: contacts, forces, integration. A tile whose
/// forces are complete goes through all three in one task, while its rows are in the cache
/// (docs/decisions/0012_forces_stay_in_the_cache.md); phase by phase, for whoever wants to look or
/// add something in between, the bits are the same.
namespace dust::particles {
void Dem::Impl::begin_contacts(double now, bool keeps_force) {
  time = now;
  if (keeps_force) {
    contact_force.assign(4 * tiling.coarse_count, 0.0);
  } else {
    contact_force.clear();
  }
  ghosts.begin_step();
  for (Surface& s : surfaces) s.move_to(now);
}

/// All contacts of a tile: forces on its particles into the buffer, those on its ghosts published.
void Dem::Impl::evaluate(Tile tile, ForceBuffer& force) {
  const auto t = static_cast<std::size_t>(tile.index);
  contact_forces.evaluate(contact_scene(), tile, inner.contacts(t), force.rows());
  ghosts.publish(tile.index, force.ghosts());
  if (!contact_force.empty()) keep_force(tile, force.rows());
}

void Dem::Impl::keep_force(Tile tile, const double* force) {
  for (const std::int32_t row : inner.active(static_cast<std::size_t>(tile.index)).all()) {
    std::copy_n(force + k_force_row * static_cast<std::size_t>(row - tile.begin), 3,
                contact_force.data() + 4 * static_cast<std::ptrdiff_t>(row));
  }
}

void Dem::Impl::note_contribution(std::int32_t row, const double* given) {
  if (contact_force.empty()) return;
  double* kept = contact_force.data() + 4 * static_cast<std::ptrdiff_t>(row);
  for (int d = 0; d < 3; ++d) kept[d] += given[d];
}

void Dem::Impl::add_contributions(Tile tile, ForceBuffer& force) {
  ghosts.for_each_contribution(tile.index, [&](std::int32_t row, const double* given) {
    double* f = force.rows() + k_force_row * static_cast<std::size_t>(row - tile.begin);
    for (std::size_t d = 0; d < k_force_row; ++d) f[d] += given[d];
    note_contribution(row, given);
  });
}

/// The same to those that wait, who stand in the order of rows.
void Dem::Impl::add_to_deferred(Tile tile) {
  const ActiveSet& active = inner.active(static_cast<std::size_t>(tile.index));
  const std::span<const std::int32_t> rows = active.all();
  const std::size_t moved = deferred.moved(tile.index);
  double* const force = deferred.rows(tile.index).data();
  std::size_t place = active.unshared_count();
  ghosts.for_each_contribution(tile.index, [&](std::int32_t row, const double* given) {
    while (rows[place] != row) ++place;
    double* f = force + k_force_row * (place - moved);
    for (std::size_t d = 0; d < k_force_row; ++d) f[d] += given[d];
    note_contribution(row, given);
  });
}

/// All active particles move at once, while the rows and forces are in the cache.
void Dem::Impl::move_all(Tile tile, ForceBuffer& force) {
  const ActiveSet& active = inner.active(static_cast<std::size_t>(tile.index));
  apply_deferred_impulses(tile, Movers::all);
  deferred.clear(tile.index);
  if (active.size() == tile.size()) {
    integrate_tile(motion_rows(), tile, force.rows(), steps.coarse_step);
  } else {
    integrate_in_tile(motion_rows(), tile, active.all(), force.rows(), steps.coarse_step);
  }
  check(tile);
}

/// Those that no other tile looks at move at once; the others' forces are put aside.
void Dem::Impl::move_unshared(Tile tile, ForceBuffer& force) {
  const ActiveSet& active = inner.active(static_cast<std::size_t>(tile.index));
  apply_deferred_impulses(tile, Movers::unshared);
  integrate_in_tile(motion_rows(), tile, active.unshared(), force.rows(), steps.coarse_step);
  deferred.keep(tile, active.all(), active.unshared_count(), force);
}

void Dem::Impl::move_deferred(Tile tile) {
  const ActiveSet& active = inner.active(static_cast<std::size_t>(tile.index));
  const std::size_t moved = deferred.moved(tile.index);
  apply_deferred_impulses(tile, moved == 0 ? Movers::all : Movers::shared);
  integrate_in_order(motion_rows(), active.all().subspan(moved), deferred.rows(tile.index).data(),
                     steps.coarse_step);
  deferred.clear(tile.index);
  check(tile);
}

void Dem::Impl::check(Tile tile) {
  if (!inner.life().is_check_due()) return;
  const std::int32_t bad = inner.check(static_cast<std::size_t>(tile.index), list_scene());
  if (bad >= 0) fail_as_not_a_number(static_cast<std::size_t>(bad));
}

void Dem::Impl::contact(double now, bool keeps_force) {
  begin_contacts(now, keeps_force);
  each_tile([&](Tile tile) {
    ForceBuffer force(tile, ghosts.ghosts(tile.index).size());
    evaluate(tile, force);
    deferred.keep(tile, inner.active(static_cast<std::size_t>(tile.index)).all(), 0, force);
  });
}

void Dem::Impl::force() {
  each_deferred([&](Tile tile) { add_to_deferred(tile); });
}

void Dem::Impl::integrate() {
  each_deferred([&](Tile tile) { move_deferred(tile); });
  end_tiles();
}

/// contact(), force() and integrate() at once: a tile goes through as many of them as it can.
void Dem::Impl::step_tiles(double now, bool keeps_force) {
  begin_contacts(now, keeps_force);
  const bool is_timed = PhaseTimes::is_due(counters.steps);
  each_tile([&](Tile tile) {
    ForceBuffer force(tile, ghosts.ghosts(tile.index).size());
    auto clock = phase_times.clock(static_cast<std::size_t>(tile.index), is_timed);
    evaluate(tile, force);
    clock.stop(PhaseTimes::k_contact);
    if (ghosts.has_all(tile.index)) {
      add_contributions(tile, force);
      clock.stop(PhaseTimes::k_force);
      move_all(tile, force);
    } else {
      move_unshared(tile, force);
    }
    clock.stop(PhaseTimes::k_integration);
  });
  each_deferred([&](Tile tile) {
    auto clock = phase_times.clock(static_cast<std::size_t>(tile.index), is_timed);
    add_to_deferred(tile);
    clock.stop(PhaseTimes::k_force);
    move_deferred(tile);
    clock.stop(PhaseTimes::k_integration);
  });
  end_tiles();
}

void Dem::Impl::end_tiles() {
  inner.end_step();
  outer.count_step();
  ++counters.steps;
  counters.particle_steps += static_cast<std::int64_t>(store.size());
}

}  // namespace dust::particles
