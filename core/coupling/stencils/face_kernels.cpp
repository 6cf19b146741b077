// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/face_kernels.hpp"

#include "base/lanes.hpp"
#include "coupling/stencils/lattice.hpp"
#include "dust/sdk/plugin.hpp"

#include <cmath>
#include <type_traits>

// Grain by grain in lanes: every grain's sums have the same order whatever the width of the lanes,
// so that all processors give the same bits. Where many grains have the same faces around them,
// these are looked up once per group; else by each grain for itself.
namespace dust::coupling {
namespace {

/// Four grains; without the alias of lanes::Lanes, which template arguments lose.
typedef double Four __attribute__((vector_size(32)));

/// Element q of a column, or four from q on.
__attribute__((always_inline)) inline void get(const double* column, std::size_t q, double& value) {
  value = column[q];
}
__attribute__((always_inline)) inline void get(const double* column, std::size_t q, Four& four) {
  four = *reinterpret_cast<const lanes::LooseLanes*>(column + q);
}
__attribute__((always_inline)) inline void put(double* column, std::size_t q, double value) {
  column[q] = value;
}
__attribute__((always_inline)) inline void put(double* column, std::size_t q, const Four& four) {
  *reinterpret_cast<lanes::LooseLanes*>(column + q) = four;
}

/// The eight faces of a group and what stands there.
struct GroupFaces {
  double open[8], eps[8], u[8];
};

__attribute__((always_inline)) inline GroupFaces faces_of_group(const StencilBatch& stencils, int d,
                                                                std::size_t first,
                                                                const FaceColumns& faces,
                                                                const double* u) {
  GroupFaces of_group;
  int n = 0;
  for_corners(corners(stencils, d, (d + 1) % 3, (d + 2) % 3, first), [&](std::int32_t at, double) {
    of_group.open[n] = faces.open[at];
    of_group.eps[n] = faces.void_fraction[at];
    of_group.u[n] = u[at];
    ++n;
  });
  return of_group;
}

/// Trilinear weights of four grains, in the order of for_corners.
__attribute__((always_inline)) inline void weights_of_four(const StencilBatch& stencils, int d,
                                                           std::size_t q, Four* weight) {
  Four high, far, above;
  get(stencils.face_part[d].data(), q, high);
  get(stencils.middle_part[(d + 1) % 3].data(), q, far);
  get(stencils.middle_part[(d + 2) % 3].data(), q, above);
  const Four low = 1.0 - high;
  const Four near = 1.0 - far;
  const Four below = 1.0 - above;
  const Four across[4] = {near * below, far * below, near * above, far * above};
  for (int n = 0; n < 4; ++n) {
    weight[2 * n] = across[n] * low;
    weight[2 * n + 1] = across[n] * high;
  }
}

/// Sums over the faces of each grain: `begin` sets up that of grain q, or of four from q on;
/// add(sum, weight, open, eps, u) sees the eight faces one after another; `end` writes it.
template <template <class> class Sum, class Begin, class End>
__attribute__((always_inline)) inline void for_faces(const StencilBatch& stencils, int d,
                                                     const FaceColumns& faces, const double* u,
                                                     const Begin& begin, const End& end) {
  if (has_large_groups(stencils)) {
    for (std::size_t r = 0; r < stencils.groups; ++r) {
      const GroupFaces f = faces_of_group(stencils, d, stencils.group[r], faces, u);
      for (std::size_t q = stencils.group[r]; q < stencils.group[r + 1]; q += 4) {
        Four weight[8];
        weights_of_four(stencils, d, q, weight);
        Sum<Four> sum;
        begin(q, sum);
        for (int n = 0; n < 8; ++n) add(sum, weight[n], f.open[n], f.eps[n], f.u[n]);
        end(q, sum);
      }
    }
    return;
  }
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open = faces.open;
  const std::size_t count = stencils.count;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    Sum<double> sum;
    begin(q, sum);
    for_corners(
        corners(stencils, d, e, f, q), [&](std::int32_t at, double w)
                                           __attribute__((always_inline)) {
                                             add(sum, w, open[at], eps[at], u[at]);
                                           });
    end(q, sum);
  }
}

/// open = sum(w a), fluid = sum(w a eps)
template <class T>
struct OpenSum {
  T open{}, fluid{};
};
template <class T>
__attribute__((always_inline)) inline void add(OpenSum<T>& sum, const std::type_identity_t<T>& w,
                                               double a, double eps, double) {
  const T part = w * a;
  sum.open += part;
  sum.fluid += part * eps;
}
/// The same, and flux = sum(w eps (u - v)).
template <class T>
struct FluxSum {
  T v{};
  T open{}, fluid{}, flux{};
};
template <class T>
__attribute__((always_inline)) inline void add(FluxSum<T>& sum, const std::type_identity_t<T>& w,
                                               double a, double eps, double u) {
  const T part = w * a;
  sum.open += part;
  sum.fluid += part * eps;
  sum.flux += w * eps * (u - sum.v);
}
/// sum(w a e (eps (u - v) + flux difference)), e = 1 for `is_density`, else eps.
template <class T>
struct DragSum {
  bool is_density = false;
  T v{}, flux_difference{};
  T drag{};
};
template <class T>
__attribute__((always_inline)) inline void add(DragSum<T>& sum, const std::type_identity_t<T>& w,
                                               double a, double eps, double u) {
  sum.drag += w * (a * (sum.is_density ? 1.0 : eps)) * (eps * (u - sum.v) + sum.flux_difference);
}

}  // namespace

DUST_KERNEL void place_along(const AxisView& axis, const double* position, int d,
                             StencilBatch& stencils) {
  const double origin = axis.origin;
  const double inverse = axis.inverse_spacing;
  const double n = axis.count;
  const int last = axis.count - 1;
  const bool is_periodic = axis.is_periodic;
  const std::int32_t* storages = axis.storages + 2;
  double* face_part = stencils.face_part[d].data();
  double* middle_part = stencils.middle_part[d].data();
  std::int32_t* face = stencils.face[d].data();
  std::int32_t* face_step = stencils.face_step[d].data();
  std::int32_t* middle = stencils.middle[d].data();
  std::int32_t* middle_step = stencils.middle_step[d].data();
  const std::size_t count = stencils.count;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    double s = (position[4 * q + d] - origin) * inverse;
    s = is_periodic ? s - n * std::floor(s / n) : s;
    // A point on a side itself would have no open face along the axis.
    s = s < k_off_side ? k_off_side : s;
    s = s > n - k_off_side ? n - k_off_side : s;
    int cell = static_cast<int>(s);
    cell = cell > last ? last : cell;
    const double part = s - cell;
    const bool is_lower_half = part < 0.5;
    const int low = cell - (is_lower_half ? 1 : 0);
    face_part[q] = part;
    middle_part[q] = part + (is_lower_half ? 0.5 : -0.5);
    face[q] = storages[cell];
    face_step[q] = storages[cell + 1] - storages[cell];
    middle[q] = storages[low];
    middle_step[q] = storages[low + 1] - storages[low];
  }
}

DUST_KERNEL void find_groups(StencilBatch& stencils) {
  // A group ends where the lower face or the lower middle changes along any axis: the steps belong
  // to these.
  const auto differs = [&](std::size_t q) __attribute__((always_inline)) {
    std::int32_t bits = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      bits |= (stencils.face[d][q] ^ stencils.face[d][q - 1]) |
              (stencils.middle[d][q] ^ stencils.middle[d][q - 1]);
    }
    return bits != 0;
  };
  stencils.groups = 0;
  for (std::size_t q = 0; q < stencils.count; ++q) {
    if (q == 0 || differs(q)) stencils.group[stencils.groups++] = static_cast<std::uint16_t>(q);
  }
  stencils.group[stencils.groups] = static_cast<std::uint16_t>(stencils.count);
}

DUST_KERNEL void sum_faces(const StencilBatch& stencils, int d, const FaceColumns& faces,
                           const FaceSumColumns& sums) {
  for_faces<OpenSum>(
      stencils, d, faces, faces.void_fraction,
      [](std::size_t, auto&) __attribute__((always_inline)){},
      [&](std::size_t q, const auto& sum) __attribute__((always_inline)) {
        put(sums.open, q, sum.open);
        put(sums.fluid, q, sum.fluid);
      });
}

DUST_KERNEL void sample_faces(const StencilBatch& stencils, int d, const FaceColumns& faces,
                              const double* u, const double* v, const FaceSumColumns& sums,
                              double* flux) {
  for_faces<FluxSum>(
      stencils, d, faces,
      u, [&](std::size_t q, auto& sum) __attribute__((always_inline)) { get(v, q, sum.v); },
      [&](std::size_t q, const auto& sum) __attribute__((always_inline)) {
        put(sums.open, q, sum.open);
        put(sums.fluid, q, sum.fluid);
        put(flux, q, sum.flux);
      });
}

DUST_KERNEL void slip_of_faces(std::size_t count, const double* eps, const FaceSumColumns& sums,
                               const double* flux, double* slip, double* ratio) {
  const double* open = sums.open;
  const double* fluid = sums.fluid;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const bool is_open = open[q] > 0.0;
    // One division for both reciprocals.
    const double share = is_open ? open[q] : 1.0;
    const double inverse = 1.0 / (share * eps[q]);
    slip[q] = flux[q] * (inverse * share);
    ratio[q] = is_open ? fluid[q] * inverse : 1.0;
  }
}

DUST_KERNEL void find_contributions(std::size_t count, const ContributionInputs& input,
                                    double least_open, bool is_density,
                                    FaceContributions& contributions) {
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double open = input.open[q];
    const double received = is_density ? open : input.fluid[q];
    const bool is_paired = open > least_open;
    // One division for both reciprocals.
    const double inverse = 1.0 / (is_paired ? open * received : 1.0);
    const double drag = input.coefficient[q] * input.gain[q] * (inverse * received);
    const double extra =
        input.deferred[q] * (inverse * open) - drag * contributions.flux_difference[q];
    contributions.drag[q] = is_paired ? drag : 0.0;
    contributions.extra[q] = is_paired ? extra : 0.0;
  }
}

DUST_KERNEL void evaluate_faces(const StencilBatch& stencils, int d, const FaceColumns& faces,
                                const double* u, const FaceContributions& contributions,
                                double scale, bool is_density, double* given) {
  const double* v = contributions.velocity.data();
  const double* flux_difference = contributions.flux_difference.data();
  const double* drag = contributions.drag.data();
  for_faces<DragSum>(
      stencils, d, faces, u,
      [&](std::size_t q, auto& sum) __attribute__((always_inline)) {
        sum.is_density = is_density;
        get(v, q, sum.v);
        get(flux_difference, q, sum.flux_difference);
      },
      [&](std::size_t q, auto& sum) __attribute__((always_inline)) {
        auto own = sum.drag;
        get(drag, q, own);
        put(given, q, scale * own * sum.drag);
      });
}

DUST_KERNEL void sum_group(const StencilBatch& stencils, int d, std::size_t group,
                           const FaceContributions& contributions, GroupContributions& sum) {
  Four drag_sum[8] = {};
  Four push_sum[8] = {};
  Four extra_sum[8] = {};
  const std::size_t end = stencils.group[group + 1];
  for (std::size_t q = stencils.group[group]; q < end; q += 4) {
    Four weight[8];
    weights_of_four(stencils, d, q, weight);
    Four drag;
    Four velocity;
    Four extra;
    get(contributions.drag.data(), q, drag);
    get(contributions.velocity.data(), q, velocity);
    get(contributions.extra.data(), q, extra);
    Four push = drag * velocity;
    if (end - q < 4) {
      // What stands behind the end is another group's, or anything.
      const lanes::LaneMask is_own = lanes::LaneMask{0, 1, 2, 3} < static_cast<long long>(end - q);
      for (Four& w : weight) w = is_own ? w : Four{};
      drag = is_own ? drag : Four{};
      push = is_own ? push : Four{};
      extra = is_own ? extra : Four{};
    }
    for (int n = 0; n < 8; ++n) {
      drag_sum[n] += weight[n] * drag;
      push_sum[n] += weight[n] * push;
      extra_sum[n] += weight[n] * extra;
    }
  }
  const auto all = [](const Four& v) __attribute__((always_inline)) {
    return (v[0] + v[1]) + (v[2] + v[3]);
  };
  for (std::size_t n = 0; n < 8; ++n) {
    sum.drag[n] = all(drag_sum[n]);
    sum.push[n] = all(push_sum[n]);
    sum.extra[n] = all(extra_sum[n]);
  }
}

}  // namespace dust::coupling
