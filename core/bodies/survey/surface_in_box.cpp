// SPDX-License-Identifier: Apache-2.0
#include "bodies/survey/surface_in_box.hpp"

#include <cmath>

namespace dust::bodies {
namespace {

/// Parts looked at; a surface that runs along the box without meeting it needs many.
constexpr int k_max_parts = 20000;

bool may_meet(const Body& body, const Placement& placement, sdk::Vec3 middle, sdk::Vec3 half,
              double finest, int& parts) {
  const double reach = norm(half);
  if (std::abs(body.nearest(middle, placement).distance) > reach) return false;
  if (reach <= finest || ++parts > k_max_parts) return true;
  int d = half.y > half.x ? 1 : 0;
  if (half.z > half[d]) d = 2;
  half[d] *= 0.5;
  sdk::Vec3 other = middle;
  middle[d] -= half[d];
  other[d] += half[d];
  return may_meet(body, placement, middle, half, finest, parts) ||
         may_meet(body, placement, other, half, finest, parts);
}

}  // namespace

bool may_meet_box(const Body& body, const Placement& placement, sdk::Vec3 middle, sdk::Vec3 half,
                  double finest) {
  int parts = 0;
  return may_meet(body, placement, middle, half, finest, parts);
}

}  // namespace dust::bodies
