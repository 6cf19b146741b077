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
  for (std::size_t q = 0; q < count; q += 4) {
    double* to[4];
    const std::size_t lanes = std::min<std::size_t>(4, count - q);
    for (std::size_t l = 0; l < lanes; ++l) {
      to[l] = pairs.history + static_cast<std::size_t>(contacts[q + l]) * pairs.history_stride;
    }
    const double* from = columns.column(BatchColumns::first_history) + q;
    for (int g = 0; g < groups; ++g, from += 4 * k_stride) {
      Lanes h[4];
      for (std::size_t l = 0; l < 4; ++l) load(from + l * k_stride, h[l]);
      transpose(h[0], h[1], h[2], h[3]);
      for (std::size_t l = 0; l < lanes; ++l) store(to[l] + 4 * g, h[l]);
    }
  }
}

DUST_KERNEL void scatter_pairs(const PairView& pairs, const std::int32_t* contacts,
                               std::size_t count, std::int32_t first, std::int32_t size,
                               bool has_scales, BatchColumns& columns, const Guest*& guest,
                               double* force) {
  using B = BatchColumns;
  const Guest* next = guest;
  const auto limit = static_cast<std::uint32_t>(size);
  const double* scale_i = columns.column(B::scale_i);
  const double* scale_j = columns.column(B::scale_j);
  for (std::size_t q = 0; q < count; q += 4) {
    Lanes f[4] = {};
    Lanes ti[4] = {};
    Lanes tj[4] = {};
    for (int d = 0; d < 3; ++d) {
      load(columns.column(B::force_x + d) + q, f[d]);
      load(columns.column(B::torque_i_x + d) + q, ti[d]);
      load(columns.column(B::torque_j_x + d) + q, tj[d]);
    }
    transpose(f[0], f[1], f[2], f[3]);
    transpose(ti[0], ti[1], ti[2], ti[3]);
    transpose(tj[0], tj[1], tj[2], tj[3]);
    const std::size_t lanes = std::min<std::size_t>(4, count - q);
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::int32_t p = contacts[q + l];
      auto la = static_cast<std::uint32_t>(pairs.a[p] - first);
      auto lb = static_cast<std::uint32_t>(pairs.b[p] - first);
      if (std::max(la, lb) >= limit) [[unlikely]] {
        while (next->entry < p) ++next;
        (la < limit ? lb : la) = static_cast<std::uint32_t>(next->place);
      }
      auto* fa = reinterpret_cast<Lanes*>(force + 8 * static_cast<std::size_t>(la));
      auto* fb = reinterpret_cast<Lanes*>(force + 8 * static_cast<std::size_t>(lb));
      if (has_scales) {
        fa[0] += scale_i[q + l] * f[l];
        fa[1] += scale_i[q + l] * ti[l];
        fb[0] -= scale_j[q + l] * f[l];
        fb[1] += scale_j[q + l] * tj[l];
      } else {
        fa[0] += f[l];
        fa[1] += ti[l];
        fb[0] -= f[l];
        fb[1] += tj[l];
      }
    }
  }
  guest = next;
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
