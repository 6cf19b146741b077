// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include <algorithm>
#include <utility>

namespace dust::particles {
namespace {

template <class T>
std::vector<std::int64_t> widened(const std::vector<T>& v) {
  return {v.begin(), v.end()};
}

}  // namespace

void Dem::Impl::save(sdk::ArchiveWriter& archive) const {
  const auto rows = [&](const char* name, const contact::AlignedVector<double>& v) {
    archive.numbers(name, {v.data(), v.size()});
  };
  rows("position", store.position);
  rows("motion", store.motion);
  rows("spin", store.spin);
  if (store.has_fluid) {
    rows("action", store.action);
    rows("impulse", store.impulse);
    rows("decay", store.decay);
  }
  archive.integers("id", store.id);
  archive.integers("material", widened(store.material));
  archive.integers("population", widened(store.population));
  archive.numbers("weight", store.weight);

  outer.save(archive);
  inner.save(archive);
  archive.numbers("contact_force", contact_force);

  std::vector<std::int64_t> bounds;
  for (std::size_t t = 0; t < inner.tiles(); ++t) {
    const Tile tile = tiling.tile(t);
    bounds.insert(bounds.end(), {tile.begin, tile.end, contact_forces.contacts(t)});
  }
  archive.integers("chunks", bounds);
  fine_level.save(archive);
  const ListTuner::State lists = tuner.state();
  const OuterList::State list = outer.state();
  const std::int64_t state[] = {static_cast<std::int64_t>(tiling.coarse_count),
                                next_id,
                                list.age,
                                lists.outer_lifetime,
                                lists.next_outer_lifetime,
                                list.due >= OuterList::Due::rebuild,
                                list.due == OuterList::Due::reorder,
                                has_fluid,
                                counters.steps,
                                counters.particle_steps,
                                fine_level.sub_steps(),
                                counters.rebuilds,
                                counters.contacts_seen_late,
                                counters.flown_steps,
                                lists.skin_level,
                                lists.inner_lifetime,
                                list.due == OuterList::Due::update,
                                list.updated,
                                counters.mends};
  archive.integers("state", state);
  archive.number("time", time);
  archive.number("largest_coarse_overlap", contact_forces.largest_overlap());
  book.save(archive);
}

void Dem::Impl::load(sdk::ArchiveReader& archive) {
  const auto rows = [&](const char* name, contact::AlignedVector<double>& v) {
    const auto values = archive.numbers(name);
    v.assign(values.begin(), values.end());
  };
  rows("position", store.position);
  rows("motion", store.motion);
  rows("spin", store.spin);
  if (store.has_fluid) {
    rows("action", store.action);
    rows("impulse", store.impulse);
    rows("decay", store.decay);
  }
  store.id = archive.integers("id");
  const auto material = archive.integers("material");
  const auto population = archive.integers("population");
  store.material.assign(material.begin(), material.end());
  store.population.assign(population.begin(), population.end());
  store.weight = archive.numbers("weight");

  const auto forces = archive.numbers("contact_force");
  contact_force.assign(forces.begin(), forces.end());
  const auto state = archive.integers("state");
  tiling = Tiling::of(static_cast<std::size_t>(state.at(0)));
  next_id = state.at(1);
  has_fluid = state.at(7) != 0;
  counters.steps = state.at(8);
  counters.particle_steps = state.at(9);
  counters.rebuilds = state.at(11);
  counters.contacts_seen_late = state.at(12);
  counters.flown_steps = state.at(13);
  tuner.restore({state.at(3), state.at(4), state.at(14), state.at(15)});
  counters.mends = state.at(18);
  OuterList::Due due = OuterList::Due::nothing;
  if (state.at(16) != 0) due = OuterList::Due::update;
  if (state.at(5) != 0) due = OuterList::Due::rebuild;
  if (state.at(6) != 0) due = OuterList::Due::reorder;
  load_tiles(archive, {.age = state.at(2), .updated = state.at(17), .due = due});
  time = archive.number("time");
  contact_forces.set_largest_overlap(archive.number("largest_coarse_overlap"));
  fine_level.load(archive, state.at(10));
  for (Surface& s : surfaces) s.move_to(time);
  book.load(archive);
  look_at_weights();
}

/// Lists and what is kept of tiles.
void Dem::Impl::load_tiles(sdk::ArchiveReader& archive, const OuterList::State& list) {
  const auto bounds = archive.integers("chunks");
  const std::size_t tiles = bounds.size() / 3;
  outer.load(archive, tiles, tuner.outer_lifetime(), list);
  inner.load(archive, tiles);
  contact_forces.restart(tiles, wall_loads.walls());
  phase_times.restart(tiles);
  for (std::size_t t = 0; t < tiles; ++t) contact_forces.set_contacts(t, bounds[3 * t + 2]);
}

}  // namespace dust::particles
