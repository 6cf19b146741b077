// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dust::bodies {
namespace {

using sdk::Vec3;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

}  // namespace

Mesh::Mesh(const std::vector<Vec3>& corners, Sides sides)
    : sides_(sides), surface_(connect_triangles(corners)) {
  divide(0.0);
}

void Mesh::expect_spheres(double largest_radius) {
  if (largest_radius == largest_radius_) return;
  largest_radius_ = largest_radius;
  divide(largest_radius);
}

void Mesh::divide(double largest_radius) {
  divide_into_parts(surface_, largest_radius, sides_ == Sides::both);
  grow_trees();
}

Triangles Mesh::triangles() const {
  Triangles all;
  for (const SurfaceTriangle& t : surface_.triangles)
    all.insert(all.end(), {surface_.at(t, 0), surface_.at(t, 1), surface_.at(t, 2)});
  return all;
}

void Mesh::grow_trees() {
  std::vector<std::vector<BoxTree::Thing>> of_part(static_cast<std::size_t>(surface_.parts));
  for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
    const SurfaceTriangle& t = surface_.triangles[n];
    if (t.is_sliver) continue;  // its edges are its neighbours'
    BoxTree::Thing thing{
        .number = static_cast<std::int32_t>(n),
        .middle = (surface_.at(t, 0) + surface_.at(t, 1) + surface_.at(t, 2)) / 3.0};
    for (int k = 0; k < 3; ++k) include(thing.box, surface_.at(t, k));
    of_part[static_cast<std::size_t>(t.part)].push_back(thing);
  }
  trees_.clear();
  std::vector<BoxTree::Thing> parts;
  for (auto& things : of_part) {
    const BoxTree& tree = trees_.emplace_back(std::move(things));
    if (tree.is_empty()) continue;
    parts.push_back({.number = static_cast<std::int32_t>(trees_.size()) - 1,
                     .box = tree.box(),
                     .middle = 0.5 * (tree.box().low + tree.box().high)});
  }
  tree_of_parts_ = BoxTree(std::move(parts));
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

void Mesh::descend(std::int32_t part, Vec3 point, Foot& best) const {
  trees_[static_cast<std::size_t>(part)].look_near(point, best.distance2, [&](std::int32_t n) {
    const Foot foot = foot_on(n, point);
    if (foot.distance2 < best.distance2) best = foot;
  });
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
  double limit2 = k_infinity;
  std::int32_t of_best = -1;
  tree_of_parts_.look_near(point, limit2, [&](std::int32_t part) {
    Foot foot;
    foot.distance2 = part < of_best ? limit2 : best.distance2;  // of equally near ones the first
    descend(part, point, foot);
    if (foot.triangle < 0) return;
    best = foot;
    of_best = part;
    limit2 = std::nextafter(best.distance2, k_infinity);
  });
  if (best.triangle < 0) return {k_infinity, {0, 0, 1}};
  return surface_point(best, point);
}

bool Mesh::is_within(int part, Vec3 point, double reach) const {
  Foot best;
  best.distance2 = reach * reach;
  descend(part, point, best);
  return best.triangle >= 0;
}

void Mesh::find_within(Vec3 point, double reach, std::vector<std::int32_t>& parts) const {
  parts.clear();
  tree_of_parts_.look_near(point, reach * reach, [&](std::int32_t part) {
    if (is_within(part, point, reach)) parts.push_back(part);
  });
  std::sort(parts.begin(), parts.end());
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
  descend(part, point, best);
  if (best.triangle < 0) return none;
  if (hint != nullptr) *hint = best.triangle;
  const SurfacePoint s = surface_point(best, point);
  if (belongs_to_other(best, part, point)) return none;
  if (s.distance >= 0.0) return s;
  // Behind this part: in the solid, if no other part is nearer; else on another side of it.
  bool is_other_nearer = false;
  double limit2 = best.distance2;
  tree_of_parts_.look_near(point, limit2, [&](std::int32_t other) {
    if (other == part || is_other_nearer) return;
    Foot nearer;
    nearer.distance2 = best.distance2;
    descend(other, point, nearer);
    if (nearer.triangle < 0) return;
    is_other_nearer = true;
    limit2 = 0.0;
  });
  return is_other_nearer ? none : s;
}

}  // namespace dust::bodies
