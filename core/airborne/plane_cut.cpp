// SPDX-License-Identifier: Apache-2.0
#include "airborne/plane_cut.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::airborne {
namespace {

using sdk::Vec3;

/// Share of the way from the middle of the box to its outermost corner that a plane stays within,
/// so that it always meets the box.
constexpr double k_within = 1.0 - 1e-9;

/// Keeps the part of a polygon on the inner side of a face of the box.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, int d, double sign, double limit) {
  std::vector<Vec3> kept;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 a = polygon[n];
    const Vec3 b = polygon[(n + 1) % polygon.size()];
    const double over_a = sign * a[d] - limit;
    const double over_b = sign * b[d] - limit;
    if (over_a <= 0.0) kept.push_back(a);
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
      Vec3 meeting = a + (over_a / (over_a - over_b)) * (b - a);
      meeting[d] = sign * limit;
      kept.push_back(meeting);
    }
  }
  return kept;
}

}  // namespace

PlaneCut cut_box(Vec3 size, Vec3 normal, double offset) {
  int steepest = 0;
  double reach = 0.0;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(normal[d]) > std::abs(normal[steepest])) steepest = d;
    reach += 0.5 * size[d] * std::abs(normal[d]);
  }
  const double along = std::clamp(offset, -k_within * reach, k_within * reach);
  Vec3 first;
  first[(steepest + 1) % 3] = 1.0;
  first = first - dot(first, normal) * normal;
  first = first / norm(first);
  const Vec3 second = cross(normal, first);
  const double far = 4.0 * norm(size);
  std::vector<Vec3> polygon;
  for (const auto& [a, b] : {std::array{far, far}, {-far, far}, {-far, -far}, {far, -far}}) {
    polygon.push_back(along * normal + a * first + b * second);
  }
  for (int d = 0; d < 3; ++d) {
    // A plane along a face of the box lies in it.
    if (std::abs(normal[d]) > 1.0 - 1e-12) continue;
    for (const double sign : {-1.0, 1.0}) polygon = clipped(polygon, d, sign, 0.5 * size[d]);
  }
  PlaneCut cut;
  if (polygon.size() < 3) return cut;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 a = polygon[n];
    const Vec3 b = polygon[(n + 1) % polygon.size()];
    const Vec3& origin = polygon[0];
    const double triangle = 0.5 * norm(cross(a - origin, b - origin));
    cut.area += triangle;
    cut.centre += (triangle / 3.0) * (origin + a + b);
    for (int d = 0; d < 3; ++d) {
      for (int high = 0; high < 2; ++high) {
        const double limit = (high != 0 ? 0.5 : -0.5) * size[d];
        if (a[d] != limit || b[d] != limit) continue;
        PlaneCut::Edge& edge = cut.edges[static_cast<std::size_t>(2 * d + high)];
        edge.length = norm(b - a);
        edge.middle = 0.5 * (a + b);
      }
    }
  }
  if (!(cut.area > 0.0)) return {};
  cut.centre = cut.centre / cut.area;
  return cut;
}

PlaneCut cut_box_of_area(Vec3 size, Vec3 normal, double offset, double area) {
  constexpr double k_near_enough = 0.01;
  constexpr int k_halvings = 30;
  PlaneCut cut = cut_box(size, normal, offset);
  if (std::abs(cut.area - area) <= k_near_enough * area) return cut;
  double reach = 0.0;
  for (int d = 0; d < 3; ++d) reach += 0.5 * size[d] * std::abs(normal[d]);
  // From the middle of the box, where the polygon is largest, outward it only shrinks.
  const double side = offset < 0.0 ? -1.0 : 1.0;
  double inner = 0.0;
  double outer = reach;
  for (int n = 0; n < k_halvings; ++n) {
    const double middle = 0.5 * (inner + outer);
    (cut_box(size, normal, side * middle).area > area ? inner : outer) = middle;
  }
  cut = cut_box(size, normal, side * inner);
  return cut;
}

}  // namespace dust::airborne
