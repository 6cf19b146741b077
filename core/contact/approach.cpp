// SPDX-License-Identifier: Apache-2.0
#include "contact/approach.hpp"

#include "base/lanes.hpp"
#include "contact/batch_kernels.hpp"
#include "contact/closest_approach.hpp"
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

/// Of four pairs, apart by `x` by their nearest images: whether another image may come within
/// reach. Between sides far apart none does.
__attribute__((always_inline)) inline bool other_images_may_reach(const Lanes* x, const Lanes* v,
                                                                  const Lanes& length,
                                                                  double lifetime,
                                                                  const Lanes& reach) {
  LaneMask found{};
  for (int d = 0; d < 3; ++d) {
    if (!(length[d] > 0.0)) continue;
    const Lanes apart = x[d] < 0.0 ? -x[d] : x[d];
    const Lanes speed = v[d] < 0.0 ? -v[d] : v[d];
    found |= length[d] - apart < reach + lifetime * speed;
  }
  return (found[0] | found[1] | found[2] | found[3]) != 0;
}

/// Adds to `meets` which of the four another image brings within reach.
__attribute__((noinline)) void add_other_images(const Lanes* x, const Lanes* v,
                                                const Images& images, double lifetime,
                                                const Lanes& reach, LaneMask& meets) {
  for (int l = 0; l < 4; ++l) {
    if (other_image_approaches({x[0][l], x[1][l], x[2][l]}, {v[0][l], v[1][l], v[2][l]},
                               images.length, lifetime, reach[l])) {
      meets[l] = -1;
    }
  }
}

}  // namespace

DUST_KERNEL void mark_approaching(const Trajectories& given, const Images& images,
                                  const ContactPrediction& prediction,
                                  std::span<const std::int32_t> first,
                                  std::span<const std::int32_t> second, std::uint8_t* approach) {
  // A copy: the bytes of `approach` may alias whatever stands in memory.
  const Trajectories trajectories = given;
  const std::int32_t* const a = first.data();
  const std::int32_t* const b = second.data();
  const std::size_t count = first.size();
  const double lifetime = prediction.lifetime;
  const double behind2 = prediction.behind * prediction.behind;
  // x, y, z become differences, the fourth column of positions the sum of the radii.
  const Lanes sign{-1.0, -1.0, -1.0, 1.0};
  const Lanes length{images.length[0], images.length[1], images.length[2], 0.0};
  const Lanes half{images.half[0], images.half[1], images.half[2], HUGE_VAL};
  const bool is_periodic = length[0] > 0.0 || length[1] > 0.0 || length[2] > 0.0;
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
    // Squares of the closest approach: now, at the end of the lifetime, or between; there times vv,
    // so that nothing is divided.
    const LaneMask is_near = xx < reach2;
    const LaneMask is_near_later = xx + lifetime * (2.0 * xv + lifetime * vv) < reach2;
    const LaneMask passes_between = (xv < 0.0) & (-xv < vv * lifetime);
    const LaneMask is_near_between = xx * vv - xv * xv < reach2 * vv;
    LaneMask meets = is_near | is_near_later | (passes_between & is_near_between);
    if (is_periodic && other_images_may_reach(x, v, length, lifetime, reach)) {
      add_other_images(x, v, images, lifetime, reach, meets);
    }
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
