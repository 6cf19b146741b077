// SPDX-License-Identifier: Apache-2.0
#include "contact/approach.hpp"

#include "base/lanes.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contact {
using namespace lanes;

DUST_KERNEL void mark_approaching(const Courses& courses, const Images& images, double range,
                                  double horizon, const std::int32_t* a, const std::int32_t* b,
                                  std::size_t count, std::uint8_t* is_approaching) {
  // x, y, z become differences, the fourth column of positions the sum of the radii.
  const Lanes sign{-1.0, -1.0, -1.0, 1.0};
  const Lanes length{images.length[0], images.length[1], images.length[2], 0.0};
  const Lanes half{images.half[0], images.half[1], images.half[2], HUGE_VAL};
  for (std::size_t q = 0; q < count; q += 4) {
    Lanes x[4];
    Lanes v[4];
    Lanes allowance;
    for (std::size_t l = 0; l < 4; ++l) {
      const std::size_t e = std::min(q + l, count - 1);
      x[l] = row(courses.position, a[e]) + sign * row(courses.position, b[e]);
      v[l] = row(courses.velocity, a[e]) + sign * row(courses.velocity, b[e]);
      fold(x[l], length, half);
      allowance[l] = courses.allowance[a[e]] + courses.allowance[b[e]];
    }
    transpose(x[0], x[1], x[2], x[3]);
    transpose(v[0], v[1], v[2], v[3]);
    const Lanes reach = x[3] + allowance + range;
    const Lanes reach2 = reach * reach;
    const Lanes xx = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const Lanes xv = x[0] * v[0] + x[1] * v[1] + x[2] * v[2];
    const Lanes vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    // Squares of the closest approach: now, at the horizon, or between; there times vv, so that
    // nothing is divided.
    const LaneMask is_near = xx < reach2;
    const LaneMask is_near_later = xx + horizon * (2.0 * xv + horizon * vv) < reach2;
    const LaneMask passes_between = (xv < 0.0) & (-xv < vv * horizon);
    const LaneMask is_near_between = xx * vv - xv * xv < reach2 * vv;
    const LaneMask meets = is_near | is_near_later | (passes_between & is_near_between);
    for (std::size_t l = 0; l < 4 && q + l < count; ++l) {
      is_approaching[q + l] = meets[l] != 0 ? 1 : 0;
    }
  }
}

}  // namespace dust::contact
