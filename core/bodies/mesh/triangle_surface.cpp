// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/triangle_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace dust::bodies {
namespace {

using sdk::Vec3;

/// Points closer than this share of the mesh's extent are one: STL repeats each corner, rounded to
/// 24 bits.
constexpr double k_tolerance = 1e-6;

std::int32_t root(std::vector<std::int32_t>& parent, std::int32_t n) {
  auto up = [&](std::int32_t m) -> std::int32_t& { return parent[static_cast<std::size_t>(m)]; };
  while (up(n) != n) n = up(n) = up(up(n));
  return n;
}

/// Corner numbers into the vertices, in the order of the corners. Points within the tolerance of an
/// earlier one become that one.
std::vector<std::int32_t> weld(TriangleSurface& surface, const std::vector<Vec3>& corners) {
  Vec3 low = corners.empty() ? Vec3{} : corners[0];
  Vec3 high = low;
  for (const Vec3& p : corners) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  surface.tolerance = k_tolerance * norm(high - low);
  const double cell = surface.tolerance > 0.0 ? surface.tolerance : 1.0;
  using Cell = std::array<std::int64_t, 3>;
  std::map<Cell, std::vector<std::int32_t>> cells;
  std::vector<std::int32_t> index;
  index.reserve(corners.size());
  for (const Vec3& p : corners) {
    Cell c{};
    for (int d = 0; d < 3; ++d) {
      c[static_cast<std::size_t>(d)] =
          static_cast<std::int64_t>(std::floor((p[d] - low[d]) / cell));
    }
    std::int32_t found = -1;
    for (std::int64_t n = 0; n < 27 && found < 0; ++n) {
      const auto near = cells.find({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1});
      if (near == cells.end()) continue;
      for (const std::int32_t v : near->second) {
        if (norm(surface.vertices[static_cast<std::size_t>(v)] - p) <= surface.tolerance) {
          found = v;
          break;
        }
      }
    }
    if (found < 0) {
      found = static_cast<std::int32_t>(surface.vertices.size());
      surface.vertices.push_back(p);
      cells[c].push_back(found);
    }
    index.push_back(found);
  }
  return index;
}

void add_triangles(TriangleSurface& surface, const std::vector<std::int32_t>& index) {
  std::set<std::array<std::int32_t, 3>> known;
  for (std::size_t n = 0; n + 2 < index.size(); n += 3) {
    SurfaceTriangle t;
    std::copy_n(index.begin() + static_cast<std::ptrdiff_t>(n), 3, t.corner);
    if (t.corner[0] == t.corner[1] || t.corner[1] == t.corner[2] || t.corner[2] == t.corner[0]) {
      ++surface.health.collapsed;
      continue;
    }
    std::array<std::int32_t, 3> sorted = {t.corner[0], t.corner[1], t.corner[2]};
    std::sort(sorted.begin(), sorted.end());
    if (!known.insert(sorted).second) {
      ++surface.health.duplicates;
      continue;
    }
    const Vec3 a = surface.at(t, 0);
    const Vec3 normal = cross(surface.at(t, 1) - a, surface.at(t, 2) - a);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, norm(surface.at(t, k + 1) - surface.at(t, k)));
    t.is_sliver = norm(normal) <= surface.tolerance * longest;
    if (t.is_sliver) {
      ++surface.health.slivers;
    } else {
      t.normal = normal / norm(normal);
    }
    surface.triangles.push_back(t);
  }
}

/// Edges in the order in which they first appear, with their triangles and normals.
void connect_edges(TriangleSurface& surface) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
  std::vector<std::vector<std::int32_t>> of_edge;
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    SurfaceTriangle& t = surface.triangles[n];
    for (int k = 0; k < 3; ++k) {
      const auto ends = std::minmax(t.corner[k], t.corner[(k + 1) % 3]);
      const auto [place, is_new] = known.emplace(std::pair(ends.first, ends.second),
                                                 static_cast<std::int32_t>(surface.edges.size()));
      if (is_new) {
        surface.edges.push_back({.from = ends.first, .to = ends.second});
        of_edge.emplace_back();
      }
      t.edge[k] = place->second;
      of_edge[static_cast<std::size_t>(place->second)].push_back(static_cast<std::int32_t>(n));
    }
  }
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    SurfaceEdge& edge = surface.edges[e];
    edge.first = static_cast<std::int32_t>(surface.edge_triangles.size());
    surface.edge_triangles.insert(surface.edge_triangles.end(), of_edge[e].begin(),
                                  of_edge[e].end());
    edge.last = static_cast<std::int32_t>(surface.edge_triangles.size());
    int forward = 0;
    for (const std::int32_t n : of_edge[e]) {
      const SurfaceTriangle& t = surface.triangles[static_cast<std::size_t>(n)];
      edge.normal += t.normal;
      for (int k = 0; k < 3; ++k) {
        if (t.edge[k] == static_cast<std::int32_t>(e)) forward += t.corner[k] == edge.from ? 1 : 0;
      }
    }
    const double length = norm(edge.normal);
    if (length > 0.0) edge.normal = edge.normal / length;
    const Vec3 middle = 0.5 * (surface.vertices[static_cast<std::size_t>(edge.from)] +
                               surface.vertices[static_cast<std::size_t>(edge.to)]);
    if (of_edge[e].size() == 1) {
      if (surface.health.open_edges++ == 0) surface.health.open_place = middle;
    } else if (of_edge[e].size() > 2) {
      ++surface.health.crowded_edges;
    } else if (forward != 1) {
      if (surface.health.opposing_edges++ == 0) surface.health.opposing_place = middle;
    }
  }
}

/// Triangles of the vertices, and their normals weighted by angle: their sign is right for nearest
/// points at a vertex (Baerentzen and Aanaes 2005, doi:10.1109/TVCG.2005.49).
void connect_vertices(TriangleSurface& surface) {
  surface.vertex_normals.assign(surface.vertices.size(), {});
  surface.vertex_begin.assign(surface.vertices.size() + 1, 0);
  for (const SurfaceTriangle& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      ++surface.vertex_begin[static_cast<std::size_t>(t.corner[k]) + 1];
      if (t.is_sliver) continue;
      const Vec3 u = surface.at(t, k + 1) - surface.at(t, k);
      const Vec3 v = surface.at(t, k + 2) - surface.at(t, k);
      const double angle = std::atan2(norm(cross(u, v)), dot(u, v));
      surface.vertex_normals[static_cast<std::size_t>(t.corner[k])] += angle * t.normal;
    }
  }
  for (Vec3& n : surface.vertex_normals) {
    if (norm(n) > 0.0) n = n / norm(n);
  }
  std::partial_sum(surface.vertex_begin.begin(), surface.vertex_begin.end(),
                   surface.vertex_begin.begin());
  surface.vertex_triangles.resize(static_cast<std::size_t>(surface.vertex_begin.back()));
  std::vector<std::int32_t> fill(surface.vertex_begin.begin(), surface.vertex_begin.end() - 1);
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    for (const std::int32_t v : surface.triangles[n].corner) {
      surface.vertex_triangles[static_cast<std::size_t>(fill[static_cast<std::size_t>(v)]++)] =
          static_cast<std::int32_t>(n);
    }
  }
}

/// Connected pieces, and which of them are inside out: negative volume, and not a cavity of a
/// larger one round it.
void find_shells(TriangleSurface& surface) {
  std::vector<std::int32_t> parent(surface.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const SurfaceEdge& e : surface.edges) {
    for (std::int32_t q = e.first + 1; q < e.last; ++q) {
      const std::int32_t a =
          root(parent, surface.edge_triangles[static_cast<std::size_t>(e.first)]);
      const std::int32_t b = root(parent, surface.edge_triangles[static_cast<std::size_t>(q)]);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  struct Shell {
    double volume = 0.0;
    Vec3 low, high;
  };
  std::map<std::int32_t, Shell> shells;
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const SurfaceTriangle& t = surface.triangles[n];
    const auto [place, is_new] = shells.emplace(root(parent, static_cast<std::int32_t>(n)),
                                                Shell{0.0, surface.at(t, 0), surface.at(t, 0)});
    Shell& s = place->second;
    s.volume += dot(surface.at(t, 0), cross(surface.at(t, 1), surface.at(t, 2))) / 6.0;
    for (int k = 0; k < 3; ++k) {
      for (int d = 0; d < 3; ++d) {
        s.low[d] = std::min(s.low[d], surface.at(t, k)[d]);
        s.high[d] = std::max(s.high[d], surface.at(t, k)[d]);
      }
    }
  }
  surface.health.shells = shells.size();
  for (const auto& [first, shell] : shells) {
    surface.health.volume += shell.volume;
    if (shell.volume >= 0.0) continue;
    bool is_cavity = false;
    for (const auto& [other, round] : shells) {
      bool is_within = round.volume > 0.0;
      for (int d = 0; d < 3; ++d) {
        is_within = is_within && round.low[d] < shell.low[d] && round.high[d] > shell.high[d];
      }
      is_cavity = is_cavity || is_within;
    }
    surface.health.inside_out += is_cavity ? 0 : 1;
  }
}

void measure(TriangleSurface& surface) {
  surface.health.triangles = surface.triangles.size();
  surface.health.vertices = surface.vertices.size();
  for (const SurfaceTriangle& t : surface.triangles) {
    surface.health.area +=
        0.5 * norm(cross(surface.at(t, 1) - surface.at(t, 0), surface.at(t, 2) - surface.at(t, 0)));
  }
  std::vector<double> lengths;
  for (const SurfaceEdge& e : surface.edges) {
    lengths.push_back(norm(surface.vertices[static_cast<std::size_t>(e.to)] -
                           surface.vertices[static_cast<std::size_t>(e.from)]));
  }
  if (lengths.empty()) return;
  std::sort(lengths.begin(), lengths.end());
  surface.health.shortest_edge = lengths.front();
  surface.health.median_edge = lengths[lengths.size() / 2];
  surface.health.longest_edge = lengths.back();
}

}  // namespace

TriangleSurface connect_triangles(const std::vector<Vec3>& corners) {
  TriangleSurface surface;
  add_triangles(surface, weld(surface, corners));
  connect_edges(surface);
  connect_vertices(surface);
  find_shells(surface);
  measure(surface);
  return surface;
}

}  // namespace dust::bodies
