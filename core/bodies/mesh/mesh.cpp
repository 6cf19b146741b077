// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::bodies {
namespace {

using sdk::Vec3;

constexpr std::int32_t k_leaf = 4;
constexpr double k_infinity = std::numeric_limits<double>::infinity();

double box_distance2(Vec3 low, Vec3 high, Vec3 p) {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double off = std::max({low[d] - p[d], p[d] - high[d], 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

Mesh::Mesh(const std::vector<Vec3>& corners, Sides sides)
    : sides_(sides), surface_(connect_triangles(corners)) {
  divide(0.0);
  uncut_parts_ = surface_.parts;
}

void Mesh::expect_spheres(double largest_radius) {
  if (largest_radius == largest_radius_) return;
  largest_radius_ = largest_radius;
  uncut_strips_ = 0;
  divide(largest_radius);
  if (surface_.parts - uncut_parts_ <= k_max_strips) return;
  uncut_strips_ = surface_.parts - uncut_parts_;
  divide(0.0);
}

void Mesh::divide(double largest_radius) {
  divide_into_parts(surface_, largest_radius, sides_ == Sides::both);
  order_.clear();
  trees_.assign(static_cast<std::size_t>(surface_.parts), {});
  grow_trees();
}

Triangles Mesh::triangles() const {
  Triangles all;
  for (const SurfaceTriangle& t : surface_.triangles)
    all.insert(all.end(), {surface_.at(t, 0), surface_.at(t, 1), surface_.at(t, 2)});
  return all;
}

void Mesh::grow_trees() {
  std::vector<std::vector<std::int32_t>> of_part(trees_.size());
  for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
    if (surface_.triangles[n].is_sliver) continue;  // its edges are its neighbours'
    of_part[static_cast<std::size_t>(surface_.triangles[n].part)].push_back(
        static_cast<std::int32_t>(n));
  }
  for (std::size_t p = 0; p < trees_.size(); ++p) {
    const auto begin = static_cast<std::int32_t>(order_.size());
    order_.insert(order_.end(), of_part[p].begin(), of_part[p].end());
    if (!of_part[p].empty()) grow(trees_[p], begin, static_cast<std::int32_t>(order_.size()));
  }
}

/// Halves at the median of the middles along the longest side. The first child follows its parent.
void Mesh::grow(Tree& tree, std::int32_t begin, std::int32_t end) {
  const std::size_t self = tree.size();
  tree.emplace_back();
  const auto middle = [&](std::int32_t n) {
    const SurfaceTriangle& t = surface_.triangles[static_cast<std::size_t>(n)];
    return (surface_.at(t, 0) + surface_.at(t, 1) + surface_.at(t, 2)) / 3.0;
  };
  Vec3 low{k_infinity, k_infinity, k_infinity};
  Vec3 high = -low;
  Vec3 first = low;
  Vec3 last = high;
  for (std::int32_t q = begin; q < end; ++q) {
    const std::int32_t n = order_[static_cast<std::size_t>(q)];
    const Vec3 m = middle(n);
    for (int d = 0; d < 3; ++d) {
      for (int k = 0; k < 3; ++k) {
        const double x = surface_.at(surface_.triangles[static_cast<std::size_t>(n)], k)[d];
        low[d] = std::min(low[d], x);
        high[d] = std::max(high[d], x);
      }
      first[d] = std::min(first[d], m[d]);
      last[d] = std::max(last[d], m[d]);
    }
  }
  tree[self].low = low;
  tree[self].high = high;
  if (end - begin <= k_leaf) {
    tree[self].first = begin;
    tree[self].count = end - begin;
    return;
  }
  const Vec3 extent = last - first;
  int d = 0;
  if (extent.y > extent[d]) d = 1;
  if (extent.z > extent[d]) d = 2;
  const std::int32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) {
                     const double x = middle(a)[d];
                     const double y = middle(b)[d];
                     return x < y || (x == y && a < b);
                   });
  grow(tree, begin, half);
  tree[self].first = static_cast<std::int32_t>(tree.size());
  grow(tree, half, end);
}

/// Nearest point of a triangle by regions of its plane (Ericson, Real-Time Collision Detection,
/// 2005, section 5.1.5).
Mesh::Foot Mesh::foot_on(std::int32_t n, Vec3 p) const {
  const SurfaceTriangle& t = surface_.triangles[static_cast<std::size_t>(n)];
  const Vec3 a = surface_.at(t, 0);
  const Vec3 b = surface_.at(t, 1);
  const Vec3 c = surface_.at(t, 2);
  Foot foot;
  foot.triangle = n;
  const auto end = [&](Vec3 place, Feature feature, int corner) {
    foot.place = place;
    foot.feature = feature;
    foot.corner = corner;
    foot.distance2 = dot(p - place, p - place);
    return foot;
  };
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = dot(ab, p - a);
  const double d2 = dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return end(a, Feature::vertex, 0);
  const double d3 = dot(ab, p - b);
  const double d4 = dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) return end(b, Feature::vertex, 1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return end(a + (d1 / (d1 - d3)) * ab, Feature::edge, 0);
  const double d5 = dot(ab, p - c);
  const double d6 = dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) return end(c, Feature::vertex, 2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return end(a + (d2 / (d2 - d6)) * ac, Feature::edge, 2);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return end(b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), Feature::edge, 1);
  }
  // On the face the height above the plane is the distance.
  const double height = dot(p - a, t.normal);
  foot.place = p - height * t.normal;
  foot.distance2 = height * height;
  return foot;
}

void Mesh::descend(const Tree& tree, Vec3 point, Foot& best) const {
  if (tree.empty()) return;
  constexpr std::size_t k_deepest = 64;  // halving 2^31 triangles
  std::int32_t stack[k_deepest];
  double stack_distance2[k_deepest];
  std::size_t count = 0;
  stack_distance2[count] = box_distance2(tree[0].low, tree[0].high, point);
  stack[count++] = 0;
  while (count > 0) {
    const std::int32_t self = stack[--count];
    if (stack_distance2[count] >= best.distance2) continue;
    const Node& node = tree[static_cast<std::size_t>(self)];
    if (node.count > 0) {
      for (std::int32_t q = node.first; q < node.first + node.count; ++q) {
        const Foot foot = foot_on(order_[static_cast<std::size_t>(q)], point);
        if (foot.distance2 < best.distance2) best = foot;
      }
      continue;
    }
    std::int32_t near = self + 1;
    std::int32_t far = node.first;
    const auto distance2 = [&](std::int32_t n) {
      const Node& child = tree[static_cast<std::size_t>(n)];
      return box_distance2(child.low, child.high, point);
    };
    double near2 = distance2(near);
    double far2 = distance2(far);
    if (far2 < near2) {
      std::swap(near, far);
      std::swap(near2, far2);
    }
    stack[count] = far;
    stack_distance2[count++] = far2;
    stack[count] = near;
    stack_distance2[count++] = near2;
  }
}

Vec3 Mesh::normal_at(const Foot& foot) const {
  const SurfaceTriangle& t = surface_.triangles[static_cast<std::size_t>(foot.triangle)];
  switch (foot.feature) {
    case Feature::face:
      return t.normal;
    case Feature::edge:
      return surface_.edges[static_cast<std::size_t>(t.edge[foot.corner])].normal;
    case Feature::vertex:
      return surface_.vertex_normals[static_cast<std::size_t>(t.corner[foot.corner])];
  }
  return t.normal;
}

SurfacePoint Mesh::surface_point(const Foot& foot, Vec3 point) const {
  const Vec3 off = point - foot.place;
  Vec3 outward = normal_at(foot);
  const double sign = dot(off, outward) < 0.0 ? -1.0 : 1.0;
  const double distance = std::sqrt(foot.distance2);
  const bool is_behind = sign < 0.0 && sides_ == Sides::one;
  // On a face and on the surface itself the direction is known better than from the offset.
  if (foot.feature == Feature::face || distance <= 1e-9 * surface_.tolerance) {
    if (sides_ == Sides::both) outward = sign * outward;
  } else {
    outward = (is_behind ? -1.0 / distance : 1.0 / distance) * off;
  }
  return {is_behind ? -distance : distance, outward};
}

SurfacePoint Mesh::nearest(Vec3 point) const {
  Foot best;
  for (const Tree& tree : trees_) descend(tree, point, best);
  if (best.triangle < 0) return {k_infinity, {0, 0, 1}};
  return surface_point(best, point);
}

bool Mesh::is_within(int part, Vec3 point, double reach) const {
  Foot best;
  best.distance2 = reach * reach;
  descend(trees_[static_cast<std::size_t>(part)], point, best);
  return best.triangle >= 0;
}

/// At an edge or corner that parts share the sphere touches once: not this part, where another one
/// comes nearer beyond it, and of equal ones the first.
bool Mesh::belongs_to_other(const Foot& foot, int part, Vec3 point) const {
  if (foot.feature == Feature::face) return false;
  const SurfaceTriangle& own = surface_.triangles[static_cast<std::size_t>(foot.triangle)];
  const std::int32_t* begin = nullptr;
  const std::int32_t* end = nullptr;
  std::int32_t edge = -1;
  std::int32_t vertex = -1;
  if (foot.feature == Feature::edge) {
    edge = own.edge[foot.corner];
    const SurfaceEdge& e = surface_.edges[static_cast<std::size_t>(edge)];
    if (!e.is_border) return false;
    begin = surface_.edge_triangles.data() + e.first;
    end = surface_.edge_triangles.data() + e.last;
  } else {
    vertex = own.corner[foot.corner];
    const auto v = static_cast<std::size_t>(vertex);
    if (surface_.vertex_is_border[v] == 0) return false;
    begin = surface_.vertex_triangles.data() + surface_.vertex_begin[v];
    end = surface_.vertex_triangles.data() + surface_.vertex_begin[v + 1];
  }
  constexpr double k_rounding = 1e-9;
  const Vec3 off = point - foot.place;
  const double least = k_rounding * norm(off);
  bool is_first = true;
  for (const std::int32_t* n = begin; n != end; ++n) {
    const SurfaceTriangle& t = surface_.triangles[static_cast<std::size_t>(*n)];
    if (t.part == part || t.is_sliver) continue;
    is_first = is_first && part < t.part;
    for (int k = 0; k < 3; ++k) {
      // From the vertex along both edges; from the edge across the face.
      Vec3 into;
      if (vertex >= 0) {
        if (t.corner[k] != vertex) continue;
        const Vec3 u = surface_.at(t, k + 1) - surface_.at(t, k);
        const Vec3 v = surface_.at(t, k + 2) - surface_.at(t, k);
        if (dot(off, u) > least * norm(u) || dot(off, v) > least * norm(v)) return true;
      } else {
        if (t.edge[k] != edge) continue;
        into = cross(t.normal, surface_.at(t, k + 1) - surface_.at(t, k));
        if (dot(off, into) > least * norm(into)) return true;
      }
    }
  }
  return !is_first;
}

SurfacePoint Mesh::contact(int part, Vec3 point, double reach, std::int32_t* hint) const {
  const SurfacePoint none{k_infinity, {0, 0, 1}};
  Foot best;
  best.distance2 = reach * reach;
  if (hint != nullptr && *hint >= 0) {
    const Foot last = foot_on(*hint, point);
    if (last.distance2 < best.distance2) best = last;
  }
  descend(trees_[static_cast<std::size_t>(part)], point, best);
  if (best.triangle < 0) return none;
  if (hint != nullptr) *hint = best.triangle;
  const SurfacePoint s = surface_point(best, point);
  if (belongs_to_other(best, part, point)) return none;
  if (s.distance >= 0.0) return s;
  // Behind this part: in the solid, if no other part is nearer; else on another side of it.
  for (std::size_t p = 0; p < trees_.size(); ++p) {
    if (p == static_cast<std::size_t>(part)) continue;
    Foot nearer;
    nearer.distance2 = best.distance2;
    descend(trees_[p], point, nearer);
    if (nearer.triangle >= 0) return none;
  }
  return s;
}

}  // namespace dust::bodies
