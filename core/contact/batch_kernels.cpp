// SPDX-License-Identifier: Apache-2.0
#include "contact/batch_kernels.hpp"

#include "contact/lanes.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dust::contact {
namespace {

/// Entries ahead whose rows are fetched; measured flat between 32 and 128.
constexpr std::size_t k_ahead = 48;

__attribute__((always_inline)) inline const Lanes& row(const double* rows, std::int32_t n) {
  return *reinterpret_cast<const Lanes*>(rows + 4 * static_cast<std::ptrdiff_t>(n));
}
__attribute__((always_inline)) inline void store(double* column, const Lanes& v) {
  std::memcpy(column, &v, sizeof v);
}
__attribute__((always_inline)) inline void fold(Lanes& d, const Lanes& length, const Lanes& half) {
  const LaneMask above = d > half;
  const LaneMask below = d < -half;
  d = above ? d - length : (below ? d + length : d);
}

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

}  // namespace

sdk::ContactBatch BatchColumns::view(std::size_t count, double time_step,
                                     int first_history_column) {
  sdk::ContactBatch b;
  b.count = padded(count);
  b.time_step = time_step;
  b.overlap = column(overlap);
  b.normal_x = column(normal_x);
  b.normal_y = column(normal_y);
  b.normal_z = column(normal_z);
  b.velocity_x = column(velocity_x);
  b.velocity_y = column(velocity_y);
  b.velocity_z = column(velocity_z);
  b.rotation_x = column(rotation_x);
  b.rotation_y = column(rotation_y);
  b.rotation_z = column(rotation_z);
  b.effective_radius = column(effective_radius);
  b.effective_mass = column(effective_mass);
  b.normal_force = column(normal_force);
  b.normal_stiffness = column(normal_stiffness);
  b.tangential_stiffness = column(tangential_stiffness);
  b.force_x = column(force_x);
  b.force_y = column(force_y);
  b.force_z = column(force_z);
  b.torque_x = column(torque_x);
  b.torque_y = column(torque_y);
  b.torque_z = column(torque_z);
  b.history = history_.data() + first_history_column;
  return b;
}

sdk::CohesionBatch BatchColumns::cohesion_view(std::size_t count, int first_history_column) {
  sdk::CohesionBatch b;
  b.count = padded(count);
  b.overlap = column(overlap);
  b.effective_radius = column(effective_radius);
  b.contact_overlap = column(contact_overlap);
  b.attraction = column(attraction);
  b.history = history_.data() + first_history_column;
  return b;
}

namespace {

template <bool is_periodic>
__attribute__((always_inline)) inline std::size_t gather(const RowView& rows, const Images& images,
                                                         const PairView& pairs, std::size_t& next,
                                                         std::size_t end, double range,
                                                         std::int32_t* contacts,
                                                         BatchColumns& columns) {
  using B = BatchColumns;
  // Copies: the bytes of is_touching may alias whatever stands in memory.
  const double* const position = rows.position;
  const double* const velocity = rows.velocity;
  const double* const rotation = rows.rotation;
  const std::int32_t* const pa = pairs.a;
  const std::int32_t* const pb = pairs.b;
  std::uint8_t* const is_touching = pairs.is_touching;
  double* const history = pairs.history;
  const std::size_t history_stride = pairs.history_stride;
  const std::size_t last_entry = pairs.count - 1;
  double* const c = columns.column(0);
  // x, y, z become differences, the fourth column the sum of the radii or inverse masses.
  const Lanes sign{-1.0, -1.0, -1.0, 1.0};
  const Lanes length{images.length[0], images.length[1], images.length[2], 0.0};
  const Lanes half{images.half[0], images.half[1], images.half[2], HUGE_VAL};
  std::size_t found = 0;
  std::size_t p = next;
  for (; p < end && found + 4 <= k_batch; p += 4) {
    const std::size_t lanes = std::min<std::size_t>(4, end - p);
    std::int32_t a[4];
    std::int32_t b[4];
    if (lanes == 4) [[likely]] {
      std::memcpy(a, pa + p, sizeof a);
      std::memcpy(b, pb + p, sizeof b);
    } else {
      for (std::size_t l = 0; l < 4; ++l) {
        a[l] = pa[std::min(p + l, end - 1)];
        b[l] = pb[std::min(p + l, end - 1)];
      }
    }
    Lanes x[4];
    Lanes ri;
    Lanes rj;
    for (std::size_t l = 0; l < 4; ++l) {
      const Lanes& ra = row(position, a[l]);
      const Lanes& rb = row(position, b[l]);
      x[l] = ra + sign * rb;
      ri[static_cast<int>(l)] = ra[3];
      rj[static_cast<int>(l)] = rb[3];
      if constexpr (is_periodic) fold(x[l], length, half);
      const std::size_t entry = std::min(p + l + k_ahead, last_entry);
      const std::ptrdiff_t ahead = 4 * static_cast<std::ptrdiff_t>(pb[entry]);
      __builtin_prefetch(position + ahead);
      __builtin_prefetch(velocity + ahead);
      __builtin_prefetch(rotation + ahead);
      // Most that touch have touched before; of the others the history is not wanted.
      __builtin_prefetch(history + (is_touching[entry] != 0 ? entry : p) * history_stride, 1);
    }
    transpose(x[0], x[1], x[2], x[3]);
    const Lanes reach = x[3] + range;
    const LaneMask near = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < reach * reach) & k_bits;
    const auto touch =
        static_cast<unsigned>(near[0] | near[1] | near[2] | near[3]) & ((1u << lanes) - 1u);
    std::uint32_t before = 0;
    const std::uint32_t now = k_bytes[touch];
    if (lanes == 4) [[likely]] {
      std::memcpy(&before, is_touching + p, 4);
      std::memcpy(is_touching + p, &now, 4);
    } else {
      std::memcpy(&before, is_touching + p, lanes);
      std::memcpy(is_touching + p, &now, lanes);
    }
    if ((before & ~now) != 0) [[unlikely]] {
      for (std::size_t l = 0; l < lanes; ++l) {
        if ((touch >> l & 1u) != 0) continue;
        std::memset(history + (p + l) * history_stride, 0, history_stride * sizeof(double));
      }
    }
    if (touch == 0) continue;
    Lanes v[4];
    Lanes wi[4];
    Lanes wj[4];
    for (std::size_t l = 0; l < 4; ++l) {
      v[l] = row(velocity, a[l]) + sign * row(velocity, b[l]);
      wi[l] = row(rotation, a[l]);
      wj[l] = row(rotation, b[l]);
    }
    transpose(v[0], v[1], v[2], v[3]);
    transpose(wi[0], wi[1], wi[2], wi[3]);
    transpose(wj[0], wj[1], wj[2], wj[3]);
    // Those in touch to the front; what is written beyond them is overwritten by the next.
    const LaneMask pack = k_pack[touch];
    const auto put = [&](int name, const Lanes& value) __attribute__((always_inline)) {
      store(c + static_cast<std::size_t>(name) * k_stride + found, __builtin_shuffle(value, pack));
    };
    for (int d = 0; d < 3; ++d) {
      put(B::separation_x + d, x[d]);
      put(B::velocity_x + d, v[d]);
      put(B::rotation_i_x + d, wi[d]);
      put(B::rotation_j_x + d, wj[d]);
    }
    put(B::radius_i, ri);
    put(B::radius_j, rj);
    put(B::inverse_mass, v[3]);
    for (int l = 0; l < 4; ++l) {
      contacts[found + static_cast<std::size_t>(l)] =
          static_cast<std::int32_t>(p) + static_cast<std::int32_t>(pack[l]);
    }
    found += static_cast<std::size_t>(__builtin_popcount(touch));
  }
  next = std::min(p, end);
  if (found > 0) {
    for (int name = 0; name <= B::rotation_j_z; ++name) {
      double* column = c + static_cast<std::size_t>(name) * k_stride;
      for (std::size_t q = found; q < padded(found); ++q) column[q] = column[found - 1];
    }
  }
  return found;
}

// A box without periodic sides need not look for images.
DUST_KERNEL std::size_t gather_open(const RowView& rows, const Images& images,
                                    const PairView& pairs, std::size_t& next, std::size_t end,
                                    double range, std::int32_t* contacts, BatchColumns& columns) {
  return gather<false>(rows, images, pairs, next, end, range, contacts, columns);
}
DUST_KERNEL std::size_t gather_periodic(const RowView& rows, const Images& images,
                                        const PairView& pairs, std::size_t& next, std::size_t end,
                                        double range, std::int32_t* contacts,
                                        BatchColumns& columns) {
  return gather<true>(rows, images, pairs, next, end, range, contacts, columns);
}

}  // namespace

std::size_t gather_touching(const RowView& rows, const Images& images, const PairView& pairs,
                            std::size_t& next, std::size_t end, double range,
                            std::int32_t* contacts, BatchColumns& columns) {
  const bool is_periodic = images.length[0] + images.length[1] + images.length[2] > 0.0;
  return (is_periodic ? gather_periodic : gather_open)(rows, images, pairs, next, end, range,
                                                       contacts, columns);
}

DUST_KERNEL double derive_pair_columns(BatchColumns& columns, std::size_t count) {
  using B = BatchColumns;
  const double* sx = columns.column(B::separation_x);
  const double* sy = columns.column(B::separation_y);
  const double* sz = columns.column(B::separation_z);
  const double* ri = columns.column(B::radius_i);
  const double* rj = columns.column(B::radius_j);
  const double* im = columns.column(B::inverse_mass);
  const double* aix = columns.column(B::rotation_i_x);
  const double* aiy = columns.column(B::rotation_i_y);
  const double* aiz = columns.column(B::rotation_i_z);
  const double* ajx = columns.column(B::rotation_j_x);
  const double* ajy = columns.column(B::rotation_j_y);
  const double* ajz = columns.column(B::rotation_j_z);
  double* vx = columns.column(B::velocity_x);
  double* vy = columns.column(B::velocity_y);
  double* vz = columns.column(B::velocity_z);
  double* overlap = columns.column(B::overlap);
  double* nx = columns.column(B::normal_x);
  double* ny = columns.column(B::normal_y);
  double* nz = columns.column(B::normal_z);
  double* wx = columns.column(B::rotation_x);
  double* wy = columns.column(B::rotation_y);
  double* wz = columns.column(B::rotation_z);
  double* radius = columns.column(B::effective_radius);
  double* mass = columns.column(B::effective_mass);
  double* li = columns.column(B::lever_i);
  double* lj = columns.column(B::lever_j);
  double largest = 0.0;
  const std::size_t n = padded(count);
#pragma omp simd reduction(max : largest)
  for (std::size_t q = 0; q < n; ++q) {
    // Coincident centres would give no direction; the tiny floor makes the normal zero instead.
    const double distance =
        std::sqrt(std::max(sx[q] * sx[q] + sy[q] * sy[q] + sz[q] * sz[q], 1e-300));
    const double inverse = 1.0 / distance;
    const double d = ri[q] + rj[q] - distance;
    const double x = sx[q] * inverse;
    const double y = sy[q] * inverse;
    const double z = sz[q] * inverse;
    // The contact point halves the overlap, so that the two levers add up to the distance.
    const double arm_i = ri[q] - 0.5 * d;
    const double arm_j = rj[q] - 0.5 * d;
    const double ox = arm_i * aix[q] + arm_j * ajx[q];
    const double oy = arm_i * aiy[q] + arm_j * ajy[q];
    const double oz = arm_i * aiz[q] + arm_j * ajz[q];
    vx[q] -= oy * z - oz * y;
    vy[q] -= oz * x - ox * z;
    vz[q] -= ox * y - oy * x;
    wx[q] = aix[q] - ajx[q];
    wy[q] = aiy[q] - ajy[q];
    wz[q] = aiz[q] - ajz[q];
    overlap[q] = d;
    nx[q] = x;
    ny[q] = y;
    nz[q] = z;
    li[q] = arm_i;
    lj[q] = arm_j;
    radius[q] = ri[q] * rj[q] / (ri[q] + rj[q]);
    mass[q] = 1.0 / im[q];
    largest = std::max(largest, d / std::min(ri[q], rj[q]));
  }
  return largest;
}

DUST_KERNEL void subtract_attraction(BatchColumns& columns, std::size_t count) {
  using B = BatchColumns;
  const double* nx = columns.column(B::normal_x);
  const double* ny = columns.column(B::normal_y);
  const double* nz = columns.column(B::normal_z);
  const double* attraction = columns.column(B::attraction);
  double* fx = columns.column(B::force_x);
  double* fy = columns.column(B::force_y);
  double* fz = columns.column(B::force_z);
  const std::size_t n = padded(count);
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    fx[q] -= attraction[q] * nx[q];
    fy[q] -= attraction[q] * ny[q];
    fz[q] -= attraction[q] * nz[q];
  }
}

DUST_KERNEL void derive_torques(BatchColumns& columns, std::size_t count, bool has_couple) {
  using B = BatchColumns;
  const double* nx = columns.column(B::normal_x);
  const double* ny = columns.column(B::normal_y);
  const double* nz = columns.column(B::normal_z);
  const double* fx = columns.column(B::force_x);
  const double* fy = columns.column(B::force_y);
  const double* fz = columns.column(B::force_z);
  const double* li = columns.column(B::lever_i);
  const double* lj = columns.column(B::lever_j);
  const double* mx = columns.column(B::torque_x);
  const double* my = columns.column(B::torque_y);
  const double* mz = columns.column(B::torque_z);
  double* ix = columns.column(B::torque_i_x);
  double* iy = columns.column(B::torque_i_y);
  double* iz = columns.column(B::torque_i_z);
  double* jx = columns.column(B::torque_j_x);
  double* jy = columns.column(B::torque_j_y);
  double* jz = columns.column(B::torque_j_z);
  const std::size_t n = padded(count);
  const double couple = has_couple ? 1.0 : 0.0;
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    // Force F at -lever_i n on i and -F at +lever_j n on j: both torques are -lever n x F.
    const double tx = ny[q] * fz[q] - nz[q] * fy[q];
    const double ty = nz[q] * fx[q] - nx[q] * fz[q];
    const double tz = nx[q] * fy[q] - ny[q] * fx[q];
    ix[q] = couple * mx[q] - li[q] * tx;
    iy[q] = couple * my[q] - li[q] * ty;
    iz[q] = couple * mz[q] - li[q] * tz;
    jx[q] = -couple * mx[q] - lj[q] * tx;
    jy[q] = -couple * my[q] - lj[q] * ty;
    jz[q] = -couple * mz[q] - lj[q] * tz;
  }
}

DUST_KERNEL void load_history(const PairView& pairs, const std::int32_t* contacts,
                              std::size_t count, int groups, BatchColumns& columns) {
  const std::size_t rounded = padded(count);
  for (int g = 0; g < groups; ++g) {
    double* c = columns.column(BatchColumns::first_history + 4 * g);
    for (std::size_t q = 0; q < rounded; q += 4) {
      Lanes h[4];
      for (std::size_t l = 0; l < 4; ++l) {
        const auto p = static_cast<std::size_t>(contacts[std::min(q + l, count - 1)]);
        std::memcpy(&h[l],
                    pairs.history + p * pairs.history_stride + 4 * static_cast<std::size_t>(g),
                    sizeof(Lanes));
      }
      transpose(h[0], h[1], h[2], h[3]);
      for (std::size_t l = 0; l < 4; ++l) store(c + l * k_stride + q, h[l]);
    }
  }
}

DUST_KERNEL void store_history(const PairView& pairs, const std::int32_t* contacts,
                               std::size_t count, int groups, BatchColumns& columns) {
  for (int g = 0; g < groups; ++g) {
    const double* c = columns.column(BatchColumns::first_history + 4 * g);
    for (std::size_t q = 0; q < count; q += 4) {
      Lanes h[4];
      for (std::size_t l = 0; l < 4; ++l) std::memcpy(&h[l], c + l * k_stride + q, sizeof(Lanes));
      transpose(h[0], h[1], h[2], h[3]);
      const std::size_t lanes = std::min<std::size_t>(4, count - q);
      for (std::size_t l = 0; l < lanes; ++l) {
        const auto p = static_cast<std::size_t>(contacts[q + l]);
        std::memcpy(pairs.history + p * pairs.history_stride + 4 * static_cast<std::size_t>(g),
                    &h[l], sizeof(Lanes));
      }
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
  const auto load = [&](int name, std::size_t q, Lanes& v) __attribute__((always_inline)) {
    std::memcpy(&v, columns.column(name) + q, sizeof v);
  };
  const double* scale_i = columns.column(B::scale_i);
  const double* scale_j = columns.column(B::scale_j);
  for (std::size_t q = 0; q < count; q += 4) {
    Lanes f[4] = {};
    Lanes ti[4] = {};
    Lanes tj[4] = {};
    for (int d = 0; d < 3; ++d) {
      load(B::force_x + d, q, f[d]);
      load(B::torque_i_x + d, q, ti[d]);
      load(B::torque_j_x + d, q, tj[d]);
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
