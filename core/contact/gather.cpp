// SPDX-License-Identifier: Apache-2.0
#include "base/lanes.hpp"
#include "contact/standing.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

/// Rows of grains and contacts into the columns of a batch.
namespace dust::contact {
using namespace lanes;

namespace {

/// Entries ahead whose rows are fetched; measured flat between 32 and 128.
constexpr std::size_t k_ahead = 48;

constexpr LaneMask k_bits{1, 2, 4, 8};
/// For every choice of four lanes, a byte of one for each lane chosen.
constexpr std::uint32_t k_bytes[16] = {
    0x0,       0x1,       0x100,     0x101,     0x10000,   0x10001,   0x10100,   0x10101,
    0x1000000, 0x1000001, 0x1000100, 0x1000101, 0x1010000, 0x1010001, 0x1010100, 0x1010101};
/// For every choice of four lanes, the chosen ones in order, then anything.
constexpr LaneMask k_pack[16] = {{0, 1, 2, 3}, {0, 1, 2, 3}, {1, 0, 2, 3}, {0, 1, 2, 3},
                                 {2, 0, 1, 3}, {0, 2, 1, 3}, {1, 2, 0, 3}, {0, 1, 2, 3},
                                 {3, 0, 1, 2}, {0, 3, 1, 2}, {1, 3, 0, 2}, {0, 1, 3, 2},
                                 {2, 3, 0, 1}, {0, 2, 3, 1}, {1, 2, 3, 0}, {0, 1, 2, 3}};
typedef std::int32_t Numbers __attribute__((vector_size(16)));

/// Brings a grain's rows into the second level of the cache: in the first they would take the
/// places of what is at work (decision 0020).
__attribute__((always_inline)) inline void expect(const RowView& rows, std::int32_t grain) {
  const auto row = static_cast<std::size_t>(grain);
  __builtin_prefetch(rows.position + 4 * row, 0, 2);
  __builtin_prefetch(rows.motion + k_motion_stride * row, 0, 2);
  __builtin_prefetch(rows.spin + k_motion_stride * row, 0, 2);
}

/// Separations of four pairs.
template <bool is_periodic>
class Separation {
 public:
  __attribute__((always_inline)) explicit Separation(const Images& images)
      : length_{images.length[0], images.length[1], images.length[2], 0.0},
        half_{images.half[0], images.half[1], images.half[2], HUGE_VAL} {}

  /// Into the columns x; returns a bit for each pair that is closer than touch + `range` [m].
  __attribute__((always_inline)) unsigned operator()(const double* position, const std::int32_t* a,
                                                     const std::int32_t* b, double range,
                                                     Lanes* x) const {
    // x, y, z become differences, the fourth column the sum of the radii.
    const Lanes sign{-1.0, -1.0, -1.0, 1.0};
    for (int l = 0; l < 4; ++l) {
      x[l] = row(position, a[l]) + sign * row(position, b[l]);
      if constexpr (is_periodic) fold(x[l], length_, half_);
    }
    transpose(x[0], x[1], x[2], x[3]);
    const Lanes reach = x[3] + range;
    const LaneMask near = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < reach * reach) & k_bits;
    return static_cast<unsigned>(near[0] | near[1] | near[2] | near[3]);
  }

 private:
  const Lanes length_, half_;
};

/// The columns of a search for near pairs: copies, because the bytes of is_touching may alias
/// whatever stands in memory.
struct PairSearch {
  const double* position;
  const double* motion;
  const double* spin;
  const std::int32_t* a;
  const std::int32_t* b;
  std::uint8_t* is_touching;
  double* history;
  std::size_t history_stride;

  __attribute__((always_inline)) PairSearch(const RowView& rows, const PairView& pairs)
      : position(rows.position),
        motion(rows.motion),
        spin(rows.spin),
        a(pairs.a),
        b(pairs.b),
        is_touching(pairs.is_touching),
        history(pairs.history),
        history_stride(pairs.history_stride) {}

  /// Brings near what the four pairs from `later` on want, while those from `p` on are at work.
  __attribute__((always_inline)) void expect_pairs(const RowView& rows, std::size_t later,
                                                   std::size_t p) const {
    for (std::size_t l = 0; l < 4; ++l) {
      expect(rows, a[later + l]);
      const auto ahead = static_cast<std::size_t>(b[later + l]);
      __builtin_prefetch(position + 4 * ahead);
      __builtin_prefetch(motion + k_motion_stride * ahead);
      __builtin_prefetch(spin + k_motion_stride * ahead);
      // Most that touch have touched before; of the others the history is not wanted.
      const std::size_t entry = later + l;
      __builtin_prefetch(history + (is_touching[entry] != 0 ? entry : p) * history_stride, 1);
    }
  }

  /// Notes which of the `lanes` pairs from p on touch (bits of `touch`); the history of one that
  /// has parted is cleared.
  __attribute__((always_inline)) void note_touch(std::size_t p, std::size_t lanes,
                                                 unsigned touch) const {
    std::uint32_t before = 0;
    const std::uint32_t now = k_bytes[touch];
    std::memcpy(&before, is_touching + p, lanes);
    std::memcpy(is_touching + p, &now, lanes);
    if ((before & ~now) != 0) [[unlikely]] {
      for (std::size_t l = 0; l < lanes; ++l) {
        if ((touch >> l & 1u) != 0) continue;
        std::memset(history + (p + l) * history_stride, 0, history_stride * sizeof(double));
      }
    }
  }
};

/// The pairs from `next` on that are near enough, until a batch is full: their separations and
/// numbers. Brings near what the contacts further on want. Looks at positions alone: many of a
/// list's pairs do not touch, and their velocities would be loaded for nothing.
template <bool is_periodic>
__attribute__((always_inline)) inline std::size_t find_near(const GatherInput& in,
                                                            std::size_t& next, std::size_t end,
                                                            std::int32_t* contacts,
                                                            BatchColumns& columns) {
  using B = BatchColumns;
  const PairView& pairs = in.pairs;
  const PairSearch search(in.rows, pairs);
  const double range = in.range;
  const std::size_t last_four = pairs.count < 4 ? 0 : pairs.count - 4;
  double* const separation_x = columns.column(B::separation_x);
  double* const separation_y = columns.column(B::separation_y);
  double* const separation_z = columns.column(B::separation_z);
  const Separation<is_periodic> separate(in.images);
  std::size_t found = 0;
  const auto look_at = [&](std::size_t p, const std::int32_t* a, const std::int32_t* b,
                           std::size_t lanes) __attribute__((always_inline)) {
    Lanes x[4];
    const unsigned touch = separate(search.position, a, b, range, x) & ((1u << lanes) - 1u);
    search.note_touch(p, lanes, touch);
    // Those in touch to the front; what is written beyond them is overwritten by the next.
    const LaneMask pack = k_pack[touch];
    for (int d = 0; d < 3; ++d) permute(x[d], pack, x[d]);
    store(separation_x + found, x[0]);
    store(separation_y + found, x[1]);
    store(separation_z + found, x[2]);
    const Numbers numbers = __builtin_convertvector(pack, Numbers) + static_cast<std::int32_t>(p);
    std::memcpy(contacts + found, &numbers, sizeof numbers);
    found += static_cast<std::size_t>(__builtin_popcount(touch));
  };
  std::size_t p = next;
  for (; p + 4 <= end && found + 4 <= k_batch; p += 4) {
    search.expect_pairs(in.rows, std::min(p + k_ahead, last_four), p);
    look_at(p, search.a + p, search.b + p, 4);
  }
  if (p < end && p + 4 > end && found + 4 <= k_batch) {
    std::int32_t a[4];
    std::int32_t b[4];
    for (std::size_t l = 0; l < 4; ++l) {
      a[l] = search.a[std::min(p + l, end - 1)];
      b[l] = search.b[std::min(p + l, end - 1)];
    }
    look_at(p, a, b, end - p);
    p = end;
  }
  next = p;
  return found;
}

__attribute__((always_inline)) inline void load_columns(const double* rows, const std::int32_t* n,
                                                        Lanes* column) {
  const auto row = [&](int l) { return rows + k_motion_stride * static_cast<std::size_t>(n[l]); };
  columns_of(row(0), row(1), row(2), row(3), column);
}

/// What pairs a[0..4), b[0..4) want besides the separation, into the columns from q on.
__attribute__((always_inline)) inline void load_motion(const RowView& rows, const std::int32_t* a,
                                                       const std::int32_t* b, std::size_t q,
                                                       double* columns) {
  using B = BatchColumns;
  const auto put = [&](int name, const Lanes& value) __attribute__((always_inline)) {
    store(columns + static_cast<std::size_t>(name) * k_stride + q, value);
  };
  Lanes i[4];
  Lanes j[4];
  load_columns(rows.motion, a, i);
  load_columns(rows.motion, b, j);
  for (int d = 0; d < 3; ++d) put(B::velocity_x + d, i[d] - j[d]);
  put(B::inverse_mass_i, i[3]);
  put(B::inverse_mass_j, j[3]);
  load_columns(rows.spin, a, i);
  load_columns(rows.spin, b, j);
  for (int d = 0; d < 3; ++d) {
    put(B::rotation_i_x + d, i[d]);
    put(B::rotation_j_x + d, j[d]);
  }
  put(B::radius_i, i[3]);
  put(B::radius_j, j[3]);
  // Ways and angles since the last step: half velocities times twice their lag, which is zero for a
  // grain that has just come; docs/theory/grains.md, eq. (4).
  load_columns(rows.motion + 4, a, i);
  load_columns(rows.motion + 4, b, j);
  const Lanes time_i = i[3] + i[3];
  const Lanes time_j = j[3] + j[3];
  for (int d = 0; d < 3; ++d) put(B::displacement_x + d, i[d] * time_i - j[d] * time_j);
  load_columns(rows.spin + 4, a, i);
  load_columns(rows.spin + 4, b, j);
  for (int d = 0; d < 3; ++d) {
    put(B::angle_i_x + d, i[d] * time_i);
    put(B::angle_j_x + d, j[d] * time_j);
  }
}

/// The same for the contacts found; the columns are filled up to the padded count with the last
/// contact.
__attribute__((always_inline)) inline void load_motions(const RowView& rows, const PairView& pairs,
                                                        std::int32_t* contacts, std::size_t found,
                                                        BatchColumns& columns) {
  using B = BatchColumns;
  double* const c = columns.column(0);
  const std::size_t last = found - 1;
  for (std::size_t q = found; q < padded(found); ++q) {
    contacts[q] = contacts[last];
    for (int d = 0; d < 3; ++d) {
      c[static_cast<std::size_t>(B::separation_x + d) * k_stride + q] =
          c[static_cast<std::size_t>(B::separation_x + d) * k_stride + last];
    }
  }
  for (std::size_t q = 0; q < padded(found); q += 4) {
    std::int32_t a[4];
    std::int32_t b[4];
    for (std::size_t l = 0; l < 4; ++l) {
      a[l] = pairs.a[contacts[q + l]];
      b[l] = pairs.b[contacts[q + l]];
    }
    load_motion(rows, a, b, q, c);
  }
}

template <bool is_periodic>
__attribute__((always_inline)) inline std::size_t load_persistent(const GatherInput& in,
                                                                  std::size_t first,
                                                                  std::size_t count,
                                                                  BatchColumns& columns) {
  using B = BatchColumns;
  // Copies: the bytes of is_touching may alias whatever stands in memory.
  const RowView r = in.rows;
  const PairView pairs = in.pairs;
  const double range = in.range;
  const std::int32_t* const pa = pairs.a + first;
  const std::int32_t* const pb = pairs.b + first;
  std::uint8_t* const is_touching = pairs.is_touching + first;
  const std::size_t last_four = pairs.count - first - 4;
  double* const c = columns.column(0);
  const Separation<is_periodic> separate(in.images);
  std::size_t near = 0;
  for (std::size_t q = 0; q < count; q += 4) {
    const std::size_t later = std::min(q + k_ahead, last_four);
    for (std::size_t l = 0; l < 4; ++l) {
      expect(r, pa[later + l]);
      expect(r, pb[later + l]);
      __builtin_prefetch(pairs.history + (first + q + l) * pairs.history_stride, 0, 2);
    }
    Lanes x[4];
    const unsigned touch = separate(r.position, pa + q, pb + q, range, x);
    std::memcpy(is_touching + q, &k_bytes[touch], 4);
    near += static_cast<std::size_t>(__builtin_popcount(touch));
    for (int d = 0; d < 3; ++d) {
      store(c + static_cast<std::size_t>(B::separation_x + d) * k_stride + q, x[d]);
    }
    load_motion(r, pa + q, pb + q, q, c);
  }
  return near;
}

DUST_KERNEL std::size_t persistent_open(const GatherInput& in, std::size_t first, std::size_t count,
                                        BatchColumns& columns) {
  return load_persistent<false>(in, first, count, columns);
}
DUST_KERNEL std::size_t persistent_periodic(const GatherInput& in, std::size_t first,
                                            std::size_t count, BatchColumns& columns) {
  return load_persistent<true>(in, first, count, columns);
}

[[nodiscard]] bool has_images(const Images& images) {
  return images.length[0] + images.length[1] + images.length[2] > 0.0;
}

template <bool is_periodic>
__attribute__((always_inline)) inline std::size_t gather(const GatherInput& in, std::size_t& next,
                                                         std::size_t end, std::int32_t* contacts,
                                                         BatchColumns& columns) {
  const std::size_t found = find_near<is_periodic>(in, next, end, contacts, columns);
  if (found > 0) load_motions(in.rows, in.pairs, contacts, found, columns);
  return found;
}

// A box without periodic sides need not look for images.
DUST_KERNEL std::size_t gather_open(const GatherInput& in, std::size_t& next, std::size_t end,
                                    std::int32_t* contacts, BatchColumns& columns) {
  return gather<false>(in, next, end, contacts, columns);
}
DUST_KERNEL std::size_t gather_periodic(const GatherInput& in, std::size_t& next, std::size_t end,
                                        std::int32_t* contacts, BatchColumns& columns) {
  return gather<true>(in, next, end, contacts, columns);
}

}  // namespace

std::size_t gather_touching(const GatherInput& in, std::size_t& next, std::size_t end,
                            std::int32_t* contacts, BatchColumns& columns) {
  return (has_images(in.images) ? gather_periodic : gather_open)(in, next, end, contacts, columns);
}

std::size_t gather_persistent(const GatherInput& in, std::size_t first, std::size_t count,
                              BatchColumns& columns) {
  return (has_images(in.images) ? persistent_periodic : persistent_open)(in, first, count, columns);
}

DUST_KERNEL void load_history(const PairView& pairs, const std::int32_t* contacts,
                              std::size_t count, int groups, BatchColumns& columns) {
  const std::size_t rounded = padded(count);
  for (std::size_t q = 0; q < rounded; q += 4) {
    const double* from[4];
    for (std::size_t l = 0; l < 4; ++l) {
      from[l] = pairs.history + static_cast<std::size_t>(contacts[std::min(q + l, count - 1)]) *
                                    pairs.history_stride;
    }
    double* to = columns.column(BatchColumns::first_history) + q;
    for (int g = 0; g < groups; ++g, to += 4 * k_stride) {
      Lanes h[4];
      columns_of(from[0] + 4 * g, from[1] + 4 * g, from[2] + 4 * g, from[3] + 4 * g, h);
      for (std::size_t l = 0; l < 4; ++l) store(to + l * k_stride, h[l]);
    }
  }
}

}  // namespace dust::contact
