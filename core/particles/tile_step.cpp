// SPDX-License-Identifier: Apache-2.0
#include "particles/tile_step.hpp"

#include "particles/energy/motion_energy.hpp"
#include "particles/motion/integrate.hpp"
#include "particles/particle_error.hpp"

#include <algorithm>

namespace dust::particles {

void TileStep::restart(std::size_t tiles, const WallLoads& loads) {
  contact_forces_.restart(tiles, loads);
  phase_times_.restart(tiles);
  contact_force_.clear();  // in the order of rows that were
}

void TileStep::begin(std::size_t coarse_count, bool keeps_force) {
  if (keeps_force) {
    contact_force_.assign(4 * coarse_count, 0.0);
  } else {
    contact_force_.clear();
  }
  ghosts_.begin_step();
}

/// All contacts of a tile: forces on its particles into the buffer, those on its ghosts published.
void TileStep::evaluate(const StepScene& scene, Tile tile, ForceBuffer& force) {
  const auto t = static_cast<std::size_t>(tile.index);
  contact_forces_.evaluate(scene.contacts, tile, scene.lists.contacts(t), force.rows());
  ghosts_.publish(tile.index, force.ghosts());
  if (!contact_force_.empty()) keep_force(active_of(scene, tile), tile, force.rows());
}

void TileStep::keep_force(const ActiveSet& active, Tile tile, const double* force) {
  for (const std::int32_t row : active.all()) {
    std::copy_n(force + k_force_row * static_cast<std::size_t>(row - tile.begin), 3,
                contact_force_.data() + 4 * static_cast<std::ptrdiff_t>(row));
  }
}

void TileStep::note_contribution(std::int32_t row, const double* given) {
  if (contact_force_.empty()) return;
  double* kept = contact_force_.data() + 4 * static_cast<std::ptrdiff_t>(row);
  for (int d = 0; d < 3; ++d) kept[d] += given[d];
}

void TileStep::add_contributions(Tile tile, ForceBuffer& force) {
  ghosts_.for_each_contribution(tile.index, [&](std::int32_t row, const double* given) {
    double* f = force.rows() + k_force_row * static_cast<std::size_t>(row - tile.begin);
    for (std::size_t d = 0; d < k_force_row; ++d) f[d] += given[d];
    note_contribution(row, given);
  });
}

/// The same to those that wait, who stand in the order of rows.
void TileStep::add_to_deferred(const StepScene& scene, Tile tile) {
  const ActiveSet& active = active_of(scene, tile);
  const std::span<const std::int32_t> rows = active.all();
  const std::size_t moved = deferred_.moved(tile.index);
  double* const force = deferred_.rows(tile.index).data();
  std::size_t place = active.unshared_count();
  ghosts_.for_each_contribution(tile.index, [&](std::int32_t row, const double* given) {
    while (rows[place] != row) ++place;
    double* f = force + k_force_row * (place - moved);
    for (std::size_t d = 0; d < k_force_row; ++d) f[d] += given[d];
    note_contribution(row, given);
  });
}

/// Before particles move: those that fine ones were near go on with the velocity that they ended
/// the last step with.
void TileStep::apply_impulses(const StepScene& scene, Tile tile, Selection selection) {
  for (const DeferredImpulse& impulse : scene.impulses.of(tile.begin, tile.end)) {
    const bool is_shared = scene.lists.is_shared(impulse.particle);
    if (selection != Selection::all && is_shared != (selection == Selection::shared)) continue;
    impulse.act_on(scene.particles);
  }
}

/// Takes what contacts have dissipated out of rows of forces that are complete: zeros stay there.
/// place_of(k) is the row of the k-th of `particles`.
template <class PlaceOf>
void TileStep::take_work(const StepScene& scene, std::span<const std::int32_t> particles,
                         double* force, const PlaceOf& place_of) {
  ContactWork* const work = scene.contacts.work;
  if (work == nullptr) return;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const auto row = static_cast<std::size_t>(particles[k]);
    double* f = force + k_force_row * static_cast<std::size_t>(place_of(k));
    work->add_with_particles(row, f[k_normal_work], f[k_tangential_work]);
    f[k_normal_work] = f[k_tangential_work] = 0.0;
    work->note_acceleration(row,
                            norm(sdk::Vec3{f[0], f[1], f[2]}) * scene.particles.inverse_mass(row));
  }
}

/// Lets particles move; their energy is booked where a run keeps account of it.
template <class Move>
void TileStep::with_energy(const StepScene& scene, Tile tile, std::span<const std::int32_t> rows,
                           Move&& move) {
  EnergyAccount* const account = scene.contacts.energy;
  if (account == nullptr) {
    move();
    return;
  }
  const MotionEnergy energy(scene.particles, rows);
  move();
  energy.add_to(account->tile(static_cast<std::size_t>(tile.index)), scene.motion.gravity);
}

/// All active particles move at once, while the rows and forces are in the cache.
void TileStep::move_all(const StepScene& scene, Tile tile, ForceBuffer& force) {
  const ActiveSet& active = active_of(scene, tile);
  apply_impulses(scene, tile, Selection::all);
  deferred_.clear(tile.index);
  take_work(scene, active.all(), force.rows(),
            [&](std::size_t k) { return active.all()[k] - tile.begin; });
  with_energy(scene, tile, active.all(), [&] {
    if (active.size() == tile.size()) {
      integrate_tile(scene.motion, tile, force.rows(), scene.step());
    } else {
      integrate_in_tile(scene.motion, tile, active.all(), force.rows(), scene.step());
    }
  });
  check(scene, tile);
}

/// Those that no other tile looks at move at once; the others' forces are put aside.
void TileStep::move_unshared(const StepScene& scene, Tile tile, ForceBuffer& force) {
  const ActiveSet& active = active_of(scene, tile);
  apply_impulses(scene, tile, Selection::unshared);
  take_work(scene, active.unshared(), force.rows(),
            [&](std::size_t k) { return active.unshared()[k] - tile.begin; });
  with_energy(scene, tile, active.unshared(), [&] {
    integrate_in_tile(scene.motion, tile, active.unshared(), force.rows(), scene.step());
  });
  deferred_.keep(tile, active.all(), active.unshared_count(), force);
}

void TileStep::move_deferred(const StepScene& scene, Tile tile) {
  const ActiveSet& active = active_of(scene, tile);
  const std::size_t moved = deferred_.moved(tile.index);
  apply_impulses(scene, tile, moved == 0 ? Selection::all : Selection::shared);
  const std::span<const std::int32_t> rows = active.all().subspan(moved);
  take_work(scene, rows, deferred_.rows(tile.index).data(), [](std::size_t k) { return k; });
  with_energy(scene, tile, rows, [&] {
    integrate_in_order(scene.motion, rows, deferred_.rows(tile.index).data(), scene.step());
  });
  deferred_.clear(tile.index);
  check(scene, tile);
}

void TileStep::check(const StepScene& scene, Tile tile) {
  if (!scene.lists.life().is_check_due()) return;
  const std::int32_t bad =
      scene.lists.check(static_cast<std::size_t>(tile.index), scene.list_scene);
  if (bad >= 0) throw_not_a_number(scene.contacts, scene.lists, static_cast<std::size_t>(bad));
}

void TileStep::contact(const StepScene& scene) {
  each_tile(scene, [&](Tile tile) {
    ForceBuffer force(tile, ghosts_.ghosts(tile.index).size());
    evaluate(scene, tile, force);
    deferred_.keep(tile, active_of(scene, tile).all(), 0, force);
  });
}

void TileStep::force(const StepScene& scene) {
  each_deferred(scene, [&](Tile tile) { add_to_deferred(scene, tile); });
}

void TileStep::integrate(const StepScene& scene) {
  each_deferred(scene, [&](Tile tile) { move_deferred(scene, tile); });
}

void TileStep::run(const StepScene& scene, bool is_timed) {
  each_tile(scene, [&](Tile tile) {
    ForceBuffer force(tile, ghosts_.ghosts(tile.index).size());
    auto clock = phase_times_.clock(static_cast<std::size_t>(tile.index), is_timed);
    evaluate(scene, tile, force);
    clock.stop(PhaseTimes::k_contact);
    if (ghosts_.has_all(tile.index)) {
      add_contributions(tile, force);
      clock.stop(PhaseTimes::k_force);
      move_all(scene, tile, force);
    } else {
      move_unshared(scene, tile, force);
    }
    clock.stop(PhaseTimes::k_integration);
  });
  each_deferred(scene, [&](Tile tile) {
    auto clock = phase_times_.clock(static_cast<std::size_t>(tile.index), is_timed);
    add_to_deferred(scene, tile);
    clock.stop(PhaseTimes::k_force);
    move_deferred(scene, tile);
    clock.stop(PhaseTimes::k_integration);
  });
}

void TileStep::add_force(const StepScene& scene,
                         const std::function<sdk::Vec3(std::size_t)>& force) {
  each_deferred(scene, [&](Tile tile) {
    double* f = deferred_.rows(tile.index).data();
    for (const std::int32_t row :
         active_of(scene, tile).all().subspan(deferred_.moved(tile.index))) {
      const sdk::Vec3 more = force(static_cast<std::size_t>(row));
      for (int d = 0; d < 3; ++d) f[d] += more[d];
      f += k_force_row;
    }
  });
}

void TileStep::save(sdk::ArchiveWriter& archive, const Tiling& tiling) const {
  archive.numbers("contact_force", contact_force_);
  std::vector<std::int64_t> bounds;
  for (std::size_t t = 0; t < contact_forces_.tiles(); ++t) {
    const Tile tile = tiling.tile(t);
    bounds.insert(bounds.end(), {tile.begin, tile.end, contact_forces_.contacts(t)});
  }
  archive.integers("tiles", bounds);
  archive.number("largest_coarse_overlap", contact_forces_.largest_overlap());
}

std::size_t TileStep::load(sdk::ArchiveReader& archive, const WallLoads& loads) {
  const auto bounds = archive.integers("tiles");
  const std::size_t tiles = bounds.size() / 3;
  restart(tiles, loads);
  for (std::size_t t = 0; t < tiles; ++t) contact_forces_.set_contacts(t, bounds[3 * t + 2]);
  contact_forces_.set_largest_overlap(archive.number("largest_coarse_overlap"));
  const auto forces = archive.numbers("contact_force");
  contact_force_.assign(forces.begin(), forces.end());
  return tiles;
}

}  // namespace dust::particles
