// SPDX-License-Identifier: Apache-2.0
#include "coupling/drag/drag_look_ahead.hpp"

#include "dust/sdk/plugin.hpp"

#include <cmath>

namespace dust::coupling {
namespace {

/// The half interval ahead of `count` grains, and the columns of one component.
struct HalfInterval {
  std::size_t count;
  double half, before, gravity;
};
struct ComponentColumns {
  const double *rate, *weight, *is_known, *pull, *slip;
};

DUST_KERNEL void predict_along(HalfInterval interval, ComponentColumns grains, double* change,
                               double* square) {
  const auto [count, half, before, gravity] = interval;
  const auto [rate, weight, is_known, pull, slip] = grains;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    // As much as an implicit half step makes of it: where a grain relaxes fast, the drag of early
    // on counts more than that of the middle; docs/theory/coupling.md, eq. (12).
    const double ahead = half / (1.0 + rate[q] * half);
    const double free = (rate[q] * pull[q] + weight[q] * gravity) * ahead;
    const double seen = change[q] * before;
    const double smaller = std::abs(free) < std::abs(seen) ? free : seen;
    const double held = free * seen > 0.0 ? smaller : 0.0;
    const double expected = is_known[q] > 0.0 ? held : free;
    const double s = slip[q] - expected;
    change[q] = expected;
    square[q] += s * s;
  }
}

DUST_KERNEL void root(std::size_t count, double* values) {
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) values[q] = std::sqrt(values[q]);
}

}  // namespace

void predict(std::size_t count, double half, double before, const std::array<double, 3>& gravity,
             const std::array<StencilBatch::Reals, 3>& slip, DragLookAhead& grains) {
  grains.speed.fill(0.0);
  for (std::size_t d = 0; d < 3; ++d) {
    predict_along({count, half, before, gravity[d]},
                  {grains.rate.data(), grains.weight.data(), grains.is_known.data(),
                   grains.pull[d].data(), slip[d].data()},
                  grains.change[d].data(), grains.speed.data());
  }
  root(count, grains.speed.data());
}

}  // namespace dust::coupling
