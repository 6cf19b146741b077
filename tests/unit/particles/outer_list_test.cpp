// SPDX-License-Identifier: Apache-2.0
#include "unit/particles/list_cloud.hpp"

#include "particles/neighbours/displaced_grid.hpp"
#include "particles/neighbours/outer_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace dust::particles;
using dust::test::ListCloud;

namespace {

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

Pairs pairs_of(const OuterList& outer) {
  Pairs all;
  const auto add = [&](const PairList& list) {
    for (std::size_t q = 0; q < list.size(); ++q) all.insert(std::minmax(list.a()[q], list.b()[q]));
  };
  for (std::size_t t = 0; t < outer.tiles(); ++t) add(outer.pairs(t));
  add(outer.fine());
  return all;
}

/// Pairs that touch within `duration`, of which one at least is among `rows`, and that are missing.
std::size_t missing(const ListCloud& cloud, const Pairs& listed, double duration,
                    const std::set<std::int32_t>& rows) {
  std::size_t count = 0;
  const auto size = static_cast<std::int32_t>(cloud.particles.size());
  for (std::int32_t i = 0; i < size; ++i) {
    for (std::int32_t j = i + 1; j < size; ++j) {
      if (!rows.empty() && !rows.contains(i) && !rows.contains(j)) continue;
      const bool touch =
          cloud.will_touch(static_cast<std::size_t>(i), static_cast<std::size_t>(j), duration);
      if (touch && !listed.contains({i, j})) ++count;
    }
  }
  return count;
}

/// With the widest skins, so that no update is refused for lists too short.
ListTuner tuner_of(std::int64_t lifetime) {
  ListTuner tuner;
  tuner.restore({lifetime, lifetime, 7, 64});
  return tuner;
}

}  // namespace

TEST_CASE("an outer list shall hold every pair that touches within its lifetime") {
  ListCloud cloud(900, 300, 0.5, 256);
  OuterList outer;
  CHECK(outer.is_rebuild_due());
  outer.resize(cloud.particles.size());
  ListTuner tuner;
  outer.build(cloud.scene(), tuner);
  REQUIRE(outer.tiles() == 4);
  CHECK_FALSE(outer.is_rebuild_due());
  const double lifetime = ListCloud::k_step * static_cast<double>(tuner.outer_lifetime());
  const Pairs listed = pairs_of(outer);
  CHECK(missing(cloud, listed, lifetime, {}) == 0);
  CHECK(listed.size() < 1200 * 1199 / 20);  // and not simply all
  for (std::size_t t = 0; t < outer.tiles(); ++t) {
    const Tile tile = cloud.scene().tiling.tile(t);
    const PairList& list = outer.pairs(t);
    for (std::size_t q = 0; q < list.size(); ++q) {
      const std::int32_t earlier = std::min(list.a()[q], list.b()[q]);
      CHECK((earlier >= tile.begin && earlier < tile.end));
    }
  }
  for (std::int64_t n = 0; n < tuner.outer_lifetime(); ++n) {
    CHECK_FALSE(outer.is_rebuild_due());
    outer.count_step();
  }
  CHECK(outer.is_rebuild_due());
}

TEST_CASE("an update shall list what particles meet on their new trajectories, until the end") {
  ListCloud cloud(900, 300, 0.5, 256);
  OuterList outer;
  outer.resize(cloud.particles.size());
  ListTuner tuner = tuner_of(64);
  outer.build(cloud.scene(), tuner);
  REQUIRE(tuner.outer_lifetime() >= 16);
  for (int n = 0; n < 8; ++n) outer.count_step();
  cloud.drift(8 * ListCloud::k_step);
  // Some are elsewhere all at once, far beyond their skins, and fly on faster than any before.
  std::set<std::int32_t> thrown;
  for (std::int32_t n = 5; n < 1200; n += 97) {
    thrown.insert(n);
    const auto row = static_cast<std::size_t>(n);
    for (std::size_t d = 0; d < 3; ++d) {
      double& x = cloud.particles.position(row)[d];
      x += x < 0.5 * ListCloud::k_box ? 4e-3 : -4e-3;
      cloud.particles.velocity(row)[d] *= -3.0;
    }
  }
  const double left = ListCloud::k_step * static_cast<double>(tuner.outer_lifetime() - 8);
  CHECK(missing(cloud, pairs_of(outer), left, thrown) > 0);
  outer.require(OuterList::Due::update);
  REQUIRE(outer.is_update_due());
  REQUIRE(outer.update(cloud.scene(), tuner));
  CHECK_FALSE(outer.is_update_due());
  CHECK(missing(cloud, pairs_of(outer), left, thrown) == 0);
  CHECK(missing(cloud, pairs_of(outer), left, {}) == 0);
  for (std::size_t n = 0; n < cloud.particles.size(); ++n) {
    CHECK_FALSE(
        outer.deviation(cloud.scene(), n, 8).asks_for_another(outer.trajectories().skin(n)));
  }
}

TEST_CASE("an update shall be refused where a list built anew is cheaper") {
  ListCloud cloud(600, 0, 0.1);
  OuterList outer;
  outer.resize(cloud.particles.size());
  ListTuner tuner = tuner_of(64);
  outer.build(cloud.scene(), tuner);
  for (std::size_t n = 0; n < 40; ++n) cloud.particles.position(n)[0] += 3e-3;
  CHECK_FALSE(outer.update(cloud.scene(), tuner));
}

TEST_CASE("what is due of an outer list shall be the most that was asked for") {
  ListCloud cloud(10, 0, 0.0);
  OuterList outer;
  outer.resize(10);
  ListTuner tuner;
  outer.build(cloud.scene(), tuner);
  outer.require(OuterList::Due::update);
  CHECK((outer.is_update_due() && !outer.is_rebuild_due()));
  outer.require(OuterList::Due::reorder);
  outer.require(OuterList::Due::rebuild);
  CHECK((!outer.is_update_due() && outer.is_rebuild_due() && outer.is_reorder_due()));
  outer.build(cloud.scene(), tuner);
  CHECK((!outer.is_update_due() && !outer.is_rebuild_due() && !outer.is_reorder_due()));
}

TEST_CASE("a saved outer list shall be loaded as it was") {
  ListCloud cloud(300, 100, 0.5, 64);
  OuterList outer;
  outer.resize(cloud.particles.size());
  ListTuner tuner;
  outer.build(cloud.scene(), tuner);
  outer.count_step();
  outer.require(OuterList::Due::update);
  dust::test::MemoryArchive archive;
  outer.save(archive);
  OuterList loaded;
  loaded.load(archive, outer.tiles(), outer.state());
  const auto digest = [](const OuterList& list) {
    dust::base::Digest d;
    list.add_to(d);
    return d.value();
  };
  CHECK(digest(loaded) == digest(outer));
  CHECK(loaded.is_update_due());
  CHECK(loaded.trajectories().skin(7) == outer.trajectories().skin(7));
  CHECK(loaded.state().age == 1);
}

TEST_CASE("a grid of displaced particles shall name all that may reach a place") {
  const dust::sdk::Random random(4, 2);
  for (const bool is_periodic : {false, true}) {
    dust::contact::Images images;
    for (int d = 0; d < 3; ++d) {
      images.length[d] = is_periodic ? 1.0 : 0.0;
      images.half[d] = is_periodic ? 0.5 : std::numeric_limits<double>::infinity();
    }
    std::vector<Ball> displaced;
    for (std::uint64_t n = 0; n < 40; ++n) {
      displaced.push_back({random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2),
                           0.02 + 0.03 * random.uniform(n, 3)});
    }
    constexpr double k_around = 0.05;
    const DisplacedGrid grid(displaced, 1.0000001 * k_around, images);
    std::size_t named = 0;
    std::size_t near = 0;
    for (std::uint64_t n = 0; n < 2000; ++n) {
      const Ball place{random.uniform(n, 10), random.uniform(n, 11), random.uniform(n, 12),
                       k_around * random.uniform(n, 13)};
      const auto found = grid.at(place);
      CHECK(std::is_sorted(found.begin(), found.end()));
      named += found.size();
      for (std::size_t s = 0; s < displaced.size(); ++s) {
        const Ball& ball = displaced[s];
        const auto d = dust::contact::nearest_image(images, &ball.x, &place.x);
        if (norm(d) > ball.reach + place.reach) continue;
        ++near;
        CHECK(std::find(found.begin(), found.end(), static_cast<std::int32_t>(s)) != found.end());
      }
    }
    CHECK(near > 50);
    CHECK(named < 2000 * 40 / 4);  // most are not named
  }
}
