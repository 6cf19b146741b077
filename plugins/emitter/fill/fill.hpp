// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace dust::model::fill {

using Point = std::array<double, 3>;

/// Volume [m3] of a frustum of `length` [m] between the radii `a` and `b` [m]:
/// \f$ V = \pi L (a^2 + ab + b^2) / 3 \f$.
inline double frustum_volume(double length, double a, double b) {
  return std::numbers::pi / 3.0 * length * (a * a + a * b + b * b);
}

/// Distance [m] of a point from the mantle of a frustum, positive inside: the point lies `along`
/// [m] the axis and `off` [m] from it; the radius goes from `a` to `b` [m] over `length` [m].
inline double mantle_clearance(double along, double off, double length, double a, double b) {
  const double slope = (b - a) / length;
  return (a + slope * along - off) / std::sqrt(1.0 + slope * slope);
}

/// Spheres placed so far, in cells at least as wide as the largest sphere, so that only
/// neighbouring cells can hold one that touches.
class PlacedSpheres {
 public:
  /// `low`, `high` [m]: corners of the region; `largest` [m] diameter; `count` of spheres to come.
  PlacedSpheres(const Point& low, const Point& high, double largest, std::int64_t count)
      : low_(low) {
    double volume = 1.0;
    for (std::size_t d = 0; d < 3; ++d) volume *= high[d] - low[d];
    // No more cells than a few per sphere, however small they are.
    edge_ = std::max(largest, std::cbrt(volume / (4.0 * static_cast<double>(count) + 1.0)));
    for (std::size_t d = 0; d < 3; ++d) {
      cells_[d] = 1 + static_cast<std::ptrdiff_t>((high[d] - low[d]) / edge_);
    }
    first_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), -1);
  }

  /// Whether a sphere keeps clear of all others by `gap` [-] of the sum of radii.
  [[nodiscard]] bool is_free(const Point& x, double radius, double gap) const {
    const auto c = cell_of(x);
    for (auto k = std::max<std::ptrdiff_t>(0, c[2] - 1); k <= std::min(cells_[2] - 1, c[2] + 1);
         ++k) {
      for (auto j = std::max<std::ptrdiff_t>(0, c[1] - 1); j <= std::min(cells_[1] - 1, c[1] + 1);
           ++j) {
        for (auto i = std::max<std::ptrdiff_t>(0, c[0] - 1); i <= std::min(cells_[0] - 1, c[0] + 1);
             ++i) {
          for (std::int32_t n = first_[index(i, j, k)]; n >= 0;
               n = next_[static_cast<std::size_t>(n)]) {
            const Sphere& s = spheres_[static_cast<std::size_t>(n)];
            const double reach = (radius + s.radius) * (1.0 + gap);
            double apart2 = 0.0;
            for (std::size_t d = 0; d < 3; ++d) apart2 += (x[d] - s.x[d]) * (x[d] - s.x[d]);
            if (apart2 < reach * reach) return false;
          }
        }
      }
    }
    return true;
  }
  void add(const Point& x, double radius) {
    const auto c = cell_of(x);
    std::int32_t& head = first_[index(c[0], c[1], c[2])];
    next_.push_back(head);
    head = static_cast<std::int32_t>(spheres_.size());
    spheres_.push_back({x, radius});
  }

 private:
  struct Sphere {
    Point x;
    double radius;
  };
  [[nodiscard]] std::array<std::ptrdiff_t, 3> cell_of(const Point& x) const {
    std::array<std::ptrdiff_t, 3> c{};
    for (std::size_t d = 0; d < 3; ++d) {
      c[d] = std::clamp(static_cast<std::ptrdiff_t>((x[d] - low_[d]) / edge_), std::ptrdiff_t{0},
                        cells_[d] - 1);
    }
    return c;
  }
  [[nodiscard]] std::size_t index(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
    return static_cast<std::size_t>(i + cells_[0] * (j + cells_[1] * k));
  }

  Point low_;
  double edge_ = 1.0;
  std::array<std::ptrdiff_t, 3> cells_{1, 1, 1};
  std::vector<std::int32_t> first_;
  std::vector<std::int32_t> next_;
  std::vector<Sphere> spheres_;
};

}  // namespace dust::model::fill
