// SPDX-License-Identifier: Apache-2.0
#include "coupling/face_kernels.hpp"

#include "base/lanes.hpp"
#include "coupling/lattice.hpp"
#include "dust/sdk/plugin.hpp"

#include <cmath>

// Grain by grain in lanes: every grain's sums have the same order whatever the width of the lanes,
// so that all processors give the same bits. Where many grains have the same faces around them,
// these are looked up once per run; else by each grain for itself.
namespace dust::coupling {
namespace {

using lanes::Lanes;
using lanes::load;
using lanes::store;

/// The eight faces of a run and what stands there.
struct RunFaces {
  double open[8], eps[8], u[8];
};

__attribute__((always_inline)) inline RunFaces faces_of_run(const SpotBatch& spots, int d,
                                                            std::size_t first,
                                                            const FaceColumns& faces,
                                                            const double* u) {
  RunFaces of_run;
  int n = 0;
  for_corners(
      corners(spots, d, (d + 1) % 3, (d + 2) % 3, first), [&](std::int32_t at, double)
                                                              __attribute__((always_inline)) {
                                                                of_run.open[n] = faces.open[at];
                                                                of_run.eps[n] =
                                                                    faces.void_fraction[at];
                                                                of_run.u[n] =
                                                                    u == nullptr ? 0.0 : u[at];
                                                                ++n;
                                                              });
  return of_run;
}

/// Trilinear weights of four grains, in the order of for_corners.
__attribute__((always_inline)) inline void weights_of_four(const SpotBatch& spots, int d,
                                                           std::size_t q, Lanes* weight) {
  Lanes high, far, above;
  load(spots.face_part[d].data() + q, high);
  load(spots.middle_part[(d + 1) % 3].data() + q, far);
  load(spots.middle_part[(d + 2) % 3].data() + q, above);
  const Lanes low = 1.0 - high;
  const Lanes near = 1.0 - far;
  const Lanes below = 1.0 - above;
  const Lanes across[4] = {near * below, far * below, near * above, far * above};
  for (int n = 0; n < 4; ++n) {
    weight[2 * n] = across[n] * low;
    weight[2 * n + 1] = across[n] * high;
  }
}

/// Calls work(faces, weights, q) for each four grains of each run.
template <class Work>
__attribute__((always_inline)) inline void for_runs(const SpotBatch& spots, int d,
                                                    const FaceColumns& faces, const double* u,
                                                    const Work& work) {
  for (std::size_t r = 0; r < spots.runs; ++r) {
    const RunFaces of_run = faces_of_run(spots, d, spots.run[r], faces, u);
    for (std::size_t q = spots.run[r]; q < spots.run[r + 1]; q += 4) {
      Lanes weight[8];
      weights_of_four(spots, d, q, weight);
      work(of_run, weight, q);
    }
  }
}

}  // namespace

DUST_KERNEL void place_along(const AxisView& axis, const double* position, int d,
                             SpotBatch& spots) {
  const double origin = axis.origin;
  const double inverse = axis.inverse_spacing;
  const double n = axis.count;
  const int last = axis.count - 1;
  const bool is_periodic = axis.is_periodic;
  const std::int32_t* homes = axis.homes + 2;
  double* face_part = spots.face_part[d].data();
  double* middle_part = spots.middle_part[d].data();
  std::int32_t* face = spots.face[d].data();
  std::int32_t* face_step = spots.face_step[d].data();
  std::int32_t* middle = spots.middle[d].data();
  std::int32_t* middle_step = spots.middle_step[d].data();
  const std::size_t count = spots.count;
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
    face[q] = homes[cell];
    face_step[q] = homes[cell + 1] - homes[cell];
    middle[q] = homes[low];
    middle_step[q] = homes[low + 1] - homes[low];
  }
}

DUST_KERNEL void find_runs(SpotBatch& spots) {
  // A run ends where the lower face or the lower middle changes along any axis: the steps belong to
  // these.
  const auto differs = [&](std::size_t q) __attribute__((always_inline)) {
    std::int32_t bits = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      bits |=
          (spots.face[d][q] ^ spots.face[d][q - 1]) | (spots.middle[d][q] ^ spots.middle[d][q - 1]);
    }
    return bits != 0;
  };
  spots.runs = 0;
  for (std::size_t q = 0; q < spots.count; ++q) {
    if (q == 0 || differs(q)) spots.run[spots.runs++] = static_cast<std::uint16_t>(q);
  }
  spots.run[spots.runs] = static_cast<std::uint16_t>(spots.count);
}

DUST_KERNEL void sum_faces(const SpotBatch& spots, int d, const FaceColumns& faces,
                           const FaceSumColumns& sums) {
  if (spots.has_long_runs()) {
    for_runs(
        spots, d, faces, nullptr,
        [&](const RunFaces& f, const Lanes* weight, std::size_t q) __attribute__((always_inline)) {
          Lanes open{};
          Lanes fluid{};
          for (int n = 0; n < 8; ++n) {
            const Lanes part = weight[n] * f.open[n];
            open += part;
            fluid += part * f.eps[n];
          }
          store(sums.open + q, open);
          store(sums.fluid + q, fluid);
        });
    return;
  }
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open_share = faces.open;
  double* open_sum = sums.open;
  double* fluid_sum = sums.fluid;
  const std::size_t count = spots.count;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    double open = 0.0;
    double fluid = 0.0;
    for_corners(corners(spots, d, e, f, q), [&](std::int32_t at, double w) {
      const double part = w * open_share[at];
      open += part;
      fluid += part * eps[at];
    });
    open_sum[q] = open;
    fluid_sum[q] = fluid;
  }
}

DUST_KERNEL void look_at_faces(const SpotBatch& spots, int d, const FaceColumns& faces,
                               const double* u, const double* v, const FaceSumColumns& sums,
                               double* flux_sum) {
  if (spots.has_long_runs()) {
    for_runs(
        spots, d, faces, u,
        [&](const RunFaces& f, const Lanes* weight, std::size_t q) __attribute__((always_inline)) {
          Lanes own;
          load(v + q, own);
          Lanes open{};
          Lanes fluid{};
          Lanes flux{};
          for (int n = 0; n < 8; ++n) {
            const Lanes part = weight[n] * f.open[n];
            open += part;
            fluid += part * f.eps[n];
            flux += weight[n] * f.eps[n] * (f.u[n] - own);
          }
          store(sums.open + q, open);
          store(sums.fluid + q, fluid);
          store(flux_sum + q, flux);
        });
    return;
  }
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open_share = faces.open;
  double* open_sum = sums.open;
  double* fluid_sum = sums.fluid;
  const std::size_t count = spots.count;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double own = v[q];
    double open = 0.0;
    double fluid = 0.0;
    double flux = 0.0;
    for_corners(corners(spots, d, e, f, q), [&](std::int32_t at, double w) {
      const double part = w * open_share[at];
      const double e_at = eps[at];
      open += part;
      fluid += part * e_at;
      flux += w * e_at * (u[at] - own);
    });
    open_sum[q] = open;
    fluid_sum[q] = fluid;
    flux_sum[q] = flux;
  }
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

DUST_KERNEL void charge_faces(std::size_t count, const ChargeInput& input, double least_open,
                              bool is_density, ChargeColumns& charges) {
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double open = input.open[q];
    const double received = is_density ? open : input.fluid[q];
    const bool is_paired = open > least_open;
    // One division for both reciprocals.
    const double inverse = 1.0 / (is_paired ? open * received : 1.0);
    const double drag = input.coefficient[q] * input.gain[q] * (inverse * received);
    const double extra = input.owed[q] * (inverse * open) - drag * charges.lag[q];
    charges.drag[q] = is_paired ? drag : 0.0;
    charges.extra[q] = is_paired ? extra : 0.0;
  }
}

DUST_KERNEL void settle_faces(const SpotBatch& spots, int d, const FaceColumns& faces,
                              const double* u, const ChargeColumns& charges, double scale,
                              bool is_density, double* given) {
  if (spots.has_long_runs()) {
    for_runs(
        spots, d, faces, u,
        [&](const RunFaces& f, const Lanes* weight, std::size_t q) __attribute__((always_inline)) {
          Lanes own;
          Lanes lag;
          Lanes drag;
          load(charges.velocity.data() + q, own);
          load(charges.lag.data() + q, lag);
          load(charges.drag.data() + q, drag);
          Lanes sum{};
          for (int n = 0; n < 8; ++n) {
            const double share = f.open[n] * (is_density ? 1.0 : f.eps[n]);
            sum += weight[n] * share * (f.eps[n] * (f.u[n] - own) + lag);
          }
          store(given + q, scale * drag * sum);
        });
    return;
  }
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open_share = faces.open;
  const std::size_t count = spots.count;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double own = charges.velocity[q];
    const double lag = charges.lag[q];
    double sum = 0.0;
    for_corners(corners(spots, d, e, f, q), [&](std::int32_t at, double w) {
      const double e_at = eps[at];
      const double share = is_density ? 1.0 : e_at;
      sum += w * open_share[at] * share * (e_at * (u[at] - own) + lag);
    });
    given[q] = scale * charges.drag[q] * sum;
  }
}

DUST_KERNEL void charge_run(const SpotBatch& spots, int d, std::size_t run,
                            const ChargeColumns& charges, RunCharge& sum) {
  Lanes drag_sum[8] = {};
  Lanes push_sum[8] = {};
  Lanes extra_sum[8] = {};
  const std::size_t end = spots.run[run + 1];
  for (std::size_t q = spots.run[run]; q < end; q += 4) {
    Lanes weight[8];
    weights_of_four(spots, d, q, weight);
    Lanes drag;
    Lanes velocity;
    Lanes extra;
    load(charges.drag.data() + q, drag);
    load(charges.velocity.data() + q, velocity);
    load(charges.extra.data() + q, extra);
    Lanes push = drag * velocity;
    if (end - q < 4) {
      // What stands behind the end is another run's, or anything.
      const lanes::LaneMask is_own = lanes::LaneMask{0, 1, 2, 3} < static_cast<long long>(end - q);
      for (Lanes& w : weight) w = is_own ? w : Lanes{};
      drag = is_own ? drag : Lanes{};
      push = is_own ? push : Lanes{};
      extra = is_own ? extra : Lanes{};
    }
    for (int n = 0; n < 8; ++n) {
      drag_sum[n] += weight[n] * drag;
      push_sum[n] += weight[n] * push;
      extra_sum[n] += weight[n] * extra;
    }
  }
  const auto all = [](const Lanes& v) __attribute__((always_inline)) {
    return (v[0] + v[1]) + (v[2] + v[3]);
  };
  for (std::size_t n = 0; n < 8; ++n) {
    sum.drag[n] = all(drag_sum[n]);
    sum.push[n] = all(push_sum[n]);
    sum.extra[n] = all(extra_sum[n]);
  }
}

}  // namespace dust::coupling
