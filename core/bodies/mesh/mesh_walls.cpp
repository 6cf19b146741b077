// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace dust::bodies {
namespace {

using sdk::Vec3;

/// Triangles looked at, evenly spread over the list: what a check may cost.
constexpr std::size_t k_max_triangles = 2000;
/// Faces that look away from each other within 30 degrees are the two sides of a wall; others meet
/// at an edge.
constexpr double k_opposite = -0.866;
constexpr int k_max_steps = 200;

}  // namespace

/// From the middle of a face straight into the solid, each step as long as the next surface is
/// away (Hart, The Visual Computer 12 (1996) 527, doi:10.1007/s003710050084).
double Mesh::thinnest_wall() const {
  if (sides_ == Sides::both) return 0.0;
  double thinnest = std::numeric_limits<double>::infinity();
  const std::size_t stride = 1 + surface_.triangles.size() / k_max_triangles;
  for (std::size_t n = 0; n < surface_.triangles.size(); n += stride) {
    const SurfaceTriangle& t = surface_.triangles[n];
    if (t.is_sliver) continue;
    const Vec3 start = (surface_.at(t, 0) + surface_.at(t, 1) + surface_.at(t, 2)) / 3.0;
    const double least = 4.0 * surface_.tolerance;
    double depth = least;
    for (int step = 0; step < k_max_steps && depth < thinnest; ++step) {
      const SurfacePoint s = nearest(start - depth * t.normal);
      const bool is_across = s.distance > -least && depth > 4.0 * least;
      if (is_across && dot(s.normal, t.normal) < k_opposite) thinnest = depth;
      if (is_across || s.distance >= 0.0) break;
      depth -= s.distance;
    }
  }
  return std::isfinite(thinnest) ? thinnest : 0.0;
}

}  // namespace dust::bodies
