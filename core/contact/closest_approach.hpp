// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contact {

/// Whether two grains, apart by `x` [m] and going on at the relative velocity `v` [m/s], come
/// nearer than `limit` [m] within `lifetime` [s].
inline bool approach_is_within(const sdk::Vec3& x, const sdk::Vec3& v, double lifetime,
                               double limit) {
  const double xv = dot(x, v);
  const double vv = dot(v, v);
  const double t = std::clamp(-xv / std::max(vv, 1e-300), 0.0, lifetime);
  return dot(x, x) + t * (2.0 * xv + t * vv) < limit * limit;
}

/// The same of all their images but the nearest, from which `x` leads, along sides `period` apart
/// (three; 0: none): between sides a few diameters apart grains meet by one that was farther away
/// at the beginning.
inline bool other_image_approaches(const sdk::Vec3& x, const sdk::Vec3& v, const double* period,
                                   double lifetime, double limit) {
  sdk::Vec3 other = x;
  unsigned reached = 0;
  for (int d = 0; d < 3; ++d) {
    if (!(period[d] > 0.0)) continue;
    other[d] = x[d] - std::copysign(period[d], x[d]);
    if (std::abs(other[d]) < limit + std::abs(v[d]) * lifetime) reached |= 1u << d;
  }
  for (unsigned images = 1; images <= reached; ++images) {
    if ((images & ~reached) != 0) continue;
    const auto at = [&](int d) { return (images >> d & 1u) != 0 ? other[d] : x[d]; };
    if (approach_is_within({at(0), at(1), at(2)}, v, lifetime, limit)) return true;
  }
  return false;
}

}  // namespace dust::contact
