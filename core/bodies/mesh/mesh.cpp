// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/mesh.hpp"

#include <algorithm>
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

}  // namespace

Mesh::Mesh(const std::vector<Vec3>& corners, Sides sides) : sides_(sides) {
  add_triangles(weld(corners));
  connect_edges();
  connect_vertices();
  find_shells();
  measure();
  find_parts();
  mark_borders();
  grow_trees();
}

/// Corner numbers into vertex_, in the order of the corners. Points within the tolerance of an
/// earlier one become that one.
std::vector<std::int32_t> Mesh::weld(const std::vector<Vec3>& corners) {
  Vec3 low = corners.empty() ? Vec3{} : corners[0];
  Vec3 high = low;
  for (const Vec3& p : corners) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  tolerance_ = k_tolerance * norm(high - low);
  const double cell = tolerance_ > 0.0 ? tolerance_ : 1.0;
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
        if (norm(vertex_[static_cast<std::size_t>(v)] - p) <= tolerance_) {
          found = v;
          break;
        }
      }
    }
    if (found < 0) {
      found = static_cast<std::int32_t>(vertex_.size());
      vertex_.push_back(p);
      cells[c].push_back(found);
    }
    index.push_back(found);
  }
  return index;
}

void Mesh::add_triangles(const std::vector<std::int32_t>& index) {
  std::set<std::array<std::int32_t, 3>> known;
  for (std::size_t n = 0; n + 2 < index.size(); n += 3) {
    Triangle t;
    std::copy_n(index.begin() + static_cast<std::ptrdiff_t>(n), 3, t.corner);
    if (t.corner[0] == t.corner[1] || t.corner[1] == t.corner[2] || t.corner[2] == t.corner[0]) {
      ++health_.collapsed;
      continue;
    }
    std::array<std::int32_t, 3> sorted = {t.corner[0], t.corner[1], t.corner[2]};
    std::sort(sorted.begin(), sorted.end());
    if (!known.insert(sorted).second) {
      ++health_.duplicates;
      continue;
    }
    const Vec3 a = at(t, 0);
    const Vec3 normal = cross(at(t, 1) - a, at(t, 2) - a);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, norm(at(t, k + 1) - at(t, k)));
    t.is_sliver = norm(normal) <= tolerance_ * longest;
    if (t.is_sliver) {
      ++health_.slivers;
    } else {
      t.normal = normal / norm(normal);
    }
    triangle_.push_back(t);
  }
}

/// Edges in the order in which they first appear, with their triangles and normals.
void Mesh::connect_edges() {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
  std::vector<std::vector<std::int32_t>> of_edge;
  for (std::size_t n = 0; n < triangle_.size(); ++n) {
    Triangle& t = triangle_[n];
    for (int k = 0; k < 3; ++k) {
      const auto ends = std::minmax(t.corner[k], t.corner[(k + 1) % 3]);
      const auto [place, is_new] = known.emplace(std::pair(ends.first, ends.second),
                                                 static_cast<std::int32_t>(edge_.size()));
      if (is_new) {
        edge_.push_back({.from = ends.first, .to = ends.second});
        of_edge.emplace_back();
      }
      t.edge[k] = place->second;
      of_edge[static_cast<std::size_t>(place->second)].push_back(static_cast<std::int32_t>(n));
    }
  }
  for (std::size_t e = 0; e < edge_.size(); ++e) {
    Edge& edge = edge_[e];
    edge.first = static_cast<std::int32_t>(edge_triangle_.size());
    edge_triangle_.insert(edge_triangle_.end(), of_edge[e].begin(), of_edge[e].end());
    edge.last = static_cast<std::int32_t>(edge_triangle_.size());
    int forward = 0;
    for (const std::int32_t n : of_edge[e]) {
      const Triangle& t = triangle_[static_cast<std::size_t>(n)];
      edge.normal += t.normal;
      for (int k = 0; k < 3; ++k) {
        if (t.edge[k] == static_cast<std::int32_t>(e)) forward += t.corner[k] == edge.from ? 1 : 0;
      }
    }
    const double length = norm(edge.normal);
    if (length > 0.0) edge.normal = edge.normal / length;
    const Vec3 middle = 0.5 * (vertex_[static_cast<std::size_t>(edge.from)] +
                               vertex_[static_cast<std::size_t>(edge.to)]);
    if (of_edge[e].size() == 1) {
      if (health_.open_edges++ == 0) health_.open_place = middle;
    } else if (of_edge[e].size() > 2) {
      ++health_.crowded_edges;
    } else if (forward != 1) {
      if (health_.opposing_edges++ == 0) health_.opposing_place = middle;
    }
  }
}

/// Triangles of the vertices, and their normals weighted by angle: their sign is right for nearest
/// points at a vertex (Baerentzen and Aanaes 2005, doi:10.1109/TVCG.2005.49).
void Mesh::connect_vertices() {
  vertex_normal_.assign(vertex_.size(), {});
  vertex_begin_.assign(vertex_.size() + 1, 0);
  for (const Triangle& t : triangle_) {
    for (int k = 0; k < 3; ++k) {
      ++vertex_begin_[static_cast<std::size_t>(t.corner[k]) + 1];
      if (t.is_sliver) continue;
      const Vec3 u = at(t, k + 1) - at(t, k);
      const Vec3 v = at(t, k + 2) - at(t, k);
      const double angle = std::atan2(norm(cross(u, v)), dot(u, v));
      vertex_normal_[static_cast<std::size_t>(t.corner[k])] += angle * t.normal;
    }
  }
  for (Vec3& n : vertex_normal_) {
    if (norm(n) > 0.0) n = n / norm(n);
  }
  std::partial_sum(vertex_begin_.begin(), vertex_begin_.end(), vertex_begin_.begin());
  vertex_triangle_.resize(static_cast<std::size_t>(vertex_begin_.back()));
  std::vector<std::int32_t> fill(vertex_begin_.begin(), vertex_begin_.end() - 1);
  for (std::size_t n = 0; n < triangle_.size(); ++n) {
    for (const std::int32_t v : triangle_[n].corner) {
      vertex_triangle_[static_cast<std::size_t>(fill[static_cast<std::size_t>(v)]++)] =
          static_cast<std::int32_t>(n);
    }
  }
}

/// Connected pieces, and which of them are inside out: negative volume, and not a cavity of a
/// larger one round it.
void Mesh::find_shells() {
  std::vector<std::int32_t> parent(triangle_.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Edge& e : edge_) {
    for (std::int32_t q = e.first + 1; q < e.last; ++q) {
      const std::int32_t a = root(parent, edge_triangle_[static_cast<std::size_t>(e.first)]);
      const std::int32_t b = root(parent, edge_triangle_[static_cast<std::size_t>(q)]);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  struct Shell {
    double volume = 0.0;
    Vec3 low, high;
  };
  std::map<std::int32_t, Shell> shells;
  for (std::size_t n = 0; n < triangle_.size(); ++n) {
    const Triangle& t = triangle_[n];
    const auto [place, is_new] =
        shells.emplace(root(parent, static_cast<std::int32_t>(n)), Shell{0.0, at(t, 0), at(t, 0)});
    Shell& s = place->second;
    s.volume += dot(at(t, 0), cross(at(t, 1), at(t, 2))) / 6.0;
    for (int k = 0; k < 3; ++k) {
      for (int d = 0; d < 3; ++d) {
        s.low[d] = std::min(s.low[d], at(t, k)[d]);
        s.high[d] = std::max(s.high[d], at(t, k)[d]);
      }
    }
  }
  health_.shells = shells.size();
  for (const auto& [first, shell] : shells) {
    health_.volume += shell.volume;
    if (shell.volume >= 0.0) continue;
    bool is_cavity = false;
    for (const auto& [other, round] : shells) {
      bool is_within = round.volume > 0.0;
      for (int d = 0; d < 3; ++d) {
        is_within = is_within && round.low[d] < shell.low[d] && round.high[d] > shell.high[d];
      }
      is_cavity = is_cavity || is_within;
    }
    health_.inside_out += is_cavity ? 0 : 1;
  }
}

void Mesh::measure() {
  health_.triangles = triangle_.size();
  health_.vertices = vertex_.size();
  for (const Triangle& t : triangle_) {
    health_.area += 0.5 * norm(cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0)));
  }
  std::vector<double> lengths;
  for (const Edge& e : edge_) {
    lengths.push_back(
        norm(vertex_[static_cast<std::size_t>(e.to)] - vertex_[static_cast<std::size_t>(e.from)]));
  }
  if (lengths.empty()) return;
  std::sort(lengths.begin(), lengths.end());
  health_.shortest_edge = lengths.front();
  health_.median_edge = lengths[lengths.size() / 2];
  health_.longest_edge = lengths.back();
}

Triangles Mesh::triangles() const {
  Triangles all;
  for (const Triangle& t : triangle_) all.insert(all.end(), {at(t, 0), at(t, 1), at(t, 2)});
  return all;
}

}  // namespace dust::bodies
