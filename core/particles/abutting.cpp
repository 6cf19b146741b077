// SPDX-License-Identifier: Apache-2.0
#include "particles/abutting.hpp"

#include "bodies/survey/bounds_of.hpp"
#include "bodies/survey/gap.hpp"
#include "particles/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dust::particles {
namespace {

using bodies::Body;
using sdk::Vec3;

/// Of the domain's diagonal. Coordinates of meshes are often of single precision (1e-7).
constexpr double k_flush = 1e-6;
/// And of what a sphere reaches: dust in a corner is no thicker than what is flush to gravel.
constexpr double k_flush_to_sphere = 1e-3;
/// Of the domain's diagonal: what a few operations on doubles round off.
constexpr double k_rounding = 1e-15;
/// Nearest points that a pair of bodies may cost. Where they do not show that two bodies are apart,
/// they count as touching: that costs time, but changes nothing.
constexpr std::size_t k_work = 20'000;

/// As far as a box far beyond the domain, with room for what chords cut off: a filter, no more.
bodies::Bounds bounds(const Body& body, Vec3 min, Vec3 max) {
  const double edge = bodies::written_edge(min, max);
  const double far = 2.0 * norm(max - min);
  return bodies::bounds_of(body, body.placement(0.0), min, max, far, edge).grown(edge);
}

bool may_touch(const Body& a, const Body& b, Vec3 min, Vec3 max, double tolerance) {
  const bodies::Gap gap = bodies::smallest_gap(a, b, {min, max, tolerance, k_work});
  return gap.width <= tolerance || !gap.is_whole;
}

}  // namespace

bool AbuttingBody::takes_over(Vec3 point, double reach, const bodies::SurfacePoint& near) const {
  const double flush = std::min(tolerance, k_flush_to_sphere * reach);
  const Vec3 foot = point - near.distance * near.normal;
  for (int d = 0; d < 3; ++d) {
    if (foot[d] < low[d] || foot[d] > high[d]) return false;
  }
  if (body->is_removed()) return false;
  // Seldom is this one as near, which costs less to see.
  const double limit = near.distance + flush;
  thread_local std::vector<std::int32_t> parts;
  body->find_within(point, limit, place, parts);
  if (parts.empty()) return false;
  const double depth = body->nearest(foot, place).distance;
  if (depth > flush) return false;
  // Steps of distance instead of differences: of three bodies that are equally near, one remains.
  const double rank = std::floor(near.distance / rounding);
  for (const std::int32_t part : parts) {
    if (depth >= -flush && !body->is_within(part, foot, flush, place)) continue;
    const double here = body->contact(part, point, limit, place).distance;
    const double mine = std::floor(here / rounding);
    if (mine < rank || (mine == rank && is_first)) return true;
  }
  return false;
}

void find_abutting(const bodies::BodySet& bodies, Vec3 min, Vec3 max, std::span<Surface> surfaces) {
  const double size = norm(max - min);
  const double tolerance = k_flush * size;
  std::vector<bodies::Bounds> boxes;
  boxes.reserve(bodies.size());
  for (const Body& body : bodies) {
    boxes.push_back(body.displaces() ? bodies::Bounds{} : bounds(body, min, max));
  }
  std::vector<AbuttingBodies> of_body(bodies.size());
  for (std::size_t j = 1; j < bodies.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const bodies::Bounds both = bodies::common(boxes[i], boxes[j]);
      if (both.is_empty() || !may_touch(bodies[i], bodies[j], min, max, tolerance)) continue;
      const auto add = [&](std::size_t to, std::size_t other) {
        of_body[to].push_back({.body = &bodies[other],
                               .place = bodies[other].placement(0.0),
                               .low = both.low,
                               .high = both.high,
                               .tolerance = tolerance,
                               .rounding = k_rounding * size,
                               .is_first = other < to});
      };
      add(i, j);
      add(j, i);
    }
  }
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    if (of_body[n].empty()) continue;
    const auto all = std::make_shared<const AbuttingBodies>(std::move(of_body[n]));
    for (Surface& s : surfaces) {
      if (s.body == &bodies[n]) s.abutting = all;
    }
  }
}

}  // namespace dust::particles
