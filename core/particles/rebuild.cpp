// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"
#include "particles/neighbours/contact_carrier.hpp"
#include "particles/neighbours/skins.hpp"
#include "particles/row_order.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

/// Outer lists made new.
namespace dust::particles {
namespace {

/// Rebuilds between two sorts of the rows where no particle came or went.
constexpr std::int64_t k_sort_every = 4;

/// The pairs of a chunk by their earlier row, those of one row as they were found: the contacts of
/// the same grains lie side by side.
void list_by_row(std::span<const RowPair> pairs, Chunk& chunk) {
  std::vector<std::int32_t> next(static_cast<std::size_t>(chunk.end - chunk.begin) + 1, 0);
  const auto place = [&](const RowPair& pair) {
    return static_cast<std::size_t>(std::min(pair[0], pair[1]) - chunk.begin);
  };
  for (const auto& pair : pairs) ++next[place(pair) + 1];
  for (std::size_t n = 1; n < next.size(); ++n) next[n] += next[n - 1];
  chunk.near_pairs.a.resize(pairs.size());
  chunk.near_pairs.b.resize(pairs.size());
  for (const auto& pair : pairs) {
    const auto to = static_cast<std::size_t>(next[place(pair)]++);
    chunk.near_pairs.a[to] = pair[0];
    chunk.near_pairs.b[to] = pair[1];
  }
}

}  // namespace

void Dem::Impl::neighbours() {
  const std::int64_t lifetime = tuner.outer_lifetime();
  if (!is_watching || must_watch || since_watch >= tuner.inner_lifetime() || must_rebuild ||
      since_rebuild >= lifetime) {
    land();
  }
  if (must_mend && !must_rebuild && since_rebuild < lifetime) must_rebuild = !mend();
  if (must_rebuild || since_rebuild >= lifetime) rebuild();
  if (!is_watching) begin_watch();
}

void Dem::Impl::rebuild() {
  ++counters.rebuilds;
  ListTuner::OuterStatistics statistics{
      .is_early = !must_sort && since_rebuild < tuner.outer_lifetime(),
      .is_half_used = 2 * since_rebuild < tuner.outer_lifetime(),
      .particles = static_cast<std::int64_t>(store.size())};
  gather_wall_loads();
  wrap_periodic();
  ContactCarrier contacts = take_contacts();
  reorder_if_due(contacts);
  look_at_weights();
  restart_trajectories();
  // No particle flies farther than a diameter, for the search looks as far as the fastest one
  // flies.
  tuner.begin_outer(steps.classes.back().diameter / steps.coarse_step / std::max(fastest(), 1e-15));
  auto shares = share_pairs(statistics);
  tuner.record(statistics);
  chunks.resize(shares.size());
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    // Lists are most of the memory: a share is given back with its tile.
    make_tile(c, std::exchange(shares[c], {}), contacts);
  });
  make_fine_list(contacts);
  contact_force.clear();  // in the order of rows that were
  since_rebuild = 0;
  mended = 0;
  farthest_reach = 0.0;
  must_mend = must_rebuild = must_sort = false;
}

/// The lists' contacts in touch, and what else of the old tiles outlives them.
ContactCarrier Dem::Impl::take_contacts() {
  ContactCarrier contacts(store.size(), history_stride);
  for (Chunk& c : chunks) {
    times_before.add(c.times);
    counters.largest_coarse_overlap = std::max(counters.largest_coarse_overlap, c.largest_overlap);
    contacts.take(std::move(c.pairs), false);
    contacts.take(std::move(c.surfaces), true);
  }
  contacts.take(std::move(fine), false);
  contacts.arrange();
  chunks.clear();
  near_fine.clear();
  return contacts;
}

void Dem::Impl::reorder_if_due(ContactCarrier& contacts) {
  if (!must_sort && counters.rebuilds % k_sort_every != 0) return;
  const RowOrder sorted = morton_order(store.position.data(), store.size(), domain_min,
                                       steps.classes.back().diameter, steps.coarse_limit);
  coarse_count = sorted.coarse_count;
  store.reorder(sorted.order);
  trajectories.reorder(sorted.order);
  contacts.renumber(sorted.order);
  if (fine_level.deferred().all().empty()) return;
  std::vector<std::int32_t> new_row(sorted.order.size());
  for (std::size_t n = 0; n < new_row.size(); ++n) {
    new_row[static_cast<std::size_t>(sorted.order[n])] = static_cast<std::int32_t>(n);
  }
  fine_level.renumber(new_row);
}

void Dem::Impl::restart_trajectories() {
  choose_skins({.position = store.position.data(),
                .count = store.size(),
                .coarse_count = coarse_count,
                .skin_in_diameters = tuner.skin_in_diameters(),
                .largest_diameter = steps.classes.back().diameter,
                .origin = domain_min},
               trajectories);
  for (std::size_t n = 0; n < store.size(); ++n) {
    trajectories.restart(n, store.position.data() + 4 * n, store.velocity(n));
  }
}

/// The pairs that may meet within the list's lifetime: of coarse particles by the tile of the
/// earlier row; those with a fine one go to the fine list.
std::vector<std::vector<RowPair>> Dem::Impl::share_pairs(ListTuner::OuterStatistics& statistics) {
  SearchInput in;
  in.count = store.size();
  in.position = store.position.data();
  in.velocity = store.motion.data();
  in.velocity_stride = GrainStore::k_motion_stride;
  in.allowance = trajectories.rows();
  in.horizon = list_time(tuner.outer_lifetime());
  in.range = largest_range;
  for (int d = 0; d < 3; ++d) {
    in.origin[d] = domain_min[d];
    in.period[d] = images.length[d];
  }
  const std::size_t tile = chunk_rows(coarse_count);
  std::vector<std::vector<RowPair>> shares((coarse_count + tile - 1) / tile);
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  for (const auto& block : search_pairs(in, k_block)) {
    for (const auto& [i, j] : block) {
      ++statistics.pairs;
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(j);
      const sdk::Vec3 d = separation(store.position.data() + 4 * b, store.position.data() + 4 * a);
      const double reach = store.position[4 * a + 3] + store.position[4 * b + 3] +
                           trajectories.skin(a) + trajectories.skin(b);
      statistics.close_pairs += dot(d, d) < reach * reach ? 1 : 0;
      const RowPair pair = in_order(i, j);
      if (i >= coarse || j >= coarse) {
        near_fine.push(pair[0], pair[1]);
      } else {
        shares[static_cast<std::size_t>(std::min(i, j)) / tile].push_back(pair);
      }
    }
  }
  return shares;
}

void Dem::Impl::make_tile(std::size_t number, std::vector<RowPair> pairs,
                          const ContactCarrier& contacts) {
  const std::size_t size = chunk_rows(coarse_count);
  Chunk& chunk = chunks[number];
  chunk.index = static_cast<std::int32_t>(number);
  chunk.begin = static_cast<std::int32_t>(number * size);
  chunk.end = static_cast<std::int32_t>(std::min(coarse_count, (number + 1) * size));
  chunk.wall_sums.assign(WallLoads::k_sums * wall_loads.walls(), 0.0);
  list_by_row(pairs, chunk);
  std::vector<RowPair>().swap(pairs);
  const double lifetime = list_time(tuner.outer_lifetime());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    for (std::int32_t i = chunk.begin; i < chunk.end; ++i) {
      if (near_surface(static_cast<std::size_t>(i), surfaces[s], lifetime)) {
        chunk.near_surfaces.push(i, static_cast<std::int32_t>(s));
      }
    }
  }
  group_by_law(chunk.near_pairs, false);
  group_by_law(chunk.near_surfaces, true);
  contacts.adopt(chunk.near_pairs, false, chunk.pairs);
  contacts.adopt(chunk.near_surfaces, true, chunk.surfaces);
}

void Dem::Impl::make_fine_list(const ContactCarrier& contacts) {
  const double lifetime = list_time(tuner.outer_lifetime());
  for (std::size_t n = coarse_count; n < store.size(); ++n) {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (near_surface(n, surfaces[s], lifetime)) {
        near_fine.push(static_cast<std::int32_t>(n), -1 - static_cast<std::int32_t>(s));
      }
    }
  }
  near_fine.segments.push_back({0, -1, 0, static_cast<std::int32_t>(near_fine.size())});
  contacts.adopt(near_fine, false, fine);
  fine_level.clear_force(store.size() - coarse_count);
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

void Dem::Impl::group_by_law(OuterList& list, bool is_surface) {
  const std::size_t n = list.size();
  const auto& material = store.material;
  std::vector<std::int32_t> group(n);
  std::int32_t groups = 0;
  const auto kinds = static_cast<std::int32_t>(laws.size());
  for (std::size_t q = 0; q < n; ++q) {
    const int mi = material[static_cast<std::size_t>(list.a[q])];
    if (is_surface) {
      const Surface& s = surfaces[static_cast<std::size_t>(list.b[q])];
      group[q] = list.b[q] * kinds + law_of(mi, s.material);
    } else {
      group[q] = law_of(mi, material[static_cast<std::size_t>(list.b[q])]);
    }
    groups = std::max(groups, group[q] + 1);
  }
  std::vector<std::int32_t> begin(static_cast<std::size_t>(groups) + 1, 0);
  for (const std::int32_t g : group) ++begin[static_cast<std::size_t>(g) + 1];
  list.segments.clear();
  for (std::int32_t g = 0; g < groups; ++g) {
    const auto u = static_cast<std::size_t>(g);
    if (begin[u + 1] > 0) {
      list.segments.push_back({is_surface ? g % kinds : g, is_surface ? g / kinds : -1, begin[u],
                               begin[u] + begin[u + 1]});
    }
    begin[u + 1] += begin[u];
  }
  if (list.segments.size() <= 1) return;  // in order already
  std::vector<std::int32_t> a(n);
  std::vector<std::int32_t> b(n);
  for (std::size_t q = 0; q < n; ++q) {
    const auto to = static_cast<std::size_t>(begin[static_cast<std::size_t>(group[q])]++);
    a[to] = list.a[q];
    b[to] = list.b[q];
  }
  list.a.swap(a);
  list.b.swap(b);
}

bool Dem::Impl::near_surface(std::size_t n, const Surface& s, double horizon_time) const {
  const double* p = store.position.data() + 4 * n;
  const double* v = store.velocity(n);
  const double reach = p[3] + trajectories.skin(n) + largest_range +
                       horizon_time * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  // The surfaces stand where the step before saw them.
  return s.may_touch({p[0], p[1], p[2]}, reach, horizon_time + steps.coarse_step);
}

RowPair Dem::Impl::in_order(std::int32_t i, std::int32_t j) const {
  const bool is_lower =
      store.id[static_cast<std::size_t>(i)] < store.id[static_cast<std::size_t>(j)];
  const std::int32_t a = is_lower ? i : j;
  const std::int32_t b = is_lower ? j : i;
  const bool is_turned =
      a < static_cast<std::int32_t>(coarse_count) && b >= static_cast<std::int32_t>(coarse_count);
  return is_turned ? RowPair{b, a} : RowPair{a, b};
}

}  // namespace dust::particles
