// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/narrow_hollows.hpp"
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
constexpr double k_smooth_angle = 8.0 * std::numbers::pi / 180.0;
const double k_smooth = std::cos(k_smooth_angle);

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
class PartFinder {
 public:
  PartFinder(TriangleSurface& surface, double largest_radius, bool is_sheet)
      : surface_(surface),
        is_sheet_(is_sheet),
        hollows_(find_narrow_hollows(surface, largest_radius, is_sheet)),
        sets_(surface.triangles.size()) {}

  void find() {
    sort_edges();
    join_bends();
    for (const Pair& f : folds_) sets_.keep_apart(f.a, f.b);
    join_ridges();
    number_parts();
  }

 private:
  /// Triangles that meet at an edge.
  struct Pair {
    std::int32_t a = 0, b = 0;
    bool is_narrow = false;  ///< a fold of a narrow hollow
    double turn = 0.0;       ///< [rad] of a fold towards the grains
    double length = 0.0;     ///< [m] of the edge
  };

  [[nodiscard]] const SurfaceTriangle& triangle(std::int32_t n) const {
    return surface_.triangles[static_cast<std::size_t>(n)];
  }

  void sort_edges() {
    for (std::size_t n = 0; n < surface_.edges.size(); ++n) {
      const SurfaceEdge& e = surface_.edges[n];
      for (std::int32_t p = e.first; p < e.last; ++p) {
        for (std::int32_t q = p + 1; q < e.last; ++q) {
          sort_pair(e, {.a = surface_.edge_triangles[static_cast<std::size_t>(p)],
                        .b = surface_.edge_triangles[static_cast<std::size_t>(q)],
                        .is_narrow = hollows_.is_fold[n],
                        .turn = hollows_.turn[n]});
        }
      }
    }
  }

  void sort_pair(const SurfaceEdge& e, Pair pair) {
    const SurfaceTriangle& s = triangle(pair.a);
    const SurfaceTriangle& t = triangle(pair.b);
    const bool is_pair = e.last - e.first == 2;
    if (s.is_sliver || t.is_sliver || (is_pair && dot(s.normal, t.normal) >= k_smooth)) {
      sort_smooth(pair);
      return;
    }
    // The far corner of t, seen from s: before its face, the surface folds towards the grains.
    const Vec3 from = surface_.vertices[static_cast<std::size_t>(e.from)];
    double height = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (t.corner[k] != e.from && t.corner[k] != e.to)
        height = dot(surface_.at(t, k) - from, s.normal);
    }
    if (is_sheet_ || height > 0.0 || !is_pair) {
      folds_.push_back(pair);
    } else {
      pair.length = norm(surface_.vertices[static_cast<std::size_t>(e.to)] - from);
      ridges_.push_back(pair);
    }
  }

  [[nodiscard]] bool is_bridged(std::int32_t triangle) const {
    return hollows_.flat_face[static_cast<std::size_t>(triangle)] >= 0;
  }

  /// The folds of narrow hollows wait. Where the surface bends away from a hollow, as on a rounded
  /// rim, the hollow ends.
  void sort_smooth(const Pair& pair) {
    const std::int32_t face = hollows_.flat_face[static_cast<std::size_t>(pair.a)];
    const std::int32_t other = hollows_.flat_face[static_cast<std::size_t>(pair.b)];
    if (face != other && pair.is_narrow) {
      bends_.push_back(pair);
    } else if (face != other && std::min(face, other) < 0 && pair.turn == 0.0) {
      folds_.push_back(pair);
    } else {
      sets_.join(pair.a, pair.b);
    }
  }

  /// Smooth hollows narrower than the largest sphere become strips, each smooth as a whole, so that
  /// a sphere that bridges them touches them on every side. Strips, not faces: each touch adds
  /// stiffness, and on a fine mesh that of the faces would be too much for the time step.
  void join_bends() {
    std::map<std::int32_t, double> turn;  // [rad] from one side of a strip to the other
    std::vector<Pair> cuts;
    for (const Pair& bend : bends_) {
      if (!is_bridged(bend.a) || !is_bridged(bend.b)) continue;
      const auto [a, b] = std::minmax({sets_.root(bend.a), sets_.root(bend.b)});
      if (a == b) continue;
      const double both = turn[a] + turn[b] + bend.turn;
      if (both > k_smooth_angle) {
        cuts.push_back(bend);
        continue;
      }
      sets_.join(a, b);  // with the root a
      turn[a] = both;
    }
    for (const Pair& cut : cuts) {  // beside another strip, so that no end of theirs is smooth
      turn[sets_.root(cut.a)] = k_smooth_angle;
      turn[sets_.root(cut.b)] = k_smooth_angle;
    }
    folds_.insert(folds_.end(), cuts.begin(), cuts.end());
    join_ends_of(turn);
  }

  /// A strip that is smooth with the faces on both its sides is no hollow: a needle beside a seam.
  void join_ends_of(std::map<std::int32_t, double>& turn) {
    std::map<std::int32_t, std::map<std::int32_t, double>> outer;  // [rad] by strip and neighbour
    const auto sides_of = [&](const Pair& bend) {
      const bool is_first = is_bridged(bend.a);
      return std::pair(sets_.root(is_first ? bend.a : bend.b),
                       sets_.root(is_first ? bend.b : bend.a));
    };
    std::vector<Pair> ends;
    for (const Pair& bend : bends_) {
      if (is_bridged(bend.a) && is_bridged(bend.b)) continue;
      ends.push_back(bend);
      const auto [strip, neighbour] = sides_of(bend);
      double& largest = outer[strip][neighbour];
      largest = std::max(largest, bend.turn);
    }
    for (const auto& [strip, neighbours] : outer) {
      for (const auto& [neighbour, fold] : neighbours) turn[strip] += fold;
    }
    std::vector<Pair> joined;
    for (const Pair& end : ends) {
      const bool is_smooth = turn[sides_of(end).first] <= k_smooth_angle;
      (is_smooth ? joined : folds_).push_back(end);
    }
    for (const Pair& end : joined) sets_.join(end.a, end.b);
  }

  void join_ridges() {
    for (const Pair& f : folds_) {
      // The rim of a hollow is touched on every side, too: it stays with the hollow.
      if (!f.is_narrow || sets_.root(f.a) == sets_.root(f.b)) continue;
      hollow_sets_.insert(sets_.root(f.a));
      hollow_sets_.insert(sets_.root(f.b));
    }
    std::map<std::pair<std::int32_t, std::int32_t>, double> common;
    for (const Pair& r : ridges_) {
      const auto pair = std::minmax({sets_.root(r.a), sets_.root(r.b)});
      if (hollow_sets_.count(pair.first) + hollow_sets_.count(pair.second) > 0) continue;
      common[{pair.first, pair.second}] += r.length;
    }
    std::vector<std::pair<double, std::pair<std::int32_t, std::int32_t>>> longest;
    longest.reserve(common.size());
    for (const auto& [pair, length] : common) longest.push_back({-length, pair});
    std::sort(longest.begin(), longest.end());
    for (const auto& [length, pair] : longest) {
      if (sets_.may_join(pair.first, pair.second)) sets_.join(pair.first, pair.second);
    }
  }

  /// Hollows first: of parts that share an edge the first is touched there.
  void number_parts() {
    std::map<std::int32_t, std::int32_t> number;
    for (const bool is_hollow : {true, false}) {
      for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
        const std::int32_t set = sets_.root(static_cast<std::int32_t>(n));
        if ((hollow_sets_.count(set) > 0) == is_hollow)
          number.emplace(set, static_cast<std::int32_t>(number.size()));
      }
    }
    for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
      surface_.triangles[n].part = number.at(sets_.root(static_cast<std::int32_t>(n)));
    }
    surface_.parts = static_cast<int>(number.size());
  }

  TriangleSurface& surface_;
  bool is_sheet_;
  NarrowHollows hollows_;
  Sets sets_;
  std::vector<Pair> bends_, folds_, ridges_;
  std::set<std::int32_t> hollow_sets_;
};

void mark_borders(TriangleSurface& surface) {
  surface.vertex_is_border.assign(surface.vertices.size(), 0);
  for (SurfaceEdge& e : surface.edges) {
    e.is_border = false;
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

void divide_into_parts(TriangleSurface& surface, double largest_radius, bool is_sheet) {
  PartFinder(surface, largest_radius, is_sheet).find();
  mark_borders(surface);
}

}  // namespace dust::bodies
