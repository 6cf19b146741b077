// SPDX-License-Identifier: Apache-2.0
#include "bodies/survey/bounds_of.hpp"

#include <algorithm>
#include <cmath>

namespace dust::bodies {

using sdk::Vec3;

Bounds bounds_of(const Triangles& corners) {
  Bounds box;
  for (const Vec3& p : corners) include(box, p);
  return box;
}

Bounds bounds_of(const Body& body, const Placement& placement, Vec3 min, Vec3 max, double size,
                 double edge) {
  const Vec3 more{size, size, size};
  return bounds_of(body.triangles(min - more, max + more, edge, placement));
}

Bounds common(const Bounds& a, const Bounds& b) {
  Bounds both;
  for (int d = 0; d < 3; ++d) {
    both.low[d] = std::max(a.low[d], b.low[d]);
    both.high[d] = std::min(a.high[d], b.high[d]);
  }
  return both;
}

double distance(const Bounds& a, const Bounds& b) {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double off = std::max({a.low[d] - b.high[d], b.low[d] - a.high[d], 0.0});
    sum += off * off;
  }
  return std::sqrt(sum);
}

}  // namespace dust::bodies
