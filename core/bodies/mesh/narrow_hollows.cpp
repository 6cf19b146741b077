// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/narrow_hollows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace dust::bodies {
namespace {

using sdk::Vec3;

/// Triangles whose normals differ by less from that of the first are one flat face: STL rounds
/// corners to 24 bits.
const double k_flat = std::cos(0.5 * std::numbers::pi / 180.0);
/// Spheres count as wider by this factor.
constexpr double k_margin = 1.1;
/// Folds on either side of a face run across each other's way within 60 degrees.
constexpr double k_opposite = -0.5;

/// An edge of a flat face where the surface folds, towards the grains or, of a sheet, away.
struct Border {
  std::int32_t edge = 0;
  Vec3 from, to;          ///< [m]
  Vec3 into;              ///< unit, across the face
  double tan_half = 0.0;  ///< of the angle of the fold, negative away from the grains
};

double distance_to_segment(Vec3 p, Vec3 from, Vec3 to) {
  const Vec3 along = to - from;
  const double share = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
  return norm(p - from - share * along);
}

/// [m] Of edges of one plane that do not cross; of those that meet, where they are farthest apart:
/// every corner is narrow.
double distance_between(const Border& a, const Border& b) {
  const double from_a = distance_to_segment(a.from, b.from, b.to);
  const double to_a = distance_to_segment(a.to, b.from, b.to);
  const double from_b = distance_to_segment(b.from, a.from, a.to);
  const double to_b = distance_to_segment(b.to, a.from, a.to);
  const double nearest = std::min({from_a, to_a, from_b, to_b});
  return nearest > 0.0 ? nearest : std::max({from_a, to_a, from_b, to_b});
}

/// Whether a sphere that touches the faces beyond both edges bridges the one between them.
bool is_bridged(const Border& a, const Border& b, double radius) {
  if (!(a.tan_half * b.tan_half > 0.0) || !(dot(a.into, b.into) < k_opposite)) return false;
  const double widest = radius * std::abs(a.tan_half + b.tan_half);
  const Vec3 across = b.from + b.to - a.from - a.to;  // twice that of their middles
  if (dot(across, a.into) < 0.0) return false;        // back to back
  const double lengths = norm(a.to - a.from) + norm(b.to - b.from);
  if (norm(across) > lengths + 2.0 * widest) return false;  // too far, and quicker to see
  return distance_between(a, b) < widest;
}

/// Flat faces of a surface, each a number of triangles that hang together.
class FlatFaces {
 public:
  explicit FlatFaces(const TriangleSurface& surface)
      : surface_(surface), face_(surface.triangles.size(), -1) {
    for (std::size_t n = 0; n < face_.size(); ++n) {
      if (face_[n] < 0 && !surface.triangles[n].is_sliver) grow(static_cast<std::int32_t>(n));
    }
  }
  [[nodiscard]] const std::vector<std::int32_t>& of_triangles() const { return face_; }
  /// The edges of each face where it folds.
  [[nodiscard]] std::vector<std::vector<Border>> borders(bool is_sheet) const {
    std::vector<std::vector<Border>> all(normals_.size());
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      const SurfaceEdge& edge = surface_.edges[e];
      if (edge.last - edge.first != 2) continue;
      const std::int32_t a = surface_.edge_triangles[static_cast<std::size_t>(edge.first)];
      const std::int32_t b = surface_.edge_triangles[static_cast<std::size_t>(edge.last - 1)];
      const std::int32_t face = face_[static_cast<std::size_t>(a)];
      const std::int32_t other = face_[static_cast<std::size_t>(b)];
      if (face < 0 || other < 0 || face == other) continue;
      for (const auto& [self, triangle, beyond] : {Side{face, a, other}, Side{other, b, face}}) {
        const Border border = border_of(static_cast<std::int32_t>(e), triangle, self, beyond);
        if (border.tan_half > 0.0 || is_sheet)
          all[static_cast<std::size_t>(self)].push_back(border);
      }
    }
    return all;
  }

 private:
  struct Side {
    std::int32_t face, triangle, beyond;
  };

  /// Slivers belong to the face that they are reached from.
  void grow(std::int32_t seed) {
    const auto number = static_cast<std::int32_t>(normals_.size());
    const Vec3 normal = surface_.triangles[static_cast<std::size_t>(seed)].normal;
    normals_.push_back(normal);
    std::vector<std::int32_t> next = {seed};
    face_[static_cast<std::size_t>(seed)] = number;
    while (!next.empty()) {
      const SurfaceTriangle& t = surface_.triangles[static_cast<std::size_t>(next.back())];
      next.pop_back();
      for (const std::int32_t e : t.edge) {
        const SurfaceEdge& edge = surface_.edges[static_cast<std::size_t>(e)];
        if (edge.last - edge.first != 2) continue;
        for (std::int32_t q = edge.first; q < edge.last; ++q) {
          const std::int32_t n = surface_.edge_triangles[static_cast<std::size_t>(q)];
          const SurfaceTriangle& u = surface_.triangles[static_cast<std::size_t>(n)];
          std::int32_t& face = face_[static_cast<std::size_t>(n)];
          if (face >= 0 || !(u.is_sliver || dot(u.normal, normal) >= k_flat)) continue;
          face = number;
          next.push_back(n);
        }
      }
    }
  }

  [[nodiscard]] Border border_of(std::int32_t e, std::int32_t triangle, std::int32_t self,
                                 std::int32_t beyond) const {
    const SurfaceTriangle& t = surface_.triangles[static_cast<std::size_t>(triangle)];
    const Vec3 normal = normals_[static_cast<std::size_t>(self)];
    const Vec3 other = normals_[static_cast<std::size_t>(beyond)];
    Border border;
    border.edge = e;
    for (int k = 0; k < 3; ++k) {
      if (t.edge[k] != e) continue;
      border.from = surface_.at(t, k);
      border.to = surface_.at(t, k + 1);
    }
    // Anticlockwise round the face: its inside is on the left.
    const Vec3 along = border.to - border.from;
    border.into = cross(normal, along) / norm(along);
    const Vec3 turn = cross(normal, other);
    border.tan_half = -std::copysign(norm(turn) / (1.0 + dot(normal, other)), dot(turn, along));
    return border;
  }

  const TriangleSurface& surface_;
  std::vector<std::int32_t> face_;  ///< [triangles] -1 for slivers that no face reaches
  std::vector<Vec3> normals_;       ///< [faces] of the first triangle
};

}  // namespace

NarrowHollows find_narrow_hollows(const TriangleSurface& surface, double radius, bool is_sheet) {
  NarrowHollows hollows{std::vector<bool>(surface.edges.size(), false),
                        std::vector<double>(surface.edges.size(), 0.0),
                        std::vector<std::int32_t>(surface.triangles.size(), -1)};
  if (!(radius > 0.0)) return hollows;
  const FlatFaces faces(surface);
  std::vector<bool> is_bridged_face;
  for (const std::vector<Border>& borders : faces.borders(is_sheet)) {
    is_bridged_face.push_back(false);
    for (std::size_t m = 0; m < borders.size(); ++m) {
      hollows.turn[static_cast<std::size_t>(borders[m].edge)] =
          2.0 * std::atan(std::abs(borders[m].tan_half));
      for (std::size_t n = m + 1; n < borders.size(); ++n) {
        const auto a = static_cast<std::size_t>(borders[m].edge);
        const auto b = static_cast<std::size_t>(borders[n].edge);
        const bool is_known = hollows.is_fold[a] && hollows.is_fold[b] && is_bridged_face.back();
        if (is_known || !is_bridged(borders[m], borders[n], k_margin * radius)) continue;
        hollows.is_fold[a] = true;
        hollows.is_fold[b] = true;
        is_bridged_face.back() = true;
      }
    }
  }
  for (std::size_t n = 0; n < hollows.flat_face.size(); ++n) {
    const std::int32_t face = faces.of_triangles()[n];
    if (face >= 0 && is_bridged_face[static_cast<std::size_t>(face)]) hollows.flat_face[n] = face;
  }
  return hollows;
}

}  // namespace dust::bodies
