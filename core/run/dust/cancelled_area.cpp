// SPDX-License-Identifier: Apache-2.0
#include "run/dust/cancelled_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace dust::run {
namespace {

using fluid::BodyField;
using sdk::Vec3;

constexpr int k_parts = 8;  ///< of an edge of the box
constexpr int k_points = k_parts + 1;
/// Of a normal's part along `up`: surfaces that stand upright look neither up nor down.
constexpr double k_upright = 0.01;
/// Product of the normals below which two surfaces look away from each other: those of a
/// right-angled edge do not, however the lattice rounds them.
constexpr double k_look_away = -0.2;

Vec3 corner_of(Vec3 centre, Vec3 size, int n) {
  return centre + Vec3{(n & 1 ? 0.5 : -0.5) * size.x, (n & 2 ? 0.5 : -0.5) * size.y,
                       (n & 4 ? 0.5 : -0.5) * size.z};
}

/// Is there surface in the box that looks up and surface that looks down, all of one body? As its
/// corners see it.
bool may_cancel(const BodyField& bodies, Vec3 centre, Vec3 size, Vec3 up) {
  const double reach = norm(size);
  bool looks_up = false, looks_down = false;
  std::optional<int> body;
  for (int n = 0; n < 8; ++n) {
    const BodyField::Hit hit = bodies.nearest(corner_of(centre, size, n));
    if (std::abs(hit.distance) > reach) continue;
    if (body && *body != hit.body) return false;
    body = hit.body;
    const double along = dot(hit.normal, up);
    looks_up = looks_up || along > k_upright;
    looks_down = looks_down || along < -k_upright;
  }
  return looks_up && looks_down;
}

/// Open share of a part of the box round each point of the lattice, the surface a plane there.
class OpenShares {
 public:
  OpenShares(const BodyField& bodies, Vec3 centre, Vec3 size) : part_(size / k_parts) {
    for (int c = 0; c < k_points; ++c) {
      for (int b = 0; b < k_points; ++b) {
        for (int a = 0; a < k_points; ++a) {
          const Vec3 p = centre - 0.5 * size + Vec3{a * part_.x, b * part_.y, c * part_.z};
          const BodyField::Hit hit = bodies.nearest(p);
          const double width = std::abs(hit.normal.x) * part_.x + std::abs(hit.normal.y) * part_.y +
                               std::abs(hit.normal.z) * part_.z;
          at(a, b, c) = std::clamp(0.5 + hit.distance / width, 0.0, 1.0);
        }
      }
    }
  }
  /// [1/m] Its change over the part of the box above a point: into the open.
  [[nodiscard]] Vec3 slope(int a, int b, int c) const {
    Vec3 sum;
    for (int n = 0; n < 8; ++n) {
      const int i = n & 1, j = (n >> 1) & 1, k = (n >> 2) & 1;
      const double open = at(a + i, b + j, c + k);
      sum += 0.25 * open * Vec3{i != 0 ? 1.0 : -1.0, j != 0 ? 1.0 : -1.0, k != 0 ? 1.0 : -1.0};
    }
    return {sum.x / part_.x, sum.y / part_.y, sum.z / part_.z};
  }

 private:
  double& at(int a, int b, int c) { return open_[index(a, b, c)]; }
  [[nodiscard]] double at(int a, int b, int c) const { return open_[index(a, b, c)]; }
  static std::size_t index(int a, int b, int c) {
    return static_cast<std::size_t>(a + k_points * (b + k_points * c));
  }

  Vec3 part_;
  std::array<double, static_cast<std::size_t>(k_points* k_points* k_points)> open_{};
};

}  // namespace

double cancelled_area(const BodyField& bodies, Vec3 centre, Vec3 size, Vec3 up) {
  if (!may_cancel(bodies, centre, size, up)) return 0.0;
  const OpenShares shares(bodies, centre, size);
  Vec3 upper, lower;
  for (int c = 0; c < k_parts; ++c) {
    for (int b = 0; b < k_parts; ++b) {
      for (int a = 0; a < k_parts; ++a) {
        const Vec3 slope = shares.slope(a, b, c);
        (dot(slope, up) > 0.0 ? upper : lower) += slope;
      }
    }
  }
  constexpr double k_all = k_parts * k_parts * k_parts;
  const double both = norm(upper) * norm(lower);
  if (!(both > 0.0) || dot(upper, lower) < k_look_away * both) return 0.0;
  return std::min(dot(upper, up), -dot(lower, up)) / k_all;
}

}  // namespace dust::run
