// SPDX-License-Identifier: Apache-2.0
#include "unit/particles/list_cloud.hpp"

#include "contact/approach.hpp"
#include "particles/neighbours/inner_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

using namespace dust::particles;
using dust::test::ListCloud;

TEST_CASE("an inner list shall be over with its lifetime, or when a particle uses up its skin") {
  InnerListLife life;
  CHECK((life.is_over() && !life.is_running()));
  life.begin(32);
  for (int n = 0; n < 32; ++n) {
    CHECK_FALSE(life.is_over());
    CHECK(life.is_check_due() == (n % 4 == 3));
    life.count_step();
  }
  CHECK((life.is_over() && !life.is_skin_used_up()));
  life.begin(32);
  life.count_step();
  CHECK_FALSE(life.is_over());
  life.note_skin_used_up();
  CHECK(life.is_over());
  CHECK(life.is_running());  // until its end is noticed
  life.end();
  CHECK_FALSE(life.is_running());
  CHECK(InnerListLife::check_interval(8) == 4);
  CHECK(InnerListLife::check_interval(64) == 8);
  CHECK(InnerListLife::check_interval(256) == 16);
}

TEST_CASE("an active particle shall use up its skin at 0.7 of it, now or at the next look") {
  ListCloud cloud(2, 0, 0.0);
  ParticleStore& particles = cloud.particles;
  particles.velocity(1)[2] = 0.5;
  ActiveSet active;
  active.add(particles, 1, 1e-4);
  active.end_unshared();
  active.add(particles, 0, 1e-4);
  CHECK(active.unshared_count() == 1);
  CHECK(active.unshared()[0] == 1);
  constexpr double k_time = 1e-3;
  cloud.drift(k_time);
  CHECK_FALSE(active.check(particles, k_time, 1e-3).is_skin_used_up);
  particles.position(0)[0] += 0.65e-4;
  CHECK_FALSE(active.check(particles, k_time, 1e-3).is_skin_used_up);
  particles.velocity(0)[0] = 0.02;  // 0.2 of the skin until the next look
  CHECK(active.check(particles, k_time, 1e-3).is_skin_used_up);
  particles.velocity(0)[0] = 0.0;
  particles.position(0)[0] += 0.1e-4;
  CHECK(active.check(particles, k_time, 1e-3).is_skin_used_up);
  CHECK(active.check(particles, k_time, 0.0).not_a_number == -1);
  particles.position(0)[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(active.check(particles, k_time, 0.0).not_a_number == 0);
}

TEST_CASE("a pruned list shall hold what touches, with its history, and what may come to touch") {
  constexpr std::size_t k_stride = 4;
  constexpr std::int32_t k_entries = 60;  // of two laws
  PairList outer(PartnerKind::particles);
  std::vector<std::int32_t> law;
  for (std::int32_t n = 0; n < k_entries; ++n) {
    outer.push(n, n + 100);
    law.push_back(n % 2);
  }
  outer.group_by_law(law, 2);
  REQUIRE(outer.ranges().size() == 2);
  // In touch: every third. They come as after a rebuild: in the order of the outer list.
  ContactList list(PartnerKind::particles, k_stride);
  for (std::size_t q = 0; q < outer.size(); ++q) {
    const double mark = outer.a()[q] + 1.0;
    const double history[k_stride] = {mark, 2 * mark, 3 * mark, 4 * mark};
    if (outer.a()[q] % 3 == 0) list.push(outer.a()[q], outer.b()[q], history, 1);
  }
  // What is in touch has a mark, but where a law reaches farther than its range.
  std::int32_t marks_every = 0;
  SUBCASE("contacts in touch have a mark") { marks_every = 1; }
  SUBCASE("one in seven has none") { marks_every = 7; }
  SUBCASE("none has a mark") {}
  std::vector<std::uint8_t> approach(outer.size());
  for (std::size_t q = 0; q < outer.size(); ++q) {
    const std::int32_t a = outer.a()[q];
    const bool has_mark = marks_every == 1 || (marks_every > 1 && a % marks_every != 0);
    approach[q] = a % 3 == 1 || (a % 3 == 0 && has_mark) ? dust::contact::k_may_meet : 0;
    if (outer.a()[q] == 7) approach[q] |= dust::contact::k_overlaps;
  }
  // Once as after a rebuild, then from a pruned list.
  for (int round = 0; round < 3; ++round) {
    CAPTURE(round);
    const auto unseen = list.prune(outer, approach);
    if (round == 0) {
      REQUIRE(unseen.size() == 1);
      CHECK(outer.a()[static_cast<std::size_t>(unseen[0])] == 7);
    }
    REQUIRE(list.size() == 40);
    REQUIRE(list.ranges().size() == 2);
    for (const LawRange& r : list.ranges()) {
      CHECK((r.persistent_end - r.begin) == 8);  // of ten
      for (std::int32_t e = r.begin; e < r.end; ++e) {
        const auto q = static_cast<std::size_t>(e);
        const std::int32_t a = list.a()[q];
        CHECK(list.b()[q] == a + 100);
        CHECK(a % 2 == r.law);
        CHECK(a % 3 != 2);
        CHECK((list.touching()[q] != 0) == (a % 3 == 0));
        if (e < r.persistent_end) CHECK(a % 3 == 0);
        const bool is_first = e == r.begin || e == r.persistent_end;
        if (!is_first) CHECK(list.a()[q - 1] < a);
        for (std::size_t h = 0; h < k_stride; ++h) {
          CHECK(list.history(q)[h] == (a % 3 == 0 ? static_cast<double>(h + 1) * (a + 1.0) : 0.0));
        }
      }
    }
    list.histories_to_columns();
    list.histories_to_columns();  // nothing more
    const auto q = static_cast<std::size_t>(list.ranges()[0].begin);
    CHECK(list.history(q)[1] != 2.0 * (list.a()[q] + 1.0));
    list.histories_to_rows();
  }
}

TEST_CASE("contacts of particles that are gone shall end, the others be renumbered") {
  const double history[4] = {1, 2, 3, 4};
  ContactList list(PartnerKind::both, 4);
  list.push(0, 2, history, 1);
  list.push(1, 2, history, 1);
  list.push(2, -1 - 5, history, 3);  // the surface 5
  const std::vector<std::int32_t> new_row{0, -1, 1};
  list.renumber(new_row);
  CHECK((list.a()[0] == 0 && list.b()[0] == 1 && list.touching()[0] == 1));
  CHECK(list.touching()[1] == 0);
  CHECK((list.a()[2] == 1 && list.b()[2] == -6 && list.touching()[2] == 3));
}

namespace {

/// A cloud with both of its lists.
struct Lists {
  ListCloud cloud;
  ListTuner tuner;
  OuterList outer;
  InnerList inner;
  GhostExchange ghosts;

  Lists(std::size_t coarse, std::size_t fine, double speed)
      : cloud(coarse, fine, speed, 128), inner(cloud.scene().laws.history_stride()) {
    outer.resize(cloud.particles.size());
    outer.build(cloud.scene(), tuner);
    ContactCarrier none(cloud.particles.size(), cloud.scene().laws.history_stride());
    none.arrange();
    inner.adopt(outer, none);
  }
  std::int64_t prune(std::int64_t lifetime) {
    return inner.prune(
        {.scene = cloud.scene(), .outer = outer, .lifetime = lifetime, .impulses = {}}, ghosts);
  }
};

}  // namespace

TEST_CASE("an inner list shall hold every pair that touches within its life, and few others") {
  Lists lists(700, 200, 0.5);
  constexpr std::int64_t k_lifetime = 8;
  lists.prune(k_lifetime);
  std::set<std::pair<std::int32_t, std::int32_t>> listed;
  std::size_t outer_size = lists.outer.fine().size();
  const auto add = [&](const ContactList& list) {
    for (std::size_t q = 0; q < list.size(); ++q) {
      listed.insert(std::minmax(list.a()[q], list.b()[q]));
    }
  };
  for (std::size_t t = 0; t < lists.inner.tiles(); ++t) {
    add(lists.inner.contacts(t).pairs);
    outer_size += lists.outer.pairs(t).size();
  }
  add(lists.inner.fine());
  const auto count = static_cast<std::int32_t>(lists.cloud.particles.size());
  std::size_t touching = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    for (std::int32_t j = i + 1; j < count; ++j) {
      if (!lists.cloud.will_touch(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                                  k_lifetime * ListCloud::k_step)) {
        continue;
      }
      ++touching;
      CHECK(listed.contains({i, j}));
    }
  }
  CHECK(touching > 100);
  CHECK(listed.size() < outer_size / 2);
}

TEST_CASE("particles with partners shall be active, and what other tiles look at stand behind") {
  Lists lists(700, 200, 0.5);
  lists.prune(8);
  std::set<std::int32_t> partners;
  std::set<std::int32_t> shared;
  const Tiling& tiling = lists.cloud.scene().tiling;
  const auto add = [&](const ContactList& list) {
    for (std::size_t q = 0; q < list.size(); ++q) {
      const std::int32_t a = list.a()[q];
      const std::int32_t b = list.b()[q];
      partners.insert({a, b});
      const bool is_coarse = tiling.is_coarse(a) && tiling.is_coarse(b);
      if (is_coarse && tiling.tile_of(a) != tiling.tile_of(b)) shared.insert(std::max(a, b));
    }
  };
  for (std::size_t t = 0; t < lists.inner.tiles(); ++t) add(lists.inner.contacts(t).pairs);
  add(lists.inner.fine());
  REQUIRE(shared.size() > 20);
  std::set<std::int32_t> active;
  for (std::size_t t = 0; t < lists.inner.tiles(); ++t) {
    const ActiveSet& set = lists.inner.active(t);
    for (std::size_t k = 0; k < set.size(); ++k) {
      const std::int32_t row = set.all()[k];
      CHECK(tiling.tile_of(row) == t);
      CHECK(shared.contains(row) == (k >= set.unshared_count()));
      CHECK(lists.inner.is_shared(row) == shared.contains(row));
      active.insert(row);
    }
  }
  for (const std::int32_t row : lists.inner.fine_active().all()) active.insert(row);
  for (const std::int32_t row : partners) CHECK(active.contains(row));
  const auto ballistic = static_cast<std::int64_t>(lists.cloud.particles.size() - active.size());
  CHECK(lists.inner.ballistic_count() == ballistic);
  CHECK(ballistic > 20);
}

TEST_CASE("contacts released shall be adopted by the next lists, wherever their particles stand") {
  Lists lists(900, 0, 0.1);
  lists.prune(8);
  ParticleStore& particles = lists.cloud.particles;
  // A history by which each pair is known again, by ids.
  std::map<std::pair<std::int64_t, std::int64_t>, double> marks;
  const auto ids = [&](std::int32_t a, std::int32_t b) {
    return std::pair(particles.id(static_cast<std::size_t>(a)),
                     particles.id(static_cast<std::size_t>(b)));
  };
  const std::size_t stride = lists.cloud.scene().laws.history_stride();
  for (std::size_t t = 0; t < lists.inner.tiles(); ++t) {
    const auto view = lists.inner.contacts(t).pairs.view();
    for (std::size_t q = 0; q < view.count; q += 3) {
      view.is_touching[q] = 1;
      view.history[q * stride] = marks[ids(view.a[q], view.b[q])] =
          static_cast<double>(1000 * t + q + 1);
    }
  }
  REQUIRE(marks.size() > 30);
  ContactCarrier carrier = lists.inner.release(particles.size());
  CHECK(lists.inner.tiles() == 0);
  std::vector<std::int32_t> order(particles.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    order[n] = static_cast<std::int32_t>((7 * n + 3) % order.size());  // a permutation of 900
  }
  particles.reorder(order);
  lists.outer.reorder(order);
  carrier.renumber(order);
  lists.outer.build(lists.cloud.scene(), lists.tuner);
  lists.inner.adopt(lists.outer, carrier);
  std::size_t found = 0;
  for (std::size_t t = 0; t < lists.inner.tiles(); ++t) {
    const ContactList& pairs = lists.inner.contacts(t).pairs;
    for (std::size_t q = 0; q < pairs.size(); ++q) {
      CHECK(pairs.history(q)[0] == marks.at(ids(pairs.a()[q], pairs.b()[q])));
      ++found;
    }
  }
  CHECK(found == marks.size());
}
