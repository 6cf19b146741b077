// SPDX-License-Identifier: Apache-2.0
#include "report/space/space.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dust::report {

namespace {

using Point = std::array<double, 3>;
using Polygon = std::vector<Point>;

/// The part of a polygon on one side of the plane where coordinate `d` is `at` (Sutherland and
/// Hodgman 1974); `side` is 1 for what lies beyond `at`, -1 for what lies before it.
Polygon cut_at(const Polygon& polygon, std::size_t d, double at, double side) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point& a = polygon[k];
    const Point& b = polygon[(k + 1) % polygon.size()];
    const double inside_a = side * (a[d] - at);
    const double inside_b = side * (b[d] - at);
    if (inside_a >= 0.0) kept.push_back(a);
    if ((inside_a < 0.0) == (inside_b < 0.0)) continue;
    const double share = inside_a / (inside_a - inside_b);
    Point crossing{};
    for (std::size_t e = 0; e < 3; ++e) crossing[e] = a[e] + share * (b[e] - a[e]);
    crossing[d] = at;
    kept.push_back(crossing);
  }
  return kept;
}

Polygon cut_to(Polygon polygon, const Box& box) {
  for (std::size_t d = 0; d < 3 && polygon.size() > 2; ++d) {
    polygon = cut_at(polygon, d, box.min[d], 1.0);
    if (polygon.size() > 2) polygon = cut_at(polygon, d, box.max[d], -1.0);
  }
  return polygon;
}

bool is_in(const Point& p, const Box& box) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (p[d] < box.min[d] || p[d] > box.max[d]) return false;
  }
  return true;
}

}  // namespace

Surfaces clipped(const Surfaces& surfaces, const Box& box) {
  constexpr std::int64_t k_unused = -1;
  std::vector<std::int64_t> place(surfaces.points.size() / 3, k_unused);
  Surfaces result;
  const auto put = [&](const Point& p) {
    for (const double x : p) result.points.push_back(static_cast<float>(x));
    return static_cast<std::int64_t>(result.points.size() / 3) - 1;
  };
  for (std::size_t k = 0; k < surfaces.body.size(); ++k) {
    Polygon triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto from = 3 * static_cast<std::size_t>(surfaces.corners[3 * k + c]);
      triangle.push_back(
          {surfaces.points[from], surfaces.points[from + 1], surfaces.points[from + 2]});
    }
    std::vector<std::int64_t> corners;
    if (std::all_of(triangle.begin(), triangle.end(),
                    [&](const Point& p) { return is_in(p, box); })) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::int64_t& known = place[static_cast<std::size_t>(surfaces.corners[3 * k + c])];
        if (known == k_unused) known = put(triangle[c]);
        corners.push_back(known);
      }
    } else {
      const Polygon part = cut_to(triangle, box);
      for (const Point& p : part) corners.push_back(put(p));
    }
    for (std::size_t c = 2; c < corners.size(); ++c) {
      result.corners.insert(result.corners.end(), {corners[0], corners[c - 1], corners[c]});
      result.body.push_back(surfaces.body[k]);
    }
  }
  return result;
}

}  // namespace dust::report
