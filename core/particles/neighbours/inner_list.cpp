// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/inner_list.hpp"

#include "particles/motion/free_acceleration.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dust::particles {
namespace {

/// Skin of the inner list as a share of that of the outer one: the outer list's check, made only
/// when an inner list ends, triggers at 0.7 of its skin, so that 0.7 + k_skin_share stays below 1.
constexpr double k_skin_share = 1.0 / 6.0;
/// No more than a particle flies in so many coarse steps: what rests side by side in a bed need not
/// be looked at. Its own speed counts, or that of the fast ones among all, of which one may hit it:
/// the fastest, but no more than this often the root mean square, lest one that bounces above a bed
/// at rest has all of the bed look far.
constexpr double k_reach_steps = 16.0;
constexpr double k_fast = 4.0;
/// [-] and no less than this share of a diameter.
constexpr double k_min_reach = 0.004;

/// Those of `unseen` entries whose particles have both made steps: the others came so.
std::int64_t count_missed(const ListScene& scene, const PairList& outer,
                          std::span<const std::int32_t> unseen) {
  return std::count_if(unseen.begin(), unseen.end(), [&](std::int32_t entry) {
    const auto q = static_cast<std::size_t>(entry);
    return scene.has_made_steps(outer.a()[q]) && scene.has_made_steps(outer.b()[q]);
  });
}

}  // namespace

void InnerList::set_tiles(std::size_t count) {
  tiles_.clear();
  for (std::size_t t = 0; t < count; ++t) tiles_.emplace_back(stride_);
}

std::int64_t InnerList::prune(const PruneInput& in, GhostExchange& ghosts) {
  const ListScene& scene = in.scene;
  const std::size_t count = scene.particles.size();
  activity_.assign(count, k_ballistic);
  choose_skins(in);
  for (const DeferredImpulse& impulse : in.impulses) activate(impulse.particle);
  const double duration = scene.time_of(in.lifetime);
  const contact::RowView rows = scene.particles.contact_rows();
  const Pruning p{.in = in,
                  .trajectories = {rows.position, rows.motion, skin_.data()},
                  // Two steps: the velocities at hand are not quite those of the step behind.
                  .look_ahead = {.range = scene.laws.largest_range(),
                                 .lifetime = duration,
                                 .behind = 2.0 * scene.step},
                  .duration = duration};
  ghosts.restart(tiles_.size(), scene.tiling.tile_size, scene.tiling.coarse_count);
  oneapi::tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
    prune_tile(p, tiles_[t], scene.tiling.tile(t), ghosts);
  });
  // Ghosts are looked at by other tiles: they may not move before all contacts are done.
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    for (const std::int32_t row : ghosts.ghosts(static_cast<std::int32_t>(t))) {
      activity_[static_cast<std::size_t>(row)] = k_shared;
    }
  }
  std::int64_t missed = prune_fine(p);
  oneapi::tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
    const Tile range = scene.tiling.tile(t);
    collect_active(p, static_cast<std::size_t>(range.begin), static_cast<std::size_t>(range.end),
                   tiles_[t].active);
  });
  collect_active(p, scene.tiling.coarse_count, count, fine_active_);
  ghosts.plan();
  ballistic_count_ = static_cast<std::int64_t>(count - fine_active_.size());
  for (const OfTile& tile : tiles_) {
    missed += tile.missed_onsets;
    ballistic_count_ -= static_cast<std::int64_t>(tile.active.size());
  }
  life_.begin(in.lifetime);
  return missed;
}

/// How far each particle may be off its trajectory.
void InnerList::choose_skins(const PruneInput& in) {
  const ListScene& scene = in.scene;
  const double fast = std::min(scene.fastest_speed(), k_fast * scene.typical_speed());
  const double least = k_min_reach * scene.largest_diameter;
  skin_.resize(scene.particles.size());
  oneapi::tbb::parallel_for(std::size_t{0}, scene.blocks(), [&](std::size_t b) {
    const std::size_t end = std::min(scene.particles.size(), (b + 1) * k_block);
    for (std::size_t n = b * k_block; n < end; ++n) {
      const double speed = std::max(fast, std::sqrt(scene.speed2(n)));
      const double reach = std::max(k_reach_steps * speed * scene.step, least);
      skin_[n] = std::min(k_skin_share * in.outer.trajectories().skin(n), reach);
    }
  });
}

bool InnerList::may_meet(const Pruning& p, std::int32_t row, std::int32_t surface) const {
  const ListScene& scene = p.in.scene;
  const auto n = static_cast<std::size_t>(row);
  return scene.may_meet(n, scene.surfaces[static_cast<std::size_t>(surface)],
                        scene.radius(n) + scene.laws.largest_range() + skin_[n], p.duration);
}

void InnerList::activate(std::int32_t row) {
  std::uint8_t& activity = activity_[static_cast<std::size_t>(row)];
  activity = std::max(activity, k_active);
}

void InnerList::prune_tile(const Pruning& p, OfTile& tile, Tile range, GhostExchange& ghosts) {
  thread_local std::vector<std::uint8_t> approach;
  const PairList& near = p.in.outer.pairs(static_cast<std::size_t>(range.index));
  approach.resize(near.size());
  contact::mark_approaching(p.trajectories, p.in.scene.images, p.look_ahead, near.a(), near.b(),
                            approach.data());
  TileContacts& contacts = tile.contacts;
  tile.missed_onsets = count_missed(p.in.scene, near, contacts.pairs.prune(near, approach));
  const PairList& walls = p.in.outer.walls(static_cast<std::size_t>(range.index));
  approach.resize(walls.size());
  for (std::size_t q = 0; q < walls.size(); ++q) {
    approach[q] = may_meet(p, walls.a()[q], walls.b()[q]) ? contact::k_may_meet : 0;
  }
  contacts.walls.prune(walls, approach);
  contacts.nearest_triangles.assign(contacts.walls.size(), -1);
  ghosts.find_ghosts(range, contacts.pairs.a(), contacts.pairs.b(), contacts.slots);
  const auto activate_own = [&](std::int32_t row) {
    if (row < range.end) activity_[static_cast<std::size_t>(row)] = k_active;
  };
  for (const std::int32_t row : contacts.pairs.a()) activate_own(row);
  for (const std::int32_t row : contacts.pairs.b()) activate_own(row);
  for (const std::int32_t row : contacts.walls.a()) activate_own(row);
  tile.is_skin_used_up = false;
}

std::int64_t InnerList::prune_fine(const Pruning& p) {
  const PairList& near = p.in.outer.fine();
  std::vector<std::uint8_t> approach(near.size());
  for (std::size_t q = 0; q < approach.size(); ++q) {
    const std::int32_t i = near.a()[q];
    const std::int32_t j = near.b()[q];
    if (j < 0) {
      approach[q] = may_meet(p, i, -1 - j) ? contact::k_may_meet : 0;
    } else {
      contact::mark_approaching(p.trajectories, p.in.scene.images, p.look_ahead, {&i, 1}, {&j, 1},
                                &approach[q]);
    }
  }
  const std::int64_t missed = count_missed(p.in.scene, near, fine_.prune(near, approach));
  for (std::size_t e = 0; e < fine_.size(); ++e) {
    activate(fine_.a()[e]);
    if (fine_.b()[e] >= 0) activate(fine_.b()[e]);
  }
  return missed;
}

/// Whether a particle without contacts leaves its straight trajectory by little enough.
bool InnerList::flies_straight(const Pruning& p, std::size_t n) const {
  const ListScene& scene = p.in.scene;
  if (!scene.has_made_steps(static_cast<std::int32_t>(n))) return false;
  const sdk::Vec3 free = free_acceleration(scene.particles, scene.gravity, n);
  const double bend = (0.5 * p.duration + scene.step) * p.duration;
  const double limit = 0.5 * skin_[n];
  return dot(free, free) * bend * bend < limit * limit;
}

void InnerList::collect_active(const Pruning& p, std::size_t begin, std::size_t end,
                               ActiveSet& active) {
  active.clear();
  for (std::size_t n = begin; n < end; ++n) {
    if (activity_[n] == k_ballistic && (all_active_ || !flies_straight(p, n))) {
      activity_[n] = k_active;
    }
    if (activity_[n] == k_active) active.add(p.in.scene.particles, n, skin_[n]);
  }
  active.end_unshared();
  for (std::size_t n = begin; n < end; ++n) {
    if (activity_[n] == k_shared) active.add(p.in.scene.particles, n, skin_[n]);
  }
}

void InnerList::return_histories() {
  // Everyone who reads rows asks for it: nearly always they are there.
  if (std::none_of(tiles_.begin(), tiles_.end(), [](const OfTile& tile) {
        return tile.contacts.pairs.has_histories_in_columns();
      })) {
    return;
  }
  oneapi::tbb::parallel_for(std::size_t{0}, tiles_.size(),
                            [&](std::size_t t) { tiles_[t].contacts.pairs.histories_to_rows(); });
}

std::int64_t InnerList::entries() const {
  std::int64_t sum = 0;
  for (const OfTile& t : tiles_) {
    sum += static_cast<std::int64_t>(t.contacts.pairs.size() + t.contacts.walls.size());
  }
  return sum;
}

std::int32_t InnerList::check(std::size_t tile, const ListScene& scene) {
  const ActiveSet::Check found = tiles_[tile].active.check(
      scene.particles, scene.time_of(life_.steps() + 1), scene.time_of(life_.check_interval()));
  tiles_[tile].is_skin_used_up = found.is_skin_used_up;
  return found.not_a_number;
}

void InnerList::end_step() {
  if (life_.is_check_due()) {
    for (const OfTile& tile : tiles_) {
      if (tile.is_skin_used_up) life_.note_skin_used_up();
    }
  }
  life_.count_step();
}

std::int32_t InnerList::check_fine(const ListScene& scene) {
  const ActiveSet::Check found =
      fine_active_.check(scene.particles, scene.time_of(life_.steps()), scene.time_of(1));
  if (found.is_skin_used_up) life_.note_skin_used_up();
  return found.not_a_number;
}

ContactCarrier InnerList::release(std::size_t particles) {
  ContactCarrier carrier(particles, stride_);
  for (OfTile& t : tiles_) {
    carrier.take(std::move(t.contacts.pairs));
    carrier.take(std::move(t.contacts.walls));
  }
  carrier.take(std::move(fine_));
  carrier.arrange();
  set_tiles(0);
  fine_ = ContactList(PartnerKind::both, stride_);
  return carrier;
}

void InnerList::adopt(const OuterList& outer, const ContactCarrier& contacts) {
  set_tiles(outer.tiles());
  oneapi::tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
    contacts.adopt(outer.pairs(t), tiles_[t].contacts.pairs);
    contacts.adopt(outer.walls(t), tiles_[t].contacts.walls);
  });
  contacts.adopt(outer.fine(), fine_);
}

void InnerList::receive(ContactList pairs, ContactList walls, ContactList fine) {
  set_tiles(1);
  tiles_[0].contacts.pairs = std::move(pairs);
  tiles_[0].contacts.walls = std::move(walls);
  fine_ = std::move(fine);
}

void InnerList::renumber(std::span<const std::int32_t> new_row) {
  for (OfTile& t : tiles_) {
    t.contacts.pairs.renumber(new_row);
    t.contacts.walls.renumber(new_row);
  }
  fine_.renumber(new_row);
}

void InnerList::add_entries_to(base::Digest& digest) const {
  for (const OfTile& t : tiles_) {
    t.contacts.pairs.add_entries_to(digest);
    t.contacts.walls.add_entries_to(digest);
    digest.add(t.active.all());
  }
  fine_.add_entries_to(digest);
  digest.add(fine_active_.all());
}

void InnerList::add_histories_to(base::Digest& digest) const {
  for (const OfTile& t : tiles_) {
    t.contacts.pairs.add_histories_to(digest);
    t.contacts.walls.add_histories_to(digest);
  }
  fine_.add_histories_to(digest);
}

void InnerList::save(sdk::ArchiveWriter& archive) const {
  FlatLists pairs;
  FlatLists walls;
  FlatLists fines;
  for (const OfTile& t : tiles_) {
    pairs.add(t.contacts.pairs);
    walls.add(t.contacts.walls);
  }
  fines.add(fine_);
  pairs.save(archive, "pairs");
  walls.save(archive, "surfaces");
  fines.save(archive, "fine");
}

void InnerList::load(sdk::ArchiveReader& archive, std::size_t tiles) {
  FlatLists pairs(archive, "pairs");
  FlatLists walls(archive, "surfaces");
  FlatLists fines(archive, "fine");
  // What has come from another run stands in one list until the rows are put in order.
  set_tiles(std::max(tiles, pairs.count()));
  for (OfTile& t : tiles_) {
    pairs.take(t.contacts.pairs, stride_);
    walls.take(t.contacts.walls, stride_);
  }
  fines.take(fine_, stride_);
}

}  // namespace dust::particles
