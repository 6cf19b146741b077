// SPDX-License-Identifier: Apache-2.0
#include "contact/approach.hpp"

#include "base/lanes.hpp"
#include "contact/batch_kernels.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contact {
using namespace lanes;

namespace {

/// Pairs ahead whose rows are fetched.
constexpr std::size_t k_ahead = 32;

__attribute__((always_inline)) inline const Lanes& wide_row(const double* rows, std::int32_t n) {
  return *reinterpret_cast<const Lanes*>(rows + k_motion_stride * static_cast<std::size_t>(n));
}

}  // namespace

DUST_KERNEL void mark_approaching(const Trajectories& given, const Images& images,
                                  const ContactPrediction& prediction, const std::int32_t* a,
                                  const std::int32_t* b, std::size_t count,
                                  std::uint8_t* approach) {
  const Trajectories trajectories =
      given;  // a copy: the bytes of `approach` may alias whatever stands in memory
  const double lifetime = prediction.lifetime;
  const double behind2 = prediction.behind * prediction.behind;
  // x, y, z become differences, the fourth column of positions the sum of the radii.
  const Lanes sign{-1.0, -1.0, -1.0, 1.0};
  const Lanes length{images.length[0], images.length[1], images.length[2], 0.0};
  const Lanes half{images.half[0], images.half[1], images.half[2], HUGE_VAL};
  for (std::size_t q = 0; q < count; q += 4) {
    Lanes x[4];
    Lanes v[4];
    double skins[4];
    for (std::size_t l = 0; l < 4; ++l) {
      const std::size_t later = std::min(q + k_ahead + l, count - 1);
      for (const std::int32_t grain : {a[later], b[later]}) {
        __builtin_prefetch(trajectories.position + 4 * static_cast<std::ptrdiff_t>(grain), 0, 2);
        __builtin_prefetch(
            trajectories.velocity + k_motion_stride * static_cast<std::size_t>(grain), 0, 2);
        __builtin_prefetch(trajectories.skin + grain, 0, 2);
      }
    }
    for (std::size_t l = 0; l < 4; ++l) {
      const std::size_t e = std::min(q + l, count - 1);
      x[l] = row(trajectories.position, a[e]) + sign * row(trajectories.position, b[e]);
      v[l] = wide_row(trajectories.velocity, a[e]) + sign * wide_row(trajectories.velocity, b[e]);
      fold(x[l], length, half);
      skins[l] = trajectories.skin[a[e]] + trajectories.skin[b[e]];
    }
    const Lanes skin{skins[0], skins[1], skins[2], skins[3]};
    transpose(x[0], x[1], x[2], x[3]);
    transpose(v[0], v[1], v[2], v[3]);
    const Lanes reach = x[3] + skin + prediction.range;
    const Lanes reach2 = reach * reach;
    const Lanes xx = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const Lanes xv = x[0] * v[0] + x[1] * v[1] + x[2] * v[2];
    const Lanes vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    // Squares of the closest approach: now, at the horizon, or between; there times vv, so that
    // nothing is divided.
    const LaneMask is_near = xx < reach2;
    const LaneMask is_near_later = xx + lifetime * (2.0 * xv + lifetime * vv) < reach2;
    const LaneMask passes_between = (xv < 0.0) & (-xv < vv * lifetime);
    const LaneMask is_near_between = xx * vv - xv * xv < reach2 * vv;
    const LaneMask meets = is_near | is_near_later | (passes_between & is_near_between);
    // Distance < radii - speed times `behind`, squared twice: no root.
    const Lanes squared_path = behind2 * vv;
    const Lanes touch2 = x[3] * x[3];
    const Lanes excess = touch2 + squared_path - xx;
    const LaneMask overlaps =
        (squared_path < touch2) & (excess > 0.0) & (excess * excess > 4.0 * touch2 * squared_path);
    const LaneMask found = meets & (1LL * k_may_meet | (overlaps & (1LL * k_overlaps)));
    const auto byte = [&](int l) { return static_cast<std::uint8_t>(found[l]); };
    if (q + 4 <= count) {
      // Written out: in a loop of unknown length the lanes would go through memory.
      approach[q] = byte(0), approach[q + 1] = byte(1);
      approach[q + 2] = byte(2), approach[q + 3] = byte(3);
    } else {
      for (std::size_t l = 0; q + l < count; ++l) approach[q + l] = byte(static_cast<int>(l));
    }
  }
}

}  // namespace dust::contact
