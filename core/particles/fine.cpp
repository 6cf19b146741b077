// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_block.hpp"
#include "particles/fine_outlook.hpp"
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

/// Grains below the border of the coarse rate, stepped as fine as their contacts want
/// (docs/theory/grains.md, "Several rates").
namespace dust::particles {
namespace {

/// Members of one lockstep block, if clusters allow.
constexpr std::size_t k_block_members = 64;
/// A coarse grain is heavy beside a fine one from so many times its mass on. Clusters near a heavy
/// one feel each other through it only from the next coarse step on: a share of 1/k_heavy of their
/// forces comes that late. Near a light one all are one cluster.
constexpr double k_heavy = 64.0;

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

bool stands_before(const Guest& a, const Guest& b) {
  return std::tie(a.cluster, a.row) < std::tie(b.cluster, b.row);
}

}  // namespace

void Dem::Impl::fine_pass() {
  FineSpace& w = fine_space;
  w.state.resize(store.size() - coarse_count);
  const auto coarse = static_cast<std::ptrdiff_t>(coarse_count);
  for (const std::int32_t row : fine_awake.rows) {
    w.state[static_cast<std::size_t>(row - coarse)] = {};
    std::fill_n(fine_force.begin() + 4 * (row - coarse), 4, 0.0);
  }
  find_clusters();
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
      if (m.is_guest) continue;
      store_member(store, m, fine_force.data() + 4 * (m.row - coarse));
    }
  });
  counters.fine_steps += static_cast<std::int64_t>(w.state.size() - w.active.size());
  for (std::size_t b = 0; b < w.block_count; ++b) {
    Block& block = w.blocks[b];
    if (wall_loads.is_on()) wall_loads.take(block.wall_sums, block.wall_impacts);
    counters.fine_steps += (static_cast<std::int64_t>(block.members.size()) - block.guests)
                           << block.level;
    counters.largest_fine_overlap = std::max(counters.largest_fine_overlap, block.largest_overlap);
  }
  give_back();
}

/// Who is in reach of whom: fine grains of one cluster step together.
void Dem::Impl::find_clusters() {
  FineSpace& w = fine_space;
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  const auto state = [&](std::int32_t row) -> FineState& {
    return w.state[static_cast<std::size_t>(row - coarse)];
  };
  const std::size_t entries = fine.size();
  w.outlook.assign(entries, {});
  const auto is_pair = [&](std::size_t e) { return fine.b[e] >= coarse; };
  const auto is_guest = [&](std::size_t e) { return fine.b[e] >= 0 && fine.b[e] < coarse; };
  oneapi::tbb::parallel_for(std::size_t{0}, (entries + k_fine_block - 1) / k_fine_block,
                            [&](std::size_t b) {
                              const std::size_t end = std::min(entries, (b + 1) * k_fine_block);
                              for (std::size_t e = b * k_fine_block; e < end; ++e) {
                                if (!is_pair(e)) w.outlook[e] = look_out(*this, e, 0.0);
                              }
                            });
  const auto join = [&](std::int32_t row, std::size_t e) {
    FineState& s = state(row);
    const Outlook& o = w.outlook[e];
    if (s.cluster < 0) {
      s.cluster = row - coarse;
      s.stable_step = o.stable_step;
    }
    s.stable_step = std::min(s.stable_step, o.stable_step);
    // A contact under way keeps its step, or a shorter one: a step that grew and shrank with the
    // speed and the overlap would not be the same on the way in and on the way out.
    s.least_level = std::max(s.least_level, static_cast<std::int32_t>(fine.is_touching[e]) - 1);
  };
  const auto unite = [&](std::int32_t a, std::int32_t b) {
    const std::int32_t i = root(w.state, a);
    const std::int32_t j = root(w.state, b);
    w.state[static_cast<std::size_t>(std::max(i, j))].cluster = std::min(i, j);
  };
  w.host.resize(coarse_count, -1);
  for (std::size_t e = 0; e < entries; ++e) {
    if (is_pair(e) || !w.outlook[e].is_near) continue;
    join(fine.a[e], e);
    state(fine.a[e]).speed = std::max(state(fine.a[e]).speed, w.outlook[e].speed);
    if (!is_guest(e) || is_heavy(fine.b[e], fine.a[e])) continue;
    w.host[static_cast<std::size_t>(fine.b[e])] = fine.a[e] - coarse;
  }
  for (std::size_t e = 0; e < entries; ++e) {
    if (!is_guest(e) || !w.outlook[e].is_near) continue;
    const std::int32_t host = w.host[static_cast<std::size_t>(fine.b[e])];
    if (host >= 0) unite(host, state(fine.a[e]).cluster);
  }
  for (std::size_t e = 0; e < entries; ++e) {
    if (!is_pair(e)) continue;
    // A grain that bounces within this step may turn its relative velocity round.
    w.outlook[e] = look_out(*this, e, 2.0 * (state(fine.a[e]).speed + state(fine.b[e]).speed));
    if (!w.outlook[e].is_near) continue;
    join(fine.a[e], e);
    join(fine.b[e], e);
    unite(state(fine.a[e]).cluster, state(fine.b[e]).cluster);
  }
  w.guests.clear();
  for (std::size_t e = 0; e < entries; ++e) {
    if (!is_guest(e)) continue;
    w.host[static_cast<std::size_t>(fine.b[e])] = -1;
    if (!w.outlook[e].is_near) continue;
    w.guests.push_back({root(w.state, state(fine.a[e]).cluster), fine.b[e], -1});
  }
  std::sort(w.guests.begin(), w.guests.end(), stands_before);
  const auto is_same = [](const Guest& a, const Guest& b) {
    return a.cluster == b.cluster && a.row == b.row;
  };
  w.guests.erase(std::unique(w.guests.begin(), w.guests.end(), is_same), w.guests.end());
}

/// Whether a coarse grain answers a fine one's forces by little enough.
bool Dem::Impl::is_heavy(std::int32_t coarse, std::int32_t fine_row) const {
  const auto c = static_cast<std::size_t>(coarse);
  const auto f = static_cast<std::size_t>(fine_row);
  return felt_share(store.weight[c], store.weight[f]) * store.velocity(c)[3] * k_heavy <=
         felt_share(store.weight[f], store.weight[c]) * store.velocity(f)[3];
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
    level = std::max({level, std::clamp(wanted, 0, finest), s.least_level});
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
      next.guests = 0;
      next.largest_overlap = 0.0;
    }
    Block& block = w.blocks[w.block_count - 1];
    if (cluster != last_cluster) seat_guests(cluster, block);
    last_cluster = cluster;
    fine_state(n).block = static_cast<std::int32_t>(w.block_count - 1);
    fine_state(n).seat = static_cast<std::int32_t>(block.members.size());
    block.members.push_back(
        load_member(store, gravity, coarse_count + static_cast<std::size_t>(n)));
  }
  list_candidates();
}

/// The coarse grains near a cluster become members of its block.
void Dem::Impl::seat_guests(std::int32_t cluster, Block& block) {
  const double sub_step = steps.coarse_step / static_cast<double>(1 << block.level);
  auto& guests = fine_space.guests;
  for (auto g = std::lower_bound(guests.begin(), guests.end(), Guest{cluster, -1}, stands_before);
       g != guests.end() && g->cluster == cluster; ++g) {
    g->seat = static_cast<std::int32_t>(block.members.size());
    block.members.push_back(load_guest(*this, g->row, sub_step));
    ++block.guests;
  }
}

void Dem::Impl::list_candidates() {
  FineSpace& w = fine_space;
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  const auto fine_state = [&](std::int32_t row) -> const FineState& {
    return w.state[static_cast<std::size_t>(row - coarse)];
  };
  for (std::size_t e = 0; e < fine.size(); ++e) {
    if (!w.outlook[e].is_near) continue;
    const FineState& s = fine_state(fine.a[e]);
    Candidate c{.entry = static_cast<std::int32_t>(e), .member = s.seat};
    const int material = store.material[static_cast<std::size_t>(fine.a[e])];
    if (fine.b[e] < 0) {
      c.surface = -1 - fine.b[e];
      c.law = law_of(material, surfaces[static_cast<std::size_t>(c.surface)].material);
    } else {
      c.law = law_of(material, store.material[static_cast<std::size_t>(fine.b[e])]);
      c.partner = fine.b[e] >= coarse ? fine_state(fine.b[e]).seat
                                      : std::lower_bound(w.guests.begin(), w.guests.end(),
                                                         Guest{s.cluster, fine.b[e]}, stands_before)
                                            ->seat;
    }
    w.blocks[static_cast<std::size_t>(s.block)].candidates.push_back(c);
  }
}

/// What fine grains have done to the coarse ones near them. A row says the mean velocity of the
/// step, its way over its time, which springs go by. What the velocity at its end differs by waits
/// for the next step (resume_course).
void Dem::Impl::give_back() {
  const double inverse_step = 1.0 / steps.coarse_step;
  left_overs.clear();
  for (std::size_t b = 0; b < fine_space.block_count; ++b) {
    for (const Member& m : fine_space.blocks[b].members) {
      if (!m.is_guest) continue;
      const sdk::Vec3 gain = m.half_velocity - m.course;
      const sdk::Vec3 spin = m.half_rotation - m.course_rotation;
      if (dot(gain, gain) + dot(m.shift, m.shift) + dot(spin, spin) + dot(m.turn, m.turn) == 0.0) {
        continue;
      }
      LeftOver l{.row = m.row};
      const auto row = static_cast<std::size_t>(m.row);
      for (int d = 0; d < 3; ++d) {
        const auto k = 4 * row + static_cast<std::size_t>(d);
        const double mean = inverse_step * m.shift[d];
        const double mean_turn = inverse_step * m.turn[d];
        store.position[k] += m.shift[d];
        store.velocity(row)[d] += m.velocity[d] - m.course[d];
        store.rotation(row)[d] += m.rotation[d] - m.course_rotation[d];
        store.half_velocity(row)[d] += mean;
        store.half_rotation(row)[d] += mean_turn;
        l.velocity[d] = gain[d] - mean;
        l.rotation[d] = spin[d] - mean_turn;
        l.velocity_ahead[d] = m.velocity[d] - m.half_velocity[d];
        l.rotation_ahead[d] = m.rotation[d] - m.half_rotation[d];
        if (!contact_force.empty()) contact_force[k] += inverse_step * gain[d] / m.inverse_mass;
      }
      left_overs.push_back(l);
    }
  }
  // One for each grain, in the order of rows.
  std::stable_sort(left_overs.begin(), left_overs.end(),
                   [](const LeftOver& a, const LeftOver& b) { return a.row < b.row; });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < left_overs.size(); ++n) {
    if (n > 0 && left_overs[kept - 1].row == left_overs[n].row) {
      left_overs[kept - 1].add(left_overs[n]);
    } else {
      left_overs[kept++] = left_overs[n];
    }
  }
  left_overs.resize(kept);
}

/// Before a chunk's grains move: those that fine grains were near go on with the velocity that they
/// ended the last step with.
void Dem::Impl::resume_course(const Chunk& chunk, Movers movers) {
  const auto first =
      std::lower_bound(left_overs.begin(), left_overs.end(), chunk.begin,
                       [](const LeftOver& l, std::int32_t row) { return l.row < row; });
  for (auto l = first; l != left_overs.end() && l->row < chunk.end; ++l) {
    const bool is_shared = is_awake[static_cast<std::size_t>(l->row)] == 2;
    if (movers != Movers::all && is_shared != (movers == Movers::shared)) continue;
    const auto row = static_cast<std::size_t>(l->row);
    for (int d = 0; d < 3; ++d) {
      store.half_velocity(row)[d] += l->velocity[d];
      store.half_rotation(row)[d] += l->rotation[d];
    }
  }
}

}  // namespace dust::particles
