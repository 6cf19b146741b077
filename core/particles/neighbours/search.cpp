// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/search.hpp"

#include "base/cells.hpp"
#include "base/lanes.hpp"
#include "base/periodic.hpp"
#include "contact/closest_approach.hpp"
#include "dust/sdk/kernel.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace dust::particles {
namespace {

constexpr std::uint64_t k_empty = ~std::uint64_t{0};
constexpr std::int64_t k_offset = std::int64_t{1} << (base::k_cell_bits - 1);
/// Cells of the box round a level's grains for each of them up to which a table of all cells is
/// made; with more, most cells are empty and only the others are kept, in a hash table.
constexpr double k_cells_per_grain = 128.0;
/// Cells of a table are counted in 32 bits.
constexpr double k_max_cells = std::numeric_limits<std::int32_t>::max();

struct Slot {
  std::uint64_t key = k_empty;
  std::int32_t begin = 0;
  std::int32_t count = 0;
};

/// Sides of the domain along which separations are folded.
struct Folding {
  double length[4] = {0.0, 0.0, 0.0, 0.0};
  double half[4] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
};

/// Appends to `found` the numbers of the balls [begin, end) that overlap `ball`, from `count` on,
/// and returns how many there are. Four at a time, without branches on what is found: half of the
/// balls looked at are near. Writes up to three numbers beyond.
template <bool is_periodic>
__attribute__((always_inline)) inline std::size_t take_close(const Ball* balls, std::size_t begin,
                                                             std::size_t end, const Ball& ball,
                                                             const Folding& folding,
                                                             std::int32_t* found,
                                                             std::size_t count) {
  constexpr lanes::LaneMask k_bits{1, 2, 4, 8};
  // x, y, z become differences, the fourth column the sum of the reaches.
  const lanes::Lanes middle{-ball.x, -ball.y, -ball.z, ball.reach};
  lanes::Lanes length;
  lanes::Lanes half;
  lanes::load(folding.length, length);
  lanes::load(folding.half, half);
  for (std::size_t n = begin; n < end; n += 4) {
    lanes::Lanes x[4];
    for (std::size_t l = 0; l < 4; ++l) {
      lanes::load(&balls[std::min(n + l, end - 1)].x, x[l]);
      x[l] += middle;
      if constexpr (is_periodic) lanes::fold(x[l], length, half);
    }
    lanes::transpose(x[0], x[1], x[2], x[3]);
    const lanes::LaneMask near = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < x[3] * x[3]) & k_bits;
    const auto bits = static_cast<unsigned>(near[0] | near[1] | near[2] | near[3]) &
                      (end - n < 4 ? (1u << (end - n)) - 1u : 15u);
    for (unsigned l = 0; l < 4; ++l) {
      found[count] = static_cast<std::int32_t>(n + l);
      count += bits >> l & 1u;
    }
  }
  return count;
}
DUST_KERNEL std::size_t take_close_open(const Ball* balls, std::size_t begin, std::size_t end,
                                        const Ball& ball, const Folding& folding,
                                        std::int32_t* found, std::size_t count) {
  return take_close<false>(balls, begin, end, ball, folding, found, count);
}
DUST_KERNEL std::size_t take_close_periodic(const Ball* balls, std::size_t begin, std::size_t end,
                                            const Ball& ball, const Folding& folding,
                                            std::int32_t* found, std::size_t count) {
  return take_close<true>(balls, begin, end, ball, folding, found, count);
}

/// Grains of one size level, ordered by cells of one edge. Cells of a row along x stand side by
/// side where there is a table of all of them.
class Level {
 public:
  Level(const SearchInput& in, const std::vector<std::int32_t>& rows,
        const std::vector<Ball>& balls) {
    if (rows.empty()) return;
    for (const std::int32_t row : rows) {
      reach_ = std::max(reach_, balls[static_cast<std::size_t>(row)].reach);
    }
    const double edge = std::max(2.0 * reach_, 1e-12);
    lay_out(in, rows, balls, edge);
    std::vector<std::int32_t> cell_of(rows.size());
    is_table_ = static_cast<double>(count_[0]) * static_cast<double>(count_[1]) *
                    static_cast<double>(count_[2]) <=
                std::min(k_cells_per_grain * static_cast<double>(rows.size()), k_max_cells);
    if (is_table_) {
      fill_table(rows, balls, cell_of);
    } else {
      fill_slots(rows, balls, cell_of);
    }
    for (int d = 0; d < 3; ++d) {
      if (!(in.period[d] > 0.0)) continue;
      folding_.length[d] = in.period[d];
      folding_.half[d] = 0.5 * in.period[d];
      is_periodic_ = true;
    }
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::int32_t row(std::size_t place) const { return rows_[place]; }
  [[nodiscard]] const Ball& ball(std::size_t place) const { return balls_[place]; }

  /// Writes the places from `first` on whose balls overlap `ball`, each once, and returns how many.
  std::size_t near(const Ball& ball, std::size_t first, std::vector<std::int32_t>& found) const {
    std::size_t count = 0;
    const auto look = [&](std::size_t begin, std::size_t end) {
      begin = std::max(begin, first);
      if (begin >= end) return;
      const std::size_t most = count + (end - begin) + 3;
      if (found.size() < most) found.resize(2 * most);
      count = (is_periodic_ ? take_close_periodic : take_close_open)(
          balls_.data(), begin, end, ball, folding_, found.data(), count);
    };
    const double half = ball.reach + reach_;
    const double centre[3] = {ball.x, ball.y, ball.z};
    std::int64_t low[3];
    std::int64_t high[3];
    for (int d = 0; d < 3; ++d) {
      low[d] = cell(centre[d] - half, d);
      high[d] = cell(centre[d] + half, d);
      if (wraps_[d]) {
        // Once round a periodic side is enough.
        high[d] = std::min(high[d], low[d] + count_[d] - 1);
      } else {
        low[d] = std::max<std::int64_t>(low[d], 0);
        high[d] = std::min(high[d], count_[d] - 1);
      }
    }
    if (is_table_) {
      in_table(low, high, look);
    } else {
      in_slots(low, high, look);
    }
    return count;
  }

 private:
  /// The cells: all of a periodic side, else of the box round the balls' centres.
  void lay_out(const SearchInput& in, const std::vector<std::int32_t>& rows,
               const std::vector<Ball>& balls, double edge) {
    std::array<double, 3> low;
    std::array<double, 3> high;
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    for (const std::int32_t row : rows) {
      const Ball& b = balls[static_cast<std::size_t>(row)];
      const double centre[3] = {b.x, b.y, b.z};
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], centre[d]);
        high[d] = std::max(high[d], centre[d]);
      }
    }
    for (std::size_t d = 0; d < 3; ++d) {
      wraps_[d] = in.period[d] > 0.0;
      origin_[d] = wraps_[d] ? in.origin[d] : low[d];
      if (wraps_[d]) {
        count_[d] = std::max<std::int64_t>(1, static_cast<std::int64_t>(in.period[d] / edge));
        inverse_[d] = static_cast<double>(count_[d]) / in.period[d];
      } else {
        inverse_[d] = 1.0 / edge;
        count_[d] = cell(high[d], static_cast<int>(d)) + 1;
      }
    }
  }

  void fill_table(const std::vector<std::int32_t>& rows, const std::vector<Ball>& balls,
                  std::vector<std::int32_t>& cell_of) {
    begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const Ball& b = balls[static_cast<std::size_t>(rows[n])];
      const std::int64_t c =
          index(wrap(cell(b.x, 0), 0), wrap(cell(b.y, 1), 1), wrap(cell(b.z, 2), 2));
      cell_of[n] = static_cast<std::int32_t>(c);
      ++begin_[static_cast<std::size_t>(c) + 1];
    }
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    place(rows, balls, [&](std::size_t n) {
      return static_cast<std::size_t>(next[static_cast<std::size_t>(cell_of[n])]++);
    });
  }

  void fill_slots(const std::vector<std::int32_t>& rows, const std::vector<Ball>& balls,
                  std::vector<std::int32_t>& slot_of) {
    const std::size_t size = std::bit_ceil(2 * rows.size() + 8);
    shift_ = 64 - std::countr_zero(size);
    slots_.resize(size);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const Ball& b = balls[static_cast<std::size_t>(rows[n])];
      const std::uint64_t k =
          key(wrap(cell(b.x, 0), 0), wrap(cell(b.y, 1), 1), wrap(cell(b.z, 2), 2));
      const std::size_t s = slot(k);
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
    place(rows, balls, [&](std::size_t n) {
      Slot& s = slots_[static_cast<std::size_t>(slot_of[n])];
      return static_cast<std::size_t>(s.begin + s.count++);
    });
  }

  template <class Place>
  void place(const std::vector<std::int32_t>& rows, const std::vector<Ball>& balls,
             Place&& place_of) {
    rows_.resize(rows.size());
    balls_.resize(rows.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const std::size_t to = place_of(n);
      rows_[to] = rows[n];
      balls_[to] = balls[static_cast<std::size_t>(rows[n])];
    }
  }

  template <class Look>
  void in_table(const std::int64_t* low, const std::int64_t* high, Look&& look) const {
    const std::int64_t first = wrap(low[0], 0);
    const std::int64_t last = first + high[0] - low[0];
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        const std::int64_t row = index(0, wrap(y, 1), wrap(z, 2));
        const auto cells = [&](std::int64_t from, std::int64_t to) {
          if (from > to) return;
          look(static_cast<std::size_t>(begin_[static_cast<std::size_t>(row + from)]),
               static_cast<std::size_t>(begin_[static_cast<std::size_t>(row + to) + 1]));
        };
        cells(first, std::min(last, count_[0] - 1));
        if (last >= count_[0]) cells(0, last - count_[0]);
      }
    }
  }

  template <class Look>
  void in_slots(const std::int64_t* low, const std::int64_t* high, Look&& look) const {
    double boxes = 1.0;
    for (int d = 0; d < 3; ++d) boxes *= static_cast<double>(high[d] - low[d] + 1);
    if (boxes > static_cast<double>(slots_.size())) {
      look(0, rows_.size());
      return;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          const Slot& s = slots_[slot(key(wrap(x, 0), wrap(y, 1), wrap(z, 2)))];
          const auto begin = static_cast<std::size_t>(s.begin);
          look(begin, begin + static_cast<std::size_t>(s.count));
        }
      }
    }
  }

  [[nodiscard]] std::int64_t cell(double x, int d) const {
    return base::cell_index((x - origin_[d]) * inverse_[d]);
  }
  [[nodiscard]] std::int64_t wrap(std::int64_t c, int d) const {
    return wraps_[d] ? base::wrapped_cell(c, count_[d]) : c;
  }
  [[nodiscard]] std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (z * count_[1] + y) * count_[0] + x;
  }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    // The offset orders the slots: results depend on it.
    return base::cell_key(x + k_offset, y + k_offset, z + k_offset);
  }
  /// Where a key stands, or the empty slot it would take.
  [[nodiscard]] std::size_t slot(std::uint64_t k) const {
    auto s = static_cast<std::size_t>(base::spread_key(k) >> shift_);
    while (slots_[s].key != k_empty && slots_[s].key != k) s = (s + 1) & (slots_.size() - 1);
    return s;
  }

  double reach_ = 0.0;
  double origin_[3] = {0, 0, 0};
  double inverse_[3] = {1, 1, 1};
  std::int64_t count_[3] = {1, 1, 1};
  bool wraps_[3] = {false, false, false};
  bool is_table_ = false;
  std::vector<std::int32_t> begin_;  ///< places of a cell's grains, and the end
  int shift_ = 0;
  std::vector<Slot> slots_;
  std::vector<std::int32_t> rows_;  ///< by place
  std::vector<Ball> balls_;
  Folding folding_;
  bool is_periodic_ = false;
};

/// Whether two grains come nearer than `limit` within the lifetime, going straight on.
bool can_approach(const SearchInput& in, std::int32_t i, std::int32_t j, double limit) {
  const double* pi = in.position + 4 * static_cast<std::ptrdiff_t>(i);
  const double* pj = in.position + 4 * static_cast<std::ptrdiff_t>(j);
  const double* vi = in.velocity + in.velocity_stride * static_cast<std::size_t>(i);
  const double* vj = in.velocity + in.velocity_stride * static_cast<std::size_t>(j);
  sdk::Vec3 x;
  sdk::Vec3 v;
  for (int d = 0; d < 3; ++d) {
    x[d] = pi[d] - pj[d];
    // Asked here: the side on which a partner is, is nothing that a processor can foretell.
    if (in.period[d] > 0.0) x[d] = base::nearest_image(x[d], in.period[d]);
    v[d] = vi[d] - vj[d];
  }
  return contact::approach_is_within(x, v, in.lifetime, limit) ||
         contact::other_image_approaches(x, v, in.period, in.lifetime, limit);
}

/// Particles by size. Level l holds radii in [largest / 2^(l+1), largest / 2^l); the very bound
/// goes to the coarser. `balls`: the swept one of each particle.
std::vector<Level> levels_of(const SearchInput& in, std::vector<Ball>& balls) {
  double largest = 0.0;
  for (std::size_t n = 0; n < in.count; ++n) largest = std::max(largest, in.radius(n));
  std::vector<std::vector<std::int32_t>> members;
  balls.resize(in.count);
  for (std::size_t n = 0; n < in.count; ++n) {
    const double* p = in.position + 4 * n;
    const double* v = in.velocity + in.velocity_stride * n;
    // ceil(log2(ratio) - 1e-9) - 1 without the logarithm.
    int exponent = 0;
    const double rest = std::frexp(largest / in.radius(n), &exponent);
    const int level = std::max(0, rest > 0.5 * (1.0 + 1e-9) ? exponent - 1 : exponent - 2);
    if (members.size() <= static_cast<std::size_t>(level))
      members.resize(static_cast<std::size_t>(level) + 1);
    members[static_cast<std::size_t>(level)].push_back(static_cast<std::int32_t>(n));
    const double way = 0.5 * in.lifetime;
    balls[n] = {p[0] + way * v[0], p[1] + way * v[1], p[2] + way * v[2],
                in.radius(n) + in.skin_of(n) + 0.5 * in.range +
                    way * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])};
  }
  std::vector<Level> levels;
  levels.reserve(members.size());
  for (const auto& rows : members) levels.emplace_back(in, rows, balls);
  return levels;
}

}  // namespace

std::vector<std::vector<RowPair>> search_pairs(const SearchInput& in, std::size_t block) {
  std::vector<Ball> balls;
  const std::vector<Level> levels = levels_of(in, balls);

  // Blocks of places, level by level.
  struct Work {
    std::size_t level, begin, end;
  };
  std::vector<Work> blocks;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    for (std::size_t begin = 0; begin < levels[l].size(); begin += block) {
      blocks.push_back({l, begin, std::min(levels[l].size(), begin + block)});
    }
  }
  std::vector<std::vector<RowPair>> found(blocks.size());
  oneapi::tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    thread_local std::vector<std::int32_t> close;
    auto& out = found[b];
    const Level& own = levels[blocks[b].level];
    for (std::size_t place = blocks[b].begin; place < blocks[b].end; ++place) {
      const std::int32_t i = own.row(place);
      const auto n = static_cast<std::size_t>(i);
      const double reach = in.radius(n) + in.skin_of(n) + in.range;
      for (std::size_t l = 0; l <= blocks[b].level; ++l) {
        // Of its own level a particle looks at those behind it: each pair is found once.
        const bool is_own = l == blocks[b].level;
        const Level& level = levels[l];
        if (level.size() == 0) continue;
        const std::size_t count = level.near(own.ball(place), is_own ? place + 1 : 0, close);
        for (std::size_t k = 0; k < count; ++k) {
          const std::int32_t j = level.row(static_cast<std::size_t>(close[k]));
          const auto m = static_cast<std::size_t>(j);
          if (can_approach(in, i, j, reach + in.radius(m) + in.skin_of(m))) {
            out.push_back({i, j});
          }
        }
      }
    }
  });
  return found;
}

}  // namespace dust::particles
