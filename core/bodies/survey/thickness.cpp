// SPDX-License-Identifier: Apache-2.0
#include "bodies/survey/thickness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::bodies {
namespace {

using sdk::Vec3;

constexpr std::size_t k_max_triangles = 5000;
/// Depths below a point of the surface at which the body may have ended, per cell.
constexpr int k_depths = 8;
constexpr int k_halvings = 20;
/// Of a cell: a wall of its width is none that is thinner.
constexpr double k_rounding = 1e-6;

/// How thick a body is below points of its surface.
class Thickness {
 public:
  Thickness(const Body& body, Vec3 cell) : body_(body), at_(body.placement(0.0)), cell_(cell) {}

  /// Below the point of the surface that is nearest to `point`, if it is less than a cell there.
  [[nodiscard]] std::optional<ThinPlace> below(Vec3 point) const {
    const SurfacePoint surface = body_.nearest(point, at_);
    const Vec3 place = point - surface.distance * surface.normal;
    const Vec3& n = surface.normal;
    const double width = norm(Vec3{n.x * cell_.x, n.y * cell_.y, n.z * cell_.z});
    const auto is_inside = [&](double depth) {
      return body_.nearest(place - depth * n, at_).distance < 0.0;
    };
    double inside = 0.0;
    for (int k = 1; k <= k_depths; ++k) {
      double outside = (1.0 - k_rounding) * width * k / k_depths;
      if (is_inside(outside)) {
        inside = outside;
        continue;
      }
      for (int h = 0; h < k_halvings; ++h) {
        const double middle = 0.5 * (inside + outside);
        (is_inside(middle) ? inside : outside) = middle;
      }
      return ThinPlace{outside, width, place};
    }
    return std::nullopt;
  }

 private:
  const Body& body_;
  Placement at_;
  Vec3 cell_;
};

}  // namespace

std::optional<ThinPlace> thinnest_place(const Body& body, Vec3 min, Vec3 max, Vec3 cell) {
  if (!body.shape->is_solid()) return std::nullopt;
  const Thickness thickness(body, cell);
  const Triangles surface =
      body.triangles(min, max, std::max(norm(cell), norm(max - min) / 100.0), body.placement(0.0));
  const std::size_t count = surface.size() / 3;
  const std::size_t stride = 1 + count / k_max_triangles;
  std::optional<ThinPlace> found;
  for (std::size_t t = 0; t < count; t += stride) {
    const Vec3* corner = &surface[3 * t];
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    const std::array<Vec3, 4> points{middle, 0.5 * (middle + corner[0]), 0.5 * (middle + corner[1]),
                                     0.5 * (middle + corner[2])};
    for (const Vec3 point : points) {
      const auto is_out = [&](int d) { return point[d] < min[d] || point[d] > max[d]; };
      if (is_out(0) || is_out(1) || is_out(2)) continue;
      const auto thin = thickness.below(point);
      if (thin && (!found || thin->thickness < found->thickness)) found = thin;
    }
  }
  return found;
}

}  // namespace dust::bodies
