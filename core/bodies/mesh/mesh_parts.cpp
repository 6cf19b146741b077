// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace dust::bodies {
namespace {

using sdk::Vec3;

/// Faces that meet at a smaller angle are one smooth part. A sphere that rolls through a fold of
/// this angle still loses the touch of the first face before its foot leaves it, unless it overlaps
/// by more than 1 / cos(angle) - 1 = 1 % of its radius.
const double k_smooth = std::cos(8.0 * std::numbers::pi / 180.0);

/// Sets of triangles that join, each with the sets it must not join.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count), apart_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t root(std::int32_t n) {
    while (up(n) != n) n = up(n) = up(up(n));
    return n;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    up(b) = a;
    for (const std::int32_t c : apart(b)) {
      apart(c).erase(b);
      apart(c).insert(a);
      apart(a).insert(c);
    }
    apart(b).clear();
  }
  void keep_apart(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;  // the fold ends within the part
    apart(a).insert(b);
    apart(b).insert(a);
  }
  bool may_join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    return a != b && apart(a).count(b) == 0;
  }

 private:
  std::int32_t& up(std::int32_t n) { return parent_[static_cast<std::size_t>(n)]; }
  std::set<std::int32_t>& apart(std::int32_t n) { return apart_[static_cast<std::size_t>(n)]; }
  std::vector<std::int32_t> parent_;
  std::vector<std::set<std::int32_t>> apart_;
};

/// Smooth faces first; then faces that meet at edges which stand out join too, the longest common
/// edges first, as long as no fold towards the grains comes to lie inside a part.
void find_parts(TriangleSurface& surface, bool is_sheet) {
  Sets sets(surface.triangles.size());
  struct Ridge {
    std::int32_t a = 0, b = 0;
    double length = 0.0;
  };
  struct Fold {
    std::int32_t a = 0, b = 0;
  };
  std::vector<Ridge> ridges;
  std::vector<Fold> folds;
  for (const SurfaceEdge& e : surface.edges) {
    for (std::int32_t p = e.first; p < e.last; ++p) {
      for (std::int32_t q = p + 1; q < e.last; ++q) {
        const std::int32_t a = surface.edge_triangles[static_cast<std::size_t>(p)];
        const std::int32_t b = surface.edge_triangles[static_cast<std::size_t>(q)];
        const SurfaceTriangle& s = surface.triangles[static_cast<std::size_t>(a)];
        const SurfaceTriangle& t = surface.triangles[static_cast<std::size_t>(b)];
        const bool is_pair = e.last - e.first == 2;
        if (s.is_sliver || t.is_sliver || (is_pair && dot(s.normal, t.normal) >= k_smooth)) {
          sets.join(a, b);
          continue;
        }
        // The far corner of t, seen from s: before its face, the surface folds towards the grains.
        const Vec3 from = surface.vertices[static_cast<std::size_t>(e.from)];
        double height = 0.0;
        for (int k = 0; k < 3; ++k) {
          if (t.corner[k] != e.from && t.corner[k] != e.to)
            height = dot(surface.at(t, k) - from, s.normal);
        }
        const double length = norm(surface.vertices[static_cast<std::size_t>(e.to)] - from);
        if (is_sheet || height > 0.0 || !is_pair) {
          folds.push_back({a, b});
        } else {
          ridges.push_back({a, b, length});
        }
      }
    }
  }
  for (const Fold& f : folds) sets.keep_apart(f.a, f.b);
  std::map<std::pair<std::int32_t, std::int32_t>, double> common;
  for (const Ridge& r : ridges) {
    const auto pair = std::minmax({sets.root(r.a), sets.root(r.b)});
    common[{pair.first, pair.second}] += r.length;
  }
  std::vector<std::pair<double, std::pair<std::int32_t, std::int32_t>>> longest;
  longest.reserve(common.size());
  for (const auto& [pair, length] : common) longest.push_back({-length, pair});
  std::sort(longest.begin(), longest.end());
  for (const auto& [length, pair] : longest) {
    if (sets.may_join(pair.first, pair.second)) sets.join(pair.first, pair.second);
  }
  std::map<std::int32_t, std::int32_t> number;
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const std::int32_t set = sets.root(static_cast<std::int32_t>(n));
    surface.triangles[n].part =
        number.emplace(set, static_cast<std::int32_t>(number.size())).first->second;
  }
  surface.parts = static_cast<int>(number.size());
}

void mark_borders(TriangleSurface& surface) {
  surface.vertex_is_border.assign(surface.vertices.size(), 0);
  for (SurfaceEdge& e : surface.edges) {
    for (std::int32_t q = e.first; q < e.last; ++q) {
      const auto part = [&](std::int32_t place) {
        return surface
            .triangles[static_cast<std::size_t>(
                surface.edge_triangles[static_cast<std::size_t>(place)])]
            .part;
      };
      e.is_border = e.is_border || part(q) != part(e.first);
    }
  }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    for (std::int32_t q = surface.vertex_begin[v]; q < surface.vertex_begin[v + 1]; ++q) {
      const auto part = [&](std::int32_t place) {
        return surface
            .triangles[static_cast<std::size_t>(
                surface.vertex_triangles[static_cast<std::size_t>(place)])]
            .part;
      };
      if (part(q) != part(surface.vertex_begin[v])) surface.vertex_is_border[v] = 1;
    }
  }
}

}  // namespace

void divide_into_parts(TriangleSurface& surface, bool is_sheet) {
  find_parts(surface, is_sheet);
  mark_borders(surface);
}

}  // namespace dust::bodies
