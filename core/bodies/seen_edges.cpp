// SPDX-License-Identifier: Apache-2.0
#include "bodies/seen_edges.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

namespace dust::bodies {
namespace {

using sdk::Vec3;

/// Cosine of the angle between two triangles from which on their common edge is drawn.
constexpr double k_sharp = 0.87;

using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

/// A corner on a grid fine enough that equal corners are found again.
Key key_of(Vec3 p, double step) {
  return {std::llround(p.x / step), std::llround(p.y / step), std::llround(p.z / step)};
}

struct Edge {
  Vec3 from, to;
  std::vector<Vec3> normals;  ///< of the triangles that share it
};

bool is_seen(const Edge& edge, int depth) {
  if (edge.normals.size() != 2) return true;
  const Vec3& a = edge.normals[0];
  const Vec3& b = edge.normals[1];
  if (dot(a, b) < k_sharp) return true;
  constexpr double k_level = 1e-9;
  const bool faces_a = a[depth] > k_level;
  const bool faces_b = b[depth] > k_level;
  return faces_a != faces_b;
}

}  // namespace

std::vector<std::pair<Vec3, Vec3>> visible_edges(const Triangles& triangles, int depth,
                                                 double size) {
  std::map<std::pair<Key, Key>, Edge> edges;
  for (std::size_t n = 0; n + 2 < triangles.size(); n += 3) {
    const Vec3 normal = cross(triangles[n + 1] - triangles[n], triangles[n + 2] - triangles[n]);
    const double area = norm(normal);
    if (!(area > 0.0)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 from = triangles[n + c];
      const Vec3 to = triangles[n + (c + 1) % 3];
      Key a = key_of(from, 1e-7 * size);
      Key b = key_of(to, 1e-7 * size);
      if (b < a) std::swap(a, b);
      Edge& edge = edges[{a, b}];
      edge.from = from;
      edge.to = to;
      edge.normals.push_back(normal / area);
    }
  }
  std::vector<std::pair<Vec3, Vec3>> seen;
  for (const auto& [key, edge] : edges) {
    if (is_seen(edge, depth)) seen.emplace_back(edge.from, edge.to);
  }
  return seen;
}

}  // namespace dust::bodies
