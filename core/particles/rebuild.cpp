// SPDX-License-Identifier: Apache-2.0
#include "base/cells.hpp"
#include "dust/sdk/error.hpp"
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace dust::particles {
namespace {

/// Rebuilds between two sorts of the rows where no grain came or went.
constexpr std::int64_t k_sort_every = 4;
/// Allowed deviation from the straight course, in diameters (coarse grains): the least, for beds,
/// and what one level more adds. In dilute flow, where pairs are few and every collision throws a
/// grain off its course, lists with wider allowances last longer and cost little.
constexpr double k_allowance = 0.15;
constexpr double k_allowance_level = 0.15;
constexpr std::int64_t k_widest_level = 7;
/// Pairs in the list per grain below which the allowance is widened after a rebuild that came
/// early, and above which it is narrowed.
constexpr double k_few_pairs = 3.0;
constexpr double k_many_pairs = 6.0;
/// The same for a fine grain that stands alone, in diameters of the largest grain; in a crowd it is
/// half the mean distance, so that a pocket of dust does not list its far neighbours.
constexpr double k_fine_allowance = 0.3;
constexpr double k_crowd_allowance = 0.15;
/// Edge of the cells in which a crowd is counted, in diameters of the largest grain: small, so that
/// the empty space round a pocket does not thin it out.
constexpr double k_crowd_edge = 0.2;
constexpr std::int64_t k_shortest_horizon = 16;
constexpr std::int64_t k_longest_horizon = 4096;

std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  v = (v | v << 2) & 0x1249249249249249ull;
  return v;
}

}  // namespace

void Dem::Impl::neighbours() {
  if (!is_watching || must_watch || since_watch >= watch_length || must_rebuild ||
      since_rebuild >= horizon) {
    land();
  }
  if (must_mend && !must_rebuild && since_rebuild < horizon) must_rebuild = !mend();
  if (must_rebuild || since_rebuild >= horizon) rebuild();
  if (!is_watching) begin_watch();
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

/// Coarse grains first, then fine ones, each in Morton order of cells of the largest grain.
void Dem::Impl::sort_rows() {
  const double edge = steps.classes.back().diameter;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(store.size());
  coarse_count = 0;
  for (std::size_t n = 0; n < store.size(); ++n) {
    const double* p = store.position.data() + 4 * n;
    std::uint64_t key = 0;
    for (int d = 0; d < 3; ++d) {
      const double cell = std::clamp((p[d] - domain_min[d]) / edge, 0.0, 2097151.0);
      key |= spread_bits(static_cast<std::uint64_t>(cell)) << d;
    }
    const bool is_coarse = 2.0 * p[3] >= steps.coarse_limit;
    coarse_count += is_coarse ? 1 : 0;
    keys[n] = {(is_coarse ? 0 : std::uint64_t{1} << 63) | key, static_cast<std::int32_t>(n)};
  }
  std::sort(keys.begin(), keys.end());
  old_row.resize(store.size());
  for (std::size_t n = 0; n < keys.size(); ++n) old_row[n] = keys[n].second;
  store.reorder(old_row);
}

void Dem::Impl::choose_allowances() {
  const double share = k_allowance + k_allowance_level * static_cast<double>(allowance_level);
  for (std::size_t n = 0; n < coarse_count; ++n) {
    store.start[4 * n + 3] = share * 2.0 * store.position[4 * n + 3];
  }
  if (coarse_count == store.size()) return;
  const double lone = k_fine_allowance * steps.classes.back().diameter;
  const double edge = k_crowd_edge * steps.classes.back().diameter;
  std::unordered_map<std::uint64_t, std::int32_t> crowd;
  std::vector<std::uint64_t> key_of(store.size() - coarse_count);
  for (std::size_t n = coarse_count; n < store.size(); ++n) {
    const double* p = store.position.data() + 4 * n;
    const auto cell = [&](int d) { return base::cell_index((p[d] - domain_min[d]) / edge); };
    const std::uint64_t key = base::cell_key(cell(0), cell(1), cell(2));
    key_of[n - coarse_count] = key;
    ++crowd[key];
  }
  for (std::size_t n = coarse_count; n < store.size(); ++n) {
    const double diameter = 2.0 * store.position[4 * n + 3];
    const std::int32_t here = crowd[key_of[n - coarse_count]];
    const double spacing = edge / std::cbrt(static_cast<double>(here));
    store.start[4 * n + 3] =
        here == 1 ? lone : std::max(k_crowd_allowance * diameter, std::min(lone, 0.5 * spacing));
  }
}

void Dem::Impl::group_by_law(VerletList& list, bool is_surface) {
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

/// The pairs of a chunk by their earlier row, those of one row as they were found: the contacts of
/// the same grains lie side by side.
void Dem::Impl::list_by_row(std::span<const std::array<std::int32_t, 2>> pairs, Chunk& chunk) {
  std::vector<std::int32_t> next(static_cast<std::size_t>(chunk.end - chunk.begin) + 1, 0);
  const auto place = [&](const std::array<std::int32_t, 2>& pair) {
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

/// The contacts in touch, found again in the new list.
void Dem::Impl::carry_over(VerletList& list, ContactList& contacts, bool is_surface) {
  const std::size_t n = list.size();
  contacts.clear();
  if (old_begin.size() < 2) return;
  const auto old_rows = static_cast<std::int32_t>(old_begin.size()) - 1;
  for (std::size_t q = 0; q < n; ++q) {
    const std::int32_t a = old_row[static_cast<std::size_t>(list.a[q])];
    std::int32_t b = is_surface ? -1 - list.b[q] : list.b[q];
    if (b >= 0) b = old_row[static_cast<std::size_t>(b)];
    if (a >= old_rows) continue;
    for (std::int32_t m = old_begin[static_cast<std::size_t>(a)];
         m < old_begin[static_cast<std::size_t>(a) + 1]; ++m) {
      if (old_partner[static_cast<std::size_t>(m)] != b) continue;
      contacts.push(list.a[q], list.b[q], old_history[static_cast<std::size_t>(m)], history_stride);
      contacts.is_touching.back() = old_touching[static_cast<std::size_t>(m)];
      break;
    }
  }
}

bool Dem::Impl::may_widen(std::size_t listed) const {
  return allowance_level < k_widest_level &&
         static_cast<double>(listed) < k_few_pairs * static_cast<double>(store.size());
}

bool Dem::Impl::near_surface(std::size_t n, const Surface& s, double horizon_time) const {
  const double* p = store.position.data() + 4 * n;
  const double* v = store.velocity(n);
  const double reach = p[3] + store.start[4 * n + 3] + largest_range +
                       horizon_time * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  // The surfaces stand where the step before saw them.
  return s.may_touch({p[0], p[1], p[2]}, reach, horizon_time + steps.coarse_step);
}

std::array<std::int32_t, 2> Dem::Impl::in_order(std::int32_t i, std::int32_t j) const {
  const bool is_lower =
      store.id[static_cast<std::size_t>(i)] < store.id[static_cast<std::size_t>(j)];
  const std::int32_t a = is_lower ? i : j;
  const std::int32_t b = is_lower ? j : i;
  const bool is_turned =
      a < static_cast<std::int32_t>(coarse_count) && b >= static_cast<std::int32_t>(coarse_count);
  return is_turned ? std::array{b, a} : std::array{a, b};
}

void Dem::Impl::rebuild() {
  ++counters.rebuilds;
  const bool is_early = !must_sort && since_rebuild < horizon;
  // A list given up before half of its time was made for too long, whoever asked for a new one.
  const bool is_long = 2 * since_rebuild < horizon;
  gather_wall_loads();
  wrap_periodic();
  for (const Chunk& c : chunks) {
    times_before.add(c.times);
    counters.largest_coarse_overlap = std::max(counters.largest_coarse_overlap, c.largest_overlap);
  }
  // The contacts in touch, by their first grain's old row.
  const std::size_t old_rows = store.size();
  std::vector<Chunk> old_chunks = std::move(chunks);
  ContactList old_fine = std::move(fine);
  near_fine.clear();
  old_begin.assign(old_rows + 1, 0);
  const auto each = [&](auto&& visit) {
    const auto walk = [&](const ContactList& list, bool is_surface) {
      for (std::size_t q = 0; q < list.size(); ++q) {
        if (list.is_touching[q] == 0) continue;
        visit(list.a[q], is_surface ? -1 - list.b[q] : list.b[q],
              list.history.data() + q * history_stride, list.is_touching[q]);
      }
    };
    for (const Chunk& c : old_chunks) {
      walk(c.pairs, false);
      walk(c.surfaces, true);
    }
    walk(old_fine, false);
  };
  each([&](std::int32_t a, std::int32_t, const double*, std::uint8_t) {
    ++old_begin[static_cast<std::size_t>(a) + 1];
  });
  for (std::size_t n = 0; n < old_rows; ++n) old_begin[n + 1] += old_begin[n];
  old_partner.resize(static_cast<std::size_t>(old_begin.back()));
  old_history.resize(old_partner.size());
  old_touching.resize(old_partner.size());
  std::vector<std::int32_t> fill(old_begin.begin(), old_begin.end() - 1);
  each([&](std::int32_t a, std::int32_t b, const double* history, std::uint8_t touching) {
    const auto to = static_cast<std::size_t>(fill[static_cast<std::size_t>(a)]++);
    old_partner[to] = b;
    old_history[to] = history;
    old_touching[to] = touching;
  });

  if (must_sort || counters.rebuilds % k_sort_every == 0) {
    sort_rows();
    if (!fine_level.deferred().all().empty()) {
      std::vector<std::int32_t> new_row(old_row.size());
      for (std::size_t n = 0; n < old_row.size(); ++n)
        new_row[static_cast<std::size_t>(old_row[n])] = static_cast<std::int32_t>(n);
      fine_level.renumber(new_row);
    }
  } else {
    old_row.resize(store.size());
    for (std::size_t n = 0; n < store.size(); ++n) old_row[n] = static_cast<std::int32_t>(n);
  }
  choose_allowances();
  look_at_weights();
  for (std::size_t n = 0; n < store.size(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) {
      store.start[4 * n + d] = store.position[4 * n + d];
      store.start_velocity[4 * n + d] = static_cast<float>(store.velocity(n)[d]);
    }
  }

  // The search looks as far as the fastest grain flies: no farther than a diameter.
  const double longest =
      steps.classes.back().diameter / steps.coarse_step / std::max(fastest(), 1e-15);
  horizon = std::min(next_horizon, std::max(k_shortest_horizon,
                                            static_cast<std::int64_t>(std::min(longest, 1e6))));
  SearchInput in;
  in.count = store.size();
  in.position = store.position.data();
  in.velocity = store.motion.data();
  in.velocity_stride = GrainStore::k_motion_stride;
  in.allowance = store.start.data();
  in.horizon = static_cast<double>(horizon) * steps.coarse_step;
  in.range = largest_range;
  for (int d = 0; d < 3; ++d) {
    in.origin[d] = domain_min[d];
    in.period[d] = images.length[d];
  }
  const auto found = search_pairs(in, k_block);

  // Shares: coarse pairs to the chunk of the earlier row, everything with a fine grain to the fine
  // list.
  const std::size_t size = chunk_rows(coarse_count);
  const std::size_t count = (coarse_count + size - 1) / size;
  chunks.resize(count);
  std::vector<std::vector<std::array<std::int32_t, 2>>> shares(count);
  std::int64_t listed = 0;
  std::int64_t close = 0;
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  for (const auto& block : found) {
    for (const auto& [i, j] : block) {
      ++listed;
      const sdk::Vec3 d = separation(store.position.data() + 4 * static_cast<std::ptrdiff_t>(j),
                                     store.position.data() + 4 * static_cast<std::ptrdiff_t>(i));
      const double reach = store.position[4 * static_cast<std::size_t>(i) + 3] +
                           store.position[4 * static_cast<std::size_t>(j) + 3] +
                           store.start[4 * static_cast<std::size_t>(i) + 3] +
                           store.start[4 * static_cast<std::size_t>(j) + 3];
      close += dot(d, d) < reach * reach ? 1 : 0;
      const auto [a, b] = in_order(i, j);
      if (i >= coarse || j >= coarse) {
        near_fine.push(a, b);
        continue;
      }
      shares[static_cast<std::size_t>(std::min(i, j)) / size].push_back({a, b});
    }
  }
  // Lists are made for so long that the horizon adds little to what the allowances list anyhow.
  const std::int64_t base = close + static_cast<std::int64_t>(store.size()) / 2;
  if (is_long) {
    next_horizon = std::max(horizon / 2, k_shortest_horizon);
  } else if (10 * (listed - close) < base) {
    next_horizon = std::min((40 * (listed - close) < base ? 4 : 2) * horizon, k_longest_horizon);
  } else if (10 * (listed - close) > 4 * base) {
    next_horizon = std::max(horizon / 2, k_shortest_horizon);
  }
  const double made_for = in.horizon;
  if (is_early && may_widen(static_cast<std::size_t>(listed))) {
    ++allowance_level;
  } else if (static_cast<double>(listed) > k_many_pairs * static_cast<double>(store.size())) {
    allowance_level = std::max<std::int64_t>(allowance_level - 1, 0);
  }

  const auto build = [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    chunk.index = static_cast<std::int32_t>(c);
    chunk.begin = static_cast<std::int32_t>(c * size);
    chunk.end = static_cast<std::int32_t>(std::min(coarse_count, (c + 1) * size));
    chunk.wall_sums.assign(WallLoads::k_sums * wall_loads.walls(), 0.0);
    list_by_row(shares[c], chunk);
    std::vector<std::array<std::int32_t, 2>>().swap(shares[c]);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      for (std::int32_t i = chunk.begin; i < chunk.end; ++i) {
        if (near_surface(static_cast<std::size_t>(i), surfaces[s], made_for)) {
          chunk.near_surfaces.push(i, static_cast<std::int32_t>(s));
        }
      }
    }
    group_by_law(chunk.near_pairs, false);
    group_by_law(chunk.near_surfaces, true);
    carry_over(chunk.near_pairs, chunk.pairs, false);
    carry_over(chunk.near_surfaces, chunk.surfaces, true);
  };
  oneapi::tbb::parallel_for(std::size_t{0}, count, build);

  for (std::size_t n = coarse_count; n < store.size(); ++n) {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (near_surface(n, surfaces[s], made_for)) {
        near_fine.push(static_cast<std::int32_t>(n), -1 - static_cast<std::int32_t>(s));
      }
    }
  }
  near_fine.segments.push_back({0, -1, 0, static_cast<std::int32_t>(near_fine.size())});
  carry_over(near_fine, fine, false);
  fine_level.clear_force(store.size() - coarse_count);

  // Lists are most of the memory: what only a rebuild needs is given back.
  std::vector<std::int32_t>().swap(old_row);
  std::vector<std::int32_t>().swap(old_begin);
  std::vector<std::int32_t>().swap(old_partner);
  std::vector<std::uint8_t>().swap(old_touching);
  std::vector<const double*>().swap(old_history);
  contact_force.clear();  // in the order of rows that were
  since_rebuild = 0;
  mended = 0;
  farthest_reach = 0.0;
  must_mend = must_rebuild = must_sort = false;
}

}  // namespace dust::particles
