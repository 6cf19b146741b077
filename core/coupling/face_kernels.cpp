// SPDX-License-Identifier: Apache-2.0
#include "coupling/face_kernels.hpp"

#include "coupling/lattice.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <cmath>

// Grain by grain in lanes: every grain's sums have the same order whatever the width of the lanes,
// so that all processors give the same bits.
namespace dust::coupling {

DUST_KERNEL void place_along(const AxisView& axis, const double* position, std::size_t count, int d,
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

DUST_KERNEL void sum_faces(const SpotBatch& spots, int d, std::size_t count,
                           const FaceColumns& faces, const FaceSumColumns& sums) {
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open_share = faces.open;
  double* open_sum = sums.open;
  double* fluid_sum = sums.fluid;
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

DUST_KERNEL void look_at_faces(const SpotBatch& spots, int d, std::size_t count,
                               const FaceColumns& faces, const double* u, const double* v,
                               const FaceSumColumns& sums, double* flux_sum) {
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open_share = faces.open;
  double* open_sum = sums.open;
  double* fluid_sum = sums.fluid;
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

DUST_KERNEL void settle_faces(const SpotBatch& spots, int d, std::size_t count,
                              const FaceColumns& faces, const double* u, const double* v,
                              const double* disturbance, const double* factor, bool is_density,
                              double* given) {
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const double* eps = faces.void_fraction;
  const float* open_share = faces.open;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double own = v[q];
    const double dist = disturbance[q];
    double sum = 0.0;
    for_corners(corners(spots, d, e, f, q), [&](std::int32_t at, double w) {
      const double e_at = eps[at];
      const double share = is_density ? 1.0 : e_at;
      sum += w * open_share[at] * share * (e_at * (u[at] - own) + dist);
    });
    given[q] = factor[q] * sum;
  }
}

}  // namespace dust::coupling
