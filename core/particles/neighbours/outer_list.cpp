// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/outer_list.hpp"

#include "particles/neighbours/list_archive.hpp"
#include "particles/neighbours/skins.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

/// Outer lists built anew.
namespace dust::particles {

void OuterList::build(const ListScene& scene, ListTuner& tuner) {
  ListTuner::OuterStatistics statistics{
      .is_early = !is_reorder_due() && age_ < lifetime_,
      .is_half_used = 2 * age_ < lifetime_,
      .particles = static_cast<std::int64_t>(scene.particles.size())};
  tiles_.clear();  // lists are most of the memory: the old ones go first
  fine_.clear();
  restart_trajectories(scene, tuner.skin_in_diameters());
  // No particle flies farther than a diameter, for the search looks as far as the fastest one
  // flies.
  lifetime_ = tuner.begin_outer(scene.largest_diameter / scene.step /
                                std::max(scene.fastest_speed(), 1e-15));
  auto shares = share_pairs(scene, statistics);
  tuner.record(statistics);
  tiles_.assign(shares.size(), {});
  oneapi::tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
    // A share is given back with its tile.
    build_tile(scene, t, std::exchange(shares[t], {}));
  });
  build_fine(scene);
  age_ = 0;
  updated_ = 0;
  farthest_reach_ = 0.0;
  due_ = Due::nothing;
}

void OuterList::restart_trajectories(const ListScene& scene, double skin_in_diameters) {
  choose_skins({.position = scene.particles.contact_rows().position,
                .count = scene.particles.size(),
                .coarse_count = scene.tiling.coarse_count,
                .skin_in_diameters = skin_in_diameters,
                .largest_diameter = scene.largest_diameter,
                .origin = scene.origin},
               trajectories_);
  for (std::size_t n = 0; n < scene.particles.size(); ++n) {
    trajectories_.restart(n, scene.position(n), scene.particles.velocity(n));
  }
}

/// The pairs that may meet within the lifetime: of coarse particles by the tile of the earlier row;
/// those with a fine one go to the fine list.
OuterList::Shares OuterList::share_pairs(const ListScene& scene,
                                         ListTuner::OuterStatistics& statistics) {
  SearchInput in;
  in.count = scene.particles.size();
  in.position = scene.particles.contact_rows().position;
  in.velocity = scene.particles.contact_rows().motion;
  in.velocity_stride = ParticleStore::k_motion_stride;
  in.skin = trajectories_.rows();
  in.lifetime = scene.time_of(lifetime_);
  in.range = scene.laws.largest_range();
  for (int d = 0; d < 3; ++d) {
    in.origin[d] = scene.origin[d];
    in.period[d] = scene.images.length[d];
  }
  Shares shares(scene.tiling.count());
  for (const auto& block : search_pairs(in, k_block)) {
    for (const auto& [i, j] : block) {
      ++statistics.pairs;
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(j);
      const sdk::Vec3 d =
          contact::nearest_image(scene.images, scene.position(b), scene.position(a));
      const double reach =
          scene.radius(a) + scene.radius(b) + trajectories_.skin(a) + trajectories_.skin(b);
      statistics.close_pairs += dot(d, d) < reach * reach ? 1 : 0;
      const RowPair pair = scene.in_order(i, j);
      if (scene.tiling.is_coarse(i) && scene.tiling.is_coarse(j)) {
        shares[scene.tiling.tile_of(std::min(i, j))].push_back(pair);
      } else {
        fine_.push(pair[0], pair[1]);
      }
    }
  }
  return shares;
}

void OuterList::build_tile(const ListScene& scene, std::size_t number, std::vector<RowPair> pairs) {
  OfTile& tile = tiles_[number];
  const Tile range = scene.tiling.tile(number);
  tile.pairs.assign_by_row(pairs, range);
  std::vector<RowPair>().swap(pairs);
  const double duration = scene.time_of(lifetime_);
  SurfaceSearch search;
  std::vector<RowPair> walls;  // the surface first: by surface, then by row
  for (std::int32_t i = range.begin; i < range.end; ++i) {
    for (const std::int32_t s : surfaces_near(scene, static_cast<std::size_t>(i), duration, search))
      walls.push_back({s, i});
  }
  std::sort(walls.begin(), walls.end());
  for (const auto& [s, i] : walls) tile.walls.push(i, s);
  group_by_law(scene, tile.pairs);
  group_by_law(scene, tile.walls);
}

void OuterList::build_fine(const ListScene& scene) {
  const double duration = scene.time_of(lifetime_);
  SurfaceSearch search;
  for (std::size_t n = scene.tiling.coarse_count; n < scene.particles.size(); ++n) {
    for (const std::int32_t s : surfaces_near(scene, n, duration, search)) {
      fine_.push(static_cast<std::int32_t>(n), -1 - s);
    }
  }
  fine_.group_as_one();
}

std::span<const std::int32_t> OuterList::surfaces_near(const ListScene& scene, std::size_t row,
                                                       double duration,
                                                       SurfaceSearch& search) const {
  const double reach = scene.radius(row) + trajectories_.skin(row) + scene.laws.largest_range();
  return scene.find_surfaces(row, reach, duration, search);
}

void OuterList::group_by_law(const ListScene& scene, PairList& list) {
  const auto material = [&](std::size_t row) { return scene.particles.material(row); };
  std::vector<std::int32_t> law(list.size());
  for (std::size_t q = 0; q < list.size(); ++q) {
    const auto b = static_cast<std::size_t>(list.b()[q]);
    law[q] = scene.laws.index(
        material(static_cast<std::size_t>(list.a()[q])),
        list.partners() == PartnerKind::surfaces ? scene.surfaces[b].material : material(b));
  }
  list.group_by_law(law, static_cast<std::int32_t>(scene.laws.size()));
}

void OuterList::add_to(base::Digest& digest) const {
  for (const OfTile& t : tiles_) {
    t.pairs.add_to(digest);
    t.walls.add_to(digest);
  }
  fine_.add_to(digest);
}

void OuterList::save(sdk::ArchiveWriter& archive) const {
  trajectories_.save(archive);
  FlatLists pairs;
  FlatLists walls;
  FlatLists fines;
  for (const OfTile& t : tiles_) {
    pairs.add(t.pairs);
    walls.add(t.walls);
  }
  fines.add(fine_);
  pairs.save(archive, "near_pairs");
  walls.save(archive, "near_surfaces");
  fines.save(archive, "near_fine");
}

void OuterList::load(sdk::ArchiveReader& archive, std::size_t tiles, State state) {
  trajectories_.load(archive);
  FlatLists pairs(archive, "near_pairs");
  FlatLists walls(archive, "near_surfaces");
  FlatLists fines(archive, "near_fine");
  tiles_.assign(tiles, {});
  for (OfTile& t : tiles_) {
    pairs.take(t.pairs);
    walls.take(t.walls);
  }
  fines.take(fine_);
  lifetime_ = state.lifetime;
  age_ = state.age;
  updated_ = state.updated;
  due_ = state.due;
  farthest_reach_ = 0.0;
}

}  // namespace dust::particles
