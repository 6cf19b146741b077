// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include "base/cells.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

/// Lists mended where single grains have left the course they suppose, in place of lists made new
/// for everybody (docs/decisions/0018_lists_are_updated.md).
namespace dust::particles {
namespace {

/// With more strays at once than one grain in so many, or since the lists were made, they are made
/// new: a mended list keeps what is no longer wanted.
constexpr std::size_t k_grains_per_stray = 16;
constexpr std::size_t k_grains_per_mended = 4;

/// The strays by the cells that their surroundings overlap, in a hash table: a grain looks into one
/// cell. Cells of hashes that collide are one; who is near is found out by distances.
class Surroundings {
 public:
  /// `edge` of the cells; `around`: how far the others reach at most.
  Surroundings(const std::vector<Ball>& strays, double around, const contact::Images& images)
      : images_(images) {
    double edge = 0.0;
    for (const Ball& b : strays) edge = std::max(edge, b.reach + around);
    for (int d = 0; d < 3; ++d) {
      inverse_[d] = 1.0 / edge;
      if (images_.length[d] <= 0.0) continue;
      count_[d] = std::max<std::int64_t>(1, static_cast<std::int64_t>(images_.length[d] / edge));
      inverse_[d] = static_cast<double>(count_[d]) / images_.length[d];
    }
    const std::size_t size = std::bit_ceil(64 * strays.size() + 64);
    shift_ = 64 - std::countr_zero(size);
    std::vector<std::pair<std::uint32_t, std::int32_t>> entries;
    for (std::size_t s = 0; s < strays.size(); ++s) {
      const double centre[3] = {strays[s].x, strays[s].y, strays[s].z};
      std::int64_t low[3];
      std::int64_t high[3];
      for (int d = 0; d < 3; ++d) {
        low[d] = cell(centre[d] - strays[s].reach - around, d);
        high[d] = cell(centre[d] + strays[s].reach + around, d);
        if (count_[d] > 0) high[d] = std::min(high[d], low[d] + count_[d] - 1);
      }
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        for (std::int64_t y = low[1]; y <= high[1]; ++y) {
          for (std::int64_t x = low[0]; x <= high[0]; ++x) {
            entries.emplace_back(slot(x, y, z), static_cast<std::int32_t>(s));
          }
        }
      }
    }
    std::sort(entries.begin(), entries.end());
    // Two cells of one stray may share a slot.
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    begin_.assign(size + 1, 0);
    for (const auto& e : entries) ++begin_[e.first + 1];
    for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
    strays_.reserve(entries.size());
    for (const auto& e : entries) strays_.push_back(e.second);
  }

  /// Strays that may be near a place, in their order.
  [[nodiscard]] std::span<const std::int32_t> at(const Ball& b) const {
    const std::uint32_t s = slot(cell(b.x, 0), cell(b.y, 1), cell(b.z, 2));
    const auto first = static_cast<std::size_t>(begin_[s]);
    return std::span(strays_).subspan(first, static_cast<std::size_t>(begin_[s + 1]) - first);
  }

 private:
  [[nodiscard]] std::int64_t cell(double x, int d) const {
    return base::cell_index(x * inverse_[d]);
  }
  [[nodiscard]] std::uint32_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::uint64_t key =
        base::cell_key(base::wrapped_cell(x, count_[0]), base::wrapped_cell(y, count_[1]),
                       base::wrapped_cell(z, count_[2]));
    return static_cast<std::uint32_t>(base::spread_key(key) >> shift_);
  }

  const contact::Images& images_;
  double inverse_[3];
  std::int64_t count_[3] = {0, 0, 0};  ///< of cells along a periodic side, else 0
  int shift_ = 0;
  std::vector<std::int32_t> begin_;
  std::vector<std::int32_t> strays_;
};

}  // namespace

/// Rows of the grains off their course, in order.
std::vector<std::int32_t> Dem::Impl::find_strays() const {
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  std::vector<std::vector<std::int32_t>> found(blocks);
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    // Not known after a resume.
    if (wants.size() == blocks && wants[b] == 0) return;
    const std::size_t end = std::min(store.size(), (b + 1) * k_block);
    for (std::size_t n = b * k_block; n < end; ++n) {
      if (is_off_course(n)) found[b].push_back(static_cast<std::int32_t>(n));
    }
  });
  std::vector<std::int32_t> strays;
  for (const auto& rows : found) strays.insert(strays.end(), rows.begin(), rows.end());
  return strays;
}

/// False where lists are to be made new: for many strays, or because they are short and will hold
/// longer with wider allowances.
bool Dem::Impl::mend() {
  std::size_t listed = near_fine.size();
  for (const Chunk& c : chunks) listed += c.near_pairs.size();
  if (tuner.may_widen_skins(static_cast<std::int64_t>(listed),
                            static_cast<std::int64_t>(store.size()))) {
    return false;
  }
  const std::vector<std::int32_t> strays = find_strays();
  mended += static_cast<std::int64_t>(strays.size());
  if (k_grains_per_stray * strays.size() > store.size() ||
      static_cast<std::int64_t>(k_grains_per_mended) * mended >
          static_cast<std::int64_t>(store.size())) {
    return false;
  }
  must_mend = false;
  for (const std::int32_t row : strays) {
    const auto n = static_cast<std::size_t>(row);
    trajectories.restart(n, store.position.data() + 4 * n, store.velocity(n),
                         list_time(since_rebuild));
  }
  add_pairs_of(strays);
  add_surfaces_of(strays);
  ++counters.mends;
  return true;
}

/// The pairs that the strays' new courses bring near, put behind what is listed already.
void Dem::Impl::add_pairs_of(std::span<const std::int32_t> strays) {
  const double t = list_time(since_rebuild);
  const double left = list_time(tuner.outer_lifetime() - since_rebuild);
  const auto ball_of = [&](std::size_t n) {
    const sdk::Vec3 x = trajectories.position(n, t);
    const sdk::Vec3 v = trajectories.velocity(n);
    const double way = 0.5 * left;
    return Ball{x.x + way * v.x, x.y + way * v.y, x.z + way * v.z,
                store.position[4 * n + 3] + trajectories.skin(n) + 0.5 * largest_range +
                    way * std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)};
  };
  const std::size_t blocks = (store.size() + k_block - 1) / k_block;
  const auto for_blocks = [&](auto&& work) {
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
      const std::size_t end = std::min(store.size(), (b + 1) * k_block);
      for (std::size_t n = b * k_block; n < end; ++n) work(b, n);
    });
  };
  if (farthest_reach == 0.0) {
    std::vector<double> farthest(blocks, 0.0);
    for_blocks([&](std::size_t b, std::size_t n) {
      farthest[b] = std::max(farthest[b], ball_of(n).reach);
    });
    farthest_reach = *std::max_element(farthest.begin(), farthest.end());
  }
  std::vector<Ball> balls;
  std::vector<std::uint8_t> is_stray(store.size(), 0);
  for (const std::int32_t n : strays) {
    balls.push_back(ball_of(static_cast<std::size_t>(n)));
    is_stray[static_cast<std::size_t>(n)] = 1;
  }
  for (const Ball& b : balls) farthest_reach = std::max(farthest_reach, b.reach);
  // A little more, for a place on the border of two cells of a periodic side.
  const Surroundings near(balls, 1.0000001 * farthest_reach, images);
  // Whether two grains on their courses come near until the lists' end.
  const auto comes_near = [&](std::size_t i, std::size_t j) {
    const double limit = store.position[4 * i + 3] + store.position[4 * j + 3] +
                         trajectories.skin(i) + trajectories.skin(j) + largest_range;
    const sdk::Vec3 xi = trajectories.position(i, t);
    const sdk::Vec3 xj = trajectories.position(j, t);
    return passes_within(separation(&xj.x, &xi.x),
                         trajectories.velocity(i) - trajectories.velocity(j), left, limit);
  };
  std::vector<std::vector<RowPair>> found(blocks);
  for_blocks([&](std::size_t b, std::size_t n) {
    const Ball own = ball_of(n);
    for (const std::int32_t s : near.at(own)) {
      const auto row = static_cast<std::size_t>(strays[static_cast<std::size_t>(s)]);
      // Of two strays the later one finds the pair.
      if (row == n || (is_stray[n] != 0 && n < row)) continue;
      if (comes_near(row, n)) {
        found[b].push_back(in_order(static_cast<std::int32_t>(row), static_cast<std::int32_t>(n)));
      }
    }
  });

  // The new pairs by the list they belong to, without those that stand there.
  std::vector<std::vector<RowPair>> shares(chunks.size() + 1);
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  for (const auto& block : found) {
    for (const auto& [a, b] : block) {
      const std::size_t owner = std::max(a, b) >= coarse
                                    ? chunks.size()
                                    : static_cast<std::size_t>(std::min(a, b) / chunks.front().end);
      shares[owner].push_back({a, b});
    }
  }
  oneapi::tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t c) {
    auto& share = shares[c];
    if (share.empty()) return;
    OuterList& list = c < chunks.size() ? chunks[c].near_pairs : near_fine;
    std::sort(share.begin(), share.end());
    std::vector<std::uint8_t> is_listed(share.size(), 0);
    for (std::size_t q = 0; q < list.size(); ++q) {
      const RowPair pair{list.a[q], list.b[q]};
      if (pair[1] < 0) continue;  // a fine grain and a surface
      if (is_stray[static_cast<std::size_t>(pair[0])] == 0 &&
          is_stray[static_cast<std::size_t>(pair[1])] == 0) {
        continue;
      }
      const auto at = std::lower_bound(share.begin(), share.end(), pair);
      if (at != share.end() && *at == pair) {
        is_listed[static_cast<std::size_t>(at - share.begin())] = 1;
      }
    }
    for (std::size_t n = 0; n < share.size(); ++n) {
      if (is_listed[n] == 0) list.push(share[n][0], share[n][1]);
    }
    if (c < chunks.size()) {
      group_by_law(list, false);
    } else {
      list.segments.front().end = static_cast<std::int32_t>(list.size());
    }
  });
}

/// The same with surfaces.
void Dem::Impl::add_surfaces_of(std::span<const std::int32_t> strays) {
  const double left = list_time(tuner.outer_lifetime() - since_rebuild);
  std::vector<std::uint8_t> has_more(chunks.size(), 0);
  for (const std::int32_t row : strays) {
    const auto n = static_cast<std::size_t>(row);
    const bool is_coarse = n < coarse_count;
    const auto owner = static_cast<std::size_t>(is_coarse ? row / chunks.front().end : 0);
    OuterList& list = is_coarse ? chunks[owner].near_surfaces : near_fine;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (!near_surface(n, surfaces[s], left)) continue;
      const auto number = static_cast<std::int32_t>(s);
      const std::int32_t b = is_coarse ? number : -1 - number;
      bool is_listed = false;
      for (std::size_t q = 0; q < list.size() && !is_listed; ++q) {
        is_listed = list.a[q] == row && list.b[q] == b;
      }
      if (is_listed) continue;
      list.push(row, b);
      if (is_coarse) has_more[owner] = 1;
    }
  }
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    if (has_more[c] != 0) group_by_law(chunks[c].near_surfaces, true);
  }
  near_fine.segments.front().end = static_cast<std::int32_t>(near_fine.size());
}

}  // namespace dust::particles
