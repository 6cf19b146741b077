// SPDX-License-Identifier: Apache-2.0
#include "base/lanes.hpp"
#include "contact/batch_kernels.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>

/// The columns of a batch back into rows of contacts and forces.
namespace dust::contact {
using namespace lanes;

DUST_KERNEL void store_history(const PairView& pairs, const std::int32_t* contacts,
                               std::size_t count, int groups, BatchColumns& columns) {
  double* const history = pairs.history;
  const std::size_t stride = pairs.history_stride;
  const auto row_of = [&](std::size_t q) __attribute__((always_inline)) {
    return history + static_cast<std::size_t>(contacts[q]) * stride;
  };
  for (std::size_t q = 0; q < count; q += 4) {
    const double* from = columns.column(BatchColumns::first_history) + q;
    const bool is_full = q + 4 <= count;
    for (int g = 0; g < 4 * groups; g += 4, from += 4 * k_stride) {
      Lanes h[4];
      for (std::size_t l = 0; l < 4; ++l) load(from + l * k_stride, h[l]);
      transpose(h[0], h[1], h[2], h[3]);
      // Written out: in a loop of unknown length the rows would go through memory.
      if (is_full) {
        store(row_of(q) + g, h[0]), store(row_of(q + 1) + g, h[1]);
        store(row_of(q + 2) + g, h[2]), store(row_of(q + 3) + g, h[3]);
      } else {
        for (std::size_t l = 0; q + l < count; ++l) store(row_of(q + l) + g, h[l]);
      }
    }
  }
}

namespace {

/// What one pair does to its sides.
template <bool has_scales>
__attribute__((always_inline)) inline void add(const Places& place, const Lanes& f, const Lanes& ti,
                                               const Lanes& tj, double scale_i, double scale_j,
                                               double* force) {
  auto* a = reinterpret_cast<Lanes*>(force + 8 * static_cast<std::ptrdiff_t>(place.a));
  auto* b = reinterpret_cast<Lanes*>(force + 8 * static_cast<std::ptrdiff_t>(place.b));
  if constexpr (has_scales) {
    a[0] += scale_i * f, a[1] += scale_i * ti;
    b[0] -= scale_j * f, b[1] += scale_j * tj;
  } else {
    a[0] += f, a[1] += ti;
    b[0] -= f, b[1] += tj;
  }
}

template <bool has_scales, bool is_in_order>
__attribute__((always_inline)) inline void scatter(const Places* places,
                                                   const std::int32_t* contacts, std::size_t count,
                                                   BatchColumns& columns, double* force) {
  using B = BatchColumns;
  const double* const c = columns.column(0);
  const auto rows_of = [&](int name, std::size_t q, Lanes* rows) __attribute__((always_inline)) {
    for (int d = 0; d < 3; ++d)
      load(c + static_cast<std::size_t>(name + d) * k_stride + q, rows[d]);
    rows[3] = Lanes{};
    transpose(rows[0], rows[1], rows[2], rows[3]);
  };
  const double* const scale_i = c + B::scale_i * k_stride;
  const double* const scale_j = c + B::scale_j * k_stride;
  Lanes f[4];
  Lanes ti[4];
  Lanes tj[4];
  const auto add_lane = [&](std::size_t q, std::size_t l) __attribute__((always_inline)) {
    const Places& place = is_in_order ? places[q + l] : places[contacts[q + l]];
    add<has_scales>(place, f[l], ti[l], tj[l], scale_i[q + l], scale_j[q + l], force);
  };
  std::size_t q = 0;
  for (; q < count; q += 4) {
    rows_of(B::force_x, q, f);
    rows_of(B::torque_i_x, q, ti);
    rows_of(B::torque_j_x, q, tj);
    if (q + 4 > count) break;
    // Written out: in a loop the rows would go through memory.
    add_lane(q, 0), add_lane(q, 1), add_lane(q, 2), add_lane(q, 3);
  }
  for (std::size_t l = 0; q + l < count; ++l) add_lane(q, l);
}

DUST_KERNEL void scatter_alike(const Places* places, const std::int32_t* contacts,
                               std::size_t count, BatchColumns& columns, double* force) {
  scatter<false, false>(places, contacts, count, columns, force);
}
DUST_KERNEL void scatter_in_order(const Places* places, std::size_t count, BatchColumns& columns,
                                  double* force) {
  scatter<false, true>(places, nullptr, count, columns, force);
}
DUST_KERNEL void scatter_weighted_in_order(const Places* places, std::size_t count,
                                           BatchColumns& columns, double* force) {
  scatter<true, true>(places, nullptr, count, columns, force);
}
DUST_KERNEL void scatter_weighted(const Places* places, const std::int32_t* contacts,
                                  std::size_t count, BatchColumns& columns, double* force) {
  scatter<true, false>(places, contacts, count, columns, force);
}

}  // namespace

void scatter_pairs(const Places* places, const std::int32_t* contacts, std::size_t count,
                   bool has_scales, BatchColumns& columns, double* force) {
  (has_scales ? scatter_weighted : scatter_alike)(places, contacts, count, columns, force);
}

void scatter_pairs(const Places* places, std::size_t count, bool has_scales, BatchColumns& columns,
                   double* force) {
  (has_scales ? scatter_weighted_in_order : scatter_in_order)(places, count, columns, force);
}

void scatter_single(const std::int32_t* local_rows, std::size_t count, BatchColumns& columns,
                    double* force) {
  using B = BatchColumns;
  for (std::size_t q = 0; q < count; ++q) {
    double* f = force + 8 * static_cast<std::size_t>(local_rows[q]);
    for (int d = 0; d < 3; ++d) {
      f[d] += columns.column(B::force_x + d)[q];
      f[4 + d] += columns.column(B::torque_i_x + d)[q];
    }
  }
}

}  // namespace dust::contact
