// SPDX-License-Identifier: Apache-2.0
#include "particles/search.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace dust::particles {
namespace {

constexpr std::uint64_t k_empty = ~std::uint64_t{0};
constexpr int k_bits = 21;
constexpr std::int64_t k_offset = std::int64_t{1} << (k_bits - 1);

struct Slot {
  std::uint64_t key = k_empty;
  std::int32_t begin = 0;
  std::int32_t count = 0;
};

/// Grains of one size level in cells of one edge, in a table of open addresses. A grain's ball
/// holds all places it may be at until the horizon: its centre is the middle of the straight path.
class Level {
 public:
  /// Per row the centre of the ball and its radius.
  Level(const SearchInput& in, const std::vector<std::int32_t>& rows,
        const std::vector<double>& centre, const std::vector<double>& reach) {
    for (const std::int32_t row : rows) {
      reach_ = std::max(reach_, reach[static_cast<std::size_t>(row)]);
    }
    const double edge = std::max({2.0 * reach_, in.smallest_edge, 1e-12});
    for (int d = 0; d < 3; ++d) {
      origin_[d] = in.origin[d];
      cells_[d] = in.period[d] > 0.0
                      ? std::max<std::int64_t>(1, static_cast<std::int64_t>(in.period[d] / edge))
                      : 0;
      inverse_[d] = cells_[d] > 0 ? static_cast<double>(cells_[d]) / in.period[d] : 1.0 / edge;
    }
    const std::size_t size = std::bit_ceil(2 * rows.size() + 8);
    shift_ = 64 - std::countr_zero(size);
    slots_.resize(size);
    std::vector<std::int32_t> slot_of(rows.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const double* p = centre.data() + 3 * static_cast<std::ptrdiff_t>(rows[n]);
      const std::uint64_t k =
          key(wrap(cell(p[0], 0), 0), wrap(cell(p[1], 1), 1), wrap(cell(p[2], 2), 2));
      std::size_t s = hash(k);
      while (slots_[s].key != k_empty && slots_[s].key != k) s = (s + 1) & (size - 1);
      slots_[s].key = k;
      ++slots_[s].count;
      slot_of[n] = static_cast<std::int32_t>(s);
    }
    std::int32_t begin = 0;
    for (Slot& s : slots_) {
      s.begin = begin;
      begin += s.count;
      s.count = 0;
    }
    rows_.resize(rows.size());
    balls_.resize(4 * rows.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
      Slot& s = slots_[static_cast<std::size_t>(slot_of[n])];
      const auto to = static_cast<std::size_t>(s.begin + s.count++);
      rows_[to] = rows[n];
      std::copy_n(centre.data() + 3 * static_cast<std::ptrdiff_t>(rows[n]), 3, &balls_[4 * to]);
      balls_[4 * to + 3] = reach[static_cast<std::size_t>(rows[n])];
    }
    for (int d = 0; d < 3; ++d) period_[d] = in.period[d];
    is_periodic_ = period_[0] + period_[1] + period_[2] > 0.0;
  }

  static double reach_of(const SearchInput& in, std::int32_t row) {
    const double* p = in.position + 4 * static_cast<std::ptrdiff_t>(row);
    const double* v = in.velocity + 4 * static_cast<std::ptrdiff_t>(row);
    return p[3] + in.allowance[4 * static_cast<std::ptrdiff_t>(row) + 3] + 0.5 * in.range +
           0.5 * in.horizon * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }

  /// Calls visit(row) for every grain whose ball of reach overlaps that of `p`.
  template <class Visit>
  void near(const double* p, double reach, Visit&& visit) const {
    const double half = reach + reach_;
    std::int64_t low[3];
    std::int64_t high[3];
    for (int d = 0; d < 3; ++d) {
      low[d] = cell(p[d] - half, d);
      high[d] = cell(p[d] + half, d);
      // Once round a periodic side is enough.
      if (cells_[d] > 0) high[d] = std::min(high[d], low[d] + cells_[d] - 1);
    }
    const double boxes = static_cast<double>(high[0] - low[0] + 1) *
                         static_cast<double>(high[1] - low[1] + 1) *
                         static_cast<double>(high[2] - low[2] + 1);
    if (boxes > static_cast<double>(slots_.size())) {
      visit_close(p, reach, 0, rows_.size(), visit);
      return;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          const std::uint64_t k = key(wrap(x, 0), wrap(y, 1), wrap(z, 2));
          std::size_t s = hash(k);
          while (slots_[s].key != k_empty && slots_[s].key != k) s = (s + 1) & (slots_.size() - 1);
          if (slots_[s].key == k_empty) continue;
          const auto begin = static_cast<std::size_t>(slots_[s].begin);
          visit_close(p, reach, begin, begin + static_cast<std::size_t>(slots_[s].count), visit);
        }
      }
    }
  }

 private:
  template <class Visit>
  void visit_close(const double* p, double reach, std::size_t begin, std::size_t end,
                   Visit&& visit) const {
    for (std::size_t n = begin; n < end; ++n) {
      const double* ball = &balls_[4 * n];
      double apart[3] = {ball[0] - p[0], ball[1] - p[1], ball[2] - p[2]};
      if (is_periodic_) {
        for (int d = 0; d < 3; ++d) {
          if (apart[d] > 0.5 * period_[d]) apart[d] -= period_[d];
          if (apart[d] < -0.5 * period_[d]) apart[d] += period_[d];
        }
      }
      const double limit = reach + ball[3];
      if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < limit * limit) {
        visit(rows_[n]);
      }
    }
  }
  [[nodiscard]] std::int64_t cell(double x, int d) const {
    return static_cast<std::int64_t>(std::floor((x - origin_[d]) * inverse_[d]));
  }
  [[nodiscard]] std::int64_t wrap(std::int64_t c, int d) const {
    if (cells_[d] == 0) return c;
    const std::int64_t m = c % cells_[d];
    return m < 0 ? m + cells_[d] : m;
  }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::int64_t mask = (std::int64_t{1} << k_bits) - 1;
    return static_cast<std::uint64_t>((((z + k_offset) & mask) << (2 * k_bits)) |
                                      (((y + k_offset) & mask) << k_bits) |
                                      ((x + k_offset) & mask));
  }
  [[nodiscard]] std::size_t hash(std::uint64_t k) const {
    return static_cast<std::size_t>((k * 0x9E3779B97F4A7C15ull) >> shift_);
  }

  double reach_ = 0.0;
  double origin_[3] = {0, 0, 0};
  double inverse_[3] = {1, 1, 1};
  std::int64_t cells_[3] = {0, 0, 0};
  int shift_ = 0;
  std::vector<Slot> slots_;
  std::vector<std::int32_t> rows_;
  std::vector<double> balls_;  ///< by place in rows_: centre and reach, side by side
  double period_[3] = {0, 0, 0};
  bool is_periodic_ = false;
};

/// Square of the closest distance two grains come to within the horizon, going straight on.
double closest_squared(const SearchInput& in, std::int32_t i, std::int32_t j) {
  const double* pi = in.position + 4 * static_cast<std::ptrdiff_t>(i);
  const double* pj = in.position + 4 * static_cast<std::ptrdiff_t>(j);
  const double* vi = in.velocity + 4 * static_cast<std::ptrdiff_t>(i);
  const double* vj = in.velocity + 4 * static_cast<std::ptrdiff_t>(j);
  double x[3];
  double v[3];
  double xv = 0.0;
  double vv = 0.0;
  for (int d = 0; d < 3; ++d) {
    x[d] = pi[d] - pj[d];
    if (in.period[d] > 0.0) {
      if (x[d] > 0.5 * in.period[d]) x[d] -= in.period[d];
      if (x[d] < -0.5 * in.period[d]) x[d] += in.period[d];
    }
    v[d] = vi[d] - vj[d];
    xv += x[d] * v[d];
    vv += v[d] * v[d];
  }
  const double t = std::clamp(-xv / std::max(vv, 1e-300), 0.0, in.horizon);
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double closest = x[d] + t * v[d];
    sum += closest * closest;
  }
  return sum;
}

}  // namespace

std::vector<std::vector<RowPair>> search_pairs(const SearchInput& in, std::size_t block) {
  double largest = 0.0;
  for (std::size_t n = 0; n < in.count; ++n) largest = std::max(largest, in.position[4 * n + 3]);
  // Level l holds radii in [largest / 2^(l+1), largest / 2^l); the very bound goes to the coarser.
  std::vector<std::vector<std::int32_t>> members;
  std::vector<std::int32_t> level_of(in.count);
  for (std::size_t n = 0; n < in.count; ++n) {
    const double ratio = largest / in.position[4 * n + 3];
    const int level = std::max(0, static_cast<int>(std::ceil(std::log2(ratio) - 1e-9)) - 1);
    if (members.size() <= static_cast<std::size_t>(level))
      members.resize(static_cast<std::size_t>(level) + 1);
    members[static_cast<std::size_t>(level)].push_back(static_cast<std::int32_t>(n));
    level_of[n] = level;
  }
  std::vector<double> reach_of(in.count);
  std::vector<double> centre_of(3 * in.count);
  for (std::size_t n = 0; n < in.count; ++n) {
    reach_of[n] = Level::reach_of(in, static_cast<std::int32_t>(n));
    for (std::size_t d = 0; d < 3; ++d) {
      centre_of[3 * n + d] = in.position[4 * n + d] + 0.5 * in.horizon * in.velocity[4 * n + d];
    }
  }
  std::vector<Level> levels;
  for (const auto& rows : members) levels.emplace_back(in, rows, centre_of, reach_of);

  const std::size_t blocks = (in.count + block - 1) / block;
  std::vector<std::vector<RowPair>> found(blocks);
  const auto work = [&](std::size_t b) {
    auto& out = found[b];
    const std::size_t end = std::min(in.count, (b + 1) * block);
    for (std::size_t n = b * block; n < end; ++n) {
      const auto i = static_cast<std::int32_t>(n);
      const double* p = centre_of.data() + 3 * n;
      const double own = in.position[4 * n + 3] + in.allowance[4 * n + 3] + in.range;
      const double reach = reach_of[n];
      const std::int32_t own_level = level_of[n];
      for (std::int32_t l = 0; l <= own_level; ++l) {
        if (members[static_cast<std::size_t>(l)].empty()) continue;
        const bool is_own = l == own_level;
        levels[static_cast<std::size_t>(l)].near(p, reach, [&](std::int32_t j) {
          if (is_own && j <= i) return;
          const std::ptrdiff_t m = 4 * static_cast<std::ptrdiff_t>(j);
          const double limit = own + in.position[m + 3] + in.allowance[m + 3];
          if (closest_squared(in, i, j) < limit * limit) out.emplace_back(i, j);
        });
      }
    }
  };
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, work);
  return found;
}

}  // namespace dust::particles
