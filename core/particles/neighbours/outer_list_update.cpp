// SPDX-License-Identifier: Apache-2.0
#include "contact/closest_approach.hpp"
#include "particles/neighbours/displaced_grid.hpp"
#include "particles/neighbours/outer_list.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

/// Outer lists updated where single particles have left their skins, in place of lists built anew
/// for all (docs/decisions/0018_lists_are_updated.md).
namespace dust::particles {
namespace {

/// With more displaced particles at once than one in so many, or since the list was built, it is
/// built anew: an updated list keeps what is no longer wanted.
constexpr std::size_t k_particles_per_displaced = 16;
constexpr std::int64_t k_particles_per_updated = 4;

template <class Work>
void for_each_row(const ListScene& scene, Work&& work) {
  oneapi::tbb::parallel_for(std::size_t{0}, scene.blocks(), [&](std::size_t b) {
    const std::size_t end = std::min(scene.particles.size(), (b + 1) * k_block);
    for (std::size_t n = b * k_block; n < end; ++n) work(b, n);
  });
}

}  // namespace

bool OuterList::update(const ListScene& scene, const ListTuner& tuner) {
  const std::size_t count = scene.particles.size();
  std::size_t listed = fine_.size();
  for (const OfTile& t : tiles_) listed += t.pairs.size();
  if (tuner.may_widen_skins(static_cast<std::int64_t>(listed), static_cast<std::int64_t>(count))) {
    return false;
  }
  const std::vector<std::int32_t> rows = find_displaced(scene, tuner.inner_lifetime());
  updated_ += static_cast<std::int64_t>(rows.size());
  if (k_particles_per_displaced * rows.size() > count ||
      k_particles_per_updated * updated_ > static_cast<std::int64_t>(count)) {
    return false;
  }
  std::vector<std::uint8_t> is_displaced(count, 0);
  for (const std::int32_t row : rows) {
    const auto n = static_cast<std::size_t>(row);
    trajectories_.restart(n, scene.position(n), scene.particles.velocity(n), scene.time_of(age_));
    is_displaced[n] = 1;
  }
  add_pairs(scene, {rows, is_displaced});
  add_walls(scene, rows);
  due_ = Due::nothing;
  return true;
}

std::vector<std::int32_t> OuterList::find_displaced(const ListScene& scene,
                                                    std::int64_t ahead) const {
  std::vector<std::vector<std::int32_t>> found(scene.blocks());
  for_each_row(scene, [&](std::size_t b, std::size_t n) {
    if (deviation(scene, n, ahead).asks_for_another(trajectories_.skin(n))) {
      found[b].push_back(static_cast<std::int32_t>(n));
    }
  });
  std::vector<std::int32_t> rows;
  for (const auto& block : found) rows.insert(rows.end(), block.begin(), block.end());
  return rows;
}

/// All places where a particle may be until the list's end.
Ball OuterList::swept_ball(const ListScene& scene, std::size_t n) const {
  const sdk::Vec3 x = trajectories_.position(n, scene.time_of(age_));
  const sdk::Vec3 v = trajectories_.velocity(n);
  const double way = 0.5 * remaining(scene);
  return {x.x + way * v.x, x.y + way * v.y, x.z + way * v.z,
          scene.radius(n) + trajectories_.skin(n) + 0.5 * scene.laws.largest_range() +
              way * std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)};
}

void OuterList::find_farthest_reach(const ListScene& scene) {
  if (farthest_reach_ != 0.0) return;
  std::vector<double> farthest(scene.blocks(), 0.0);
  for_each_row(scene, [&](std::size_t b, std::size_t n) {
    farthest[b] = std::max(farthest[b], swept_ball(scene, n).reach);
  });
  farthest_reach_ = *std::max_element(farthest.begin(), farthest.end());
}

/// Whether two particles on their trajectories come near each other until the list's end.
bool OuterList::come_near(const ListScene& scene, std::size_t i, std::size_t j) const {
  const double t = scene.time_of(age_);
  const double limit = scene.radius(i) + scene.radius(j) + trajectories_.skin(i) +
                       trajectories_.skin(j) + scene.laws.largest_range();
  const sdk::Vec3 xi = trajectories_.position(i, t);
  const sdk::Vec3 xj = trajectories_.position(j, t);
  const sdk::Vec3 x = contact::nearest_image(scene.images, &xj.x, &xi.x);
  const sdk::Vec3 v = trajectories_.velocity(i) - trajectories_.velocity(j);
  const double* period = scene.images.length;
  return contact::approach_is_within(x, v, remaining(scene), limit) ||
         contact::other_image_approaches(x, v, period, remaining(scene), limit);
}

/// The pairs that the new trajectories bring near, by the list they belong to: of each tile, of the
/// fine level.
OuterList::Shares OuterList::pairs_of(const ListScene& scene, const Displaced& displaced) {
  find_farthest_reach(scene);
  std::vector<Ball> balls;
  for (const std::int32_t n : displaced.rows) {
    balls.push_back(swept_ball(scene, static_cast<std::size_t>(n)));
  }
  for (const Ball& b : balls) farthest_reach_ = std::max(farthest_reach_, b.reach);
  // A little more, for a place on the border of two cells of a periodic side.
  const DisplacedGrid near(balls, 1.0000001 * farthest_reach_, scene.images);
  std::vector<std::vector<RowPair>> found(scene.blocks());
  for_each_row(scene, [&](std::size_t b, std::size_t n) {
    const auto row = static_cast<std::int32_t>(n);
    for (const std::int32_t number : near.at(swept_ball(scene, n))) {
      const std::int32_t other = displaced.rows[static_cast<std::size_t>(number)];
      // Of two displaced particles the later one finds the pair.
      if (other == row || (displaced.has(row) && row < other)) continue;
      if (come_near(scene, static_cast<std::size_t>(other), n)) {
        found[b].push_back(scene.in_order(other, row));
      }
    }
  });
  Shares shares(tiles_.size() + 1);
  for (const auto& block : found) {
    for (const auto& [a, b] : block) {
      const std::size_t owner = scene.tiling.is_coarse(std::max(a, b))
                                    ? scene.tiling.tile_of(std::min(a, b))
                                    : tiles_.size();
      shares[owner].push_back({a, b});
    }
  }
  return shares;
}

void OuterList::add_pairs(const ListScene& scene, const Displaced& displaced) {
  Shares shares = pairs_of(scene, displaced);
  oneapi::tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t t) {
    if (shares[t].empty()) return;
    if (t < tiles_.size()) {
      add_new(tiles_[t].pairs, shares[t], displaced);
      group_by_law(scene, tiles_[t].pairs);
    } else {
      add_new(fine_, shares[t], displaced);
      fine_.group_as_one();
    }
  });
}

/// Puts pairs that are not listed yet behind what is.
void OuterList::add_new(PairList& list, std::vector<RowPair>& pairs, const Displaced& displaced) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::uint8_t> is_listed(pairs.size(), 0);
  for (std::size_t q = 0; q < list.size(); ++q) {
    const RowPair pair{list.a()[q], list.b()[q]};
    if (pair[1] < 0) continue;  // a fine particle and a surface
    if (!displaced.has(pair[0]) && !displaced.has(pair[1])) continue;
    const auto at = std::lower_bound(pairs.begin(), pairs.end(), pair);
    if (at != pairs.end() && *at == pair) {
      is_listed[static_cast<std::size_t>(at - pairs.begin())] = 1;
    }
  }
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (is_listed[n] == 0) list.push(pairs[n][0], pairs[n][1]);
  }
}

void OuterList::add_walls(const ListScene& scene, std::span<const std::int32_t> displaced) {
  std::vector<std::uint8_t> has_more(tiles_.size(), 0);
  SurfaceSearch search;
  for (const std::int32_t row : displaced) {
    const bool is_coarse = scene.tiling.is_coarse(row);
    const std::size_t owner = is_coarse ? scene.tiling.tile_of(row) : 0;
    PairList& list = is_coarse ? tiles_[owner].walls : fine_;
    for (const std::int32_t number :
         surfaces_near(scene, static_cast<std::size_t>(row), remaining(scene), search)) {
      const std::int32_t b = is_coarse ? number : -1 - number;
      if (list.has(row, b)) continue;
      list.push(row, b);
      if (is_coarse) has_more[owner] = 1;
    }
  }
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (has_more[t] != 0) group_by_law(scene, tiles_[t].walls);
  }
  fine_.group_as_one();
}

}  // namespace dust::particles
