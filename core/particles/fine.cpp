// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_block.hpp"
#include "particles/fine_outlook.hpp"
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dust::particles {
namespace {

/// Members of one lockstep block, if clusters allow.
constexpr std::size_t k_block_members = 64;

/// Root of a grain's cluster, with path halving.
std::int32_t root(std::vector<FineState>& states, std::int32_t n) {
  auto at = [&](std::int32_t m) -> std::int32_t& {
    return states[static_cast<std::size_t>(m)].cluster;
  };
  while (at(n) != n) {
    at(n) = at(at(n));
    n = at(n);
  }
  return n;
}

}  // namespace

void Dem::Impl::fine_pass() {
  FineSpace& w = fine_space;
  w.state.resize(store.size() - coarse_count);
  const auto state = [&](std::int32_t row) -> FineState& {
    return w.state[static_cast<std::size_t>(row) - coarse_count];
  };
  for (const std::int32_t row : fine_awake.rows) {
    state(row) = {};
    std::fill_n(fine_force.begin() + 4 * (row - static_cast<std::ptrdiff_t>(coarse_count)), 4, 0.0);
  }
  const std::size_t entries = fine.size();
  w.outlook.assign(entries, {});
  const auto is_pair = [&](std::size_t e) {
    return fine.b[e] >= static_cast<std::int32_t>(coarse_count);
  };
  oneapi::tbb::parallel_for(std::size_t{0}, (entries + k_fine_block - 1) / k_fine_block,
                            [&](std::size_t b) {
                              const std::size_t end = std::min(entries, (b + 1) * k_fine_block);
                              for (std::size_t e = b * k_fine_block; e < end; ++e) {
                                if (!is_pair(e)) w.outlook[e] = look_out(*this, e, 0.0);
                              }
                            });

  const auto join = [&](std::int32_t row, const Outlook& o) {
    FineState& s = state(row);
    if (s.cluster < 0) {
      s.cluster = row - static_cast<std::int32_t>(coarse_count);
      s.stable_step = o.stable_step;
    }
    s.stable_step = std::min(s.stable_step, o.stable_step);
  };
  for (std::size_t e = 0; e < entries; ++e) {
    if (is_pair(e) || !w.outlook[e].is_near) continue;
    join(fine.a[e], w.outlook[e]);
    state(fine.a[e]).speed = std::max(state(fine.a[e]).speed, w.outlook[e].speed);
  }
  for (std::size_t e = 0; e < entries; ++e) {
    if (!is_pair(e)) continue;
    // A grain that bounces within this step may turn its relative velocity round.
    w.outlook[e] = look_out(*this, e, 2.0 * (state(fine.a[e]).speed + state(fine.b[e]).speed));
    if (!w.outlook[e].is_near) continue;
    join(fine.a[e], w.outlook[e]);
    join(fine.b[e], w.outlook[e]);
    const std::int32_t i = root(w.state, state(fine.a[e]).cluster);
    const std::int32_t j = root(w.state, state(fine.b[e]).cluster);
    w.state[static_cast<std::size_t>(std::max(i, j))].cluster = std::min(i, j);
  }
  make_blocks();

  // Everyone awake moves as if alone; members of blocks, loaded above, then overwrite their rows.
  const auto& rows = fine_awake.rows;
  oneapi::tbb::parallel_for(
      std::size_t{0}, (rows.size() + k_fine_block - 1) / k_fine_block, [&](std::size_t b) {
        const std::size_t first = b * k_fine_block;
        integrate_awake({rows.data() + first, std::min(k_fine_block, rows.size() - first)}, 0,
                        nullptr, ForceOrder::by_row);
      });
  oneapi::tbb::parallel_for(std::size_t{0}, w.block_count, [&](std::size_t b) {
    Block& block = w.blocks[b];
    std::stable_sort(block.candidates.begin(), block.candidates.end(),
                     [](const Candidate& x, const Candidate& y) {
                       return std::tie(x.law, x.surface) < std::tie(y.law, y.surface);
                     });
    block.wall_sums.assign(WallLoads::k_sums * wall_loads.walls(), 0.0);
    run_block(*this, block, time);
    for (const Member& m : block.members) {
      store_member(store, m,
                   fine_force.data() + 4 * (static_cast<std::size_t>(m.row) - coarse_count));
    }
  });
  counters.fine_steps += static_cast<std::int64_t>(w.state.size() - w.active.size());
  for (std::size_t b = 0; b < w.block_count; ++b) {
    Block& block = w.blocks[b];
    if (wall_loads.is_on()) wall_loads.take(block.wall_sums, block.wall_impacts);
    counters.fine_steps += static_cast<std::int64_t>(block.members.size()) << block.level;
    counters.largest_fine_overlap = std::max(counters.largest_fine_overlap, block.largest_overlap);
    for (const Candidate& c : block.candidates) {
      if (c.row < 0 || std::all_of(c.reaction, c.reaction + 6, [](double x) { return x == 0.0; }))
        continue;
      Reaction r{.row = c.row};
      std::copy_n(c.reaction, 6, r.impulse);
      pending.push_back(r);
    }
  }
}

/// Clusters at the level of their most demanding member, no finer than that member's class needs,
/// then blocks of clusters of one level.
void Dem::Impl::make_blocks() {
  const double step = steps.coarse_step;
  FineSpace& w = fine_space;
  const auto fine_state = [&](std::int32_t n) -> FineState& {
    return w.state[static_cast<std::size_t>(n)];
  };
  w.active.clear();
  for (const std::int32_t row : fine_awake.rows) {
    const std::int32_t n = row - static_cast<std::int32_t>(coarse_count);
    FineState& s = fine_state(n);
    if (s.cluster < 0) continue;
    s.cluster = root(w.state, n);
    const double diameter = 2.0 * store.position[4 * static_cast<std::size_t>(row) + 3];
    const auto size =
        std::lower_bound(steps.classes.begin(), steps.classes.end(), diameter * (1.0 - 1e-9),
                         [](const ClassStep& c, double d) { return c.diameter < d; });
    const int finest = size == steps.classes.end() ? 0 : size->level;
    const int wanted =
        static_cast<int>(std::ceil(std::log2(step / std::max(s.stable_step, 1e-30))));
    auto& level = fine_state(s.cluster).level;
    level = std::max(level, std::clamp(wanted, 0, finest));
    w.active.push_back(n);
  }
  std::sort(w.active.begin(), w.active.end(), [&](std::int32_t a, std::int32_t b) {
    const std::int32_t ca = fine_state(a).cluster;
    const std::int32_t cb = fine_state(b).cluster;
    const std::int32_t la = fine_state(ca).level;
    const std::int32_t lb = fine_state(cb).level;
    return std::tie(lb, ca, a) < std::tie(la, cb, b);
  });
  w.block_count = 0;
  std::int32_t last_cluster = -1;
  for (const std::int32_t n : w.active) {
    const std::int32_t cluster = fine_state(n).cluster;
    const int level = fine_state(cluster).level;
    if (w.block_count == 0 || w.blocks[w.block_count - 1].level != level ||
        (cluster != last_cluster &&
         w.blocks[w.block_count - 1].members.size() >= k_block_members)) {
      if (w.block_count++ == w.blocks.size()) w.blocks.emplace_back();
      Block& next = w.blocks[w.block_count - 1];
      next.members.clear();
      next.candidates.clear();
      next.level = level;
      next.largest_overlap = 0.0;
    }
    last_cluster = cluster;
    Block& block = w.blocks[w.block_count - 1];
    fine_state(n).block = static_cast<std::int32_t>(w.block_count - 1);
    fine_state(n).seat = static_cast<std::int32_t>(block.members.size());
    block.members.push_back(
        load_member(store, gravity, coarse_count + static_cast<std::size_t>(n)));
  }
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  for (std::size_t e = 0; e < fine.size(); ++e) {
    if (!w.outlook[e].is_near) continue;
    const FineState& s = fine_state(fine.a[e] - coarse);
    Candidate c{.entry = static_cast<std::int32_t>(e), .member = s.seat};
    const int material = store.material[static_cast<std::size_t>(fine.a[e])];
    if (fine.b[e] < 0) {
      c.surface = -1 - fine.b[e];
      c.law = law_of(material, surfaces[static_cast<std::size_t>(c.surface)].material);
    } else {
      c.law = law_of(material, store.material[static_cast<std::size_t>(fine.b[e])]);
      if (fine.b[e] >= coarse) {
        c.partner = fine_state(fine.b[e] - coarse).seat;
      } else {
        c.row = fine.b[e];
      }
    }
    w.blocks[static_cast<std::size_t>(s.block)].candidates.push_back(c);
  }
}

}  // namespace dust::particles
