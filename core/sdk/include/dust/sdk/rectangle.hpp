// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/error.hpp"
#include "dust/sdk/sampling.hpp"
#include "dust/sdk/vec3.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace dust::sdk {

/// A part of a plane that a box cuts out, and what passes through it.
class Rectangle {
 public:
  /// `normal` need not have length 1; the box may have no thickness along it. ParameterError that
  /// names 'normal' or 'max' where they are none, or says that the box cuts no area out.
  Rectangle(Vec3 point, Vec3 normal, Vec3 min, Vec3 max)
      : point_(point),
        min_(min),
        max_(max),
        tolerance_(k_rounding * (norm(min) + norm(max) + norm(point))) {
    const double length = norm(normal);
    if (!(length > 0.0)) throw ParameterError("'normal' must not be zero");
    normal_ = normal / length;
    const Vec3 extent = max - min;
    if (!(extent.x >= 0.0 && extent.y >= 0.0 && extent.z >= 0.0)) {
      throw ParameterError("'max' must not lie below 'min'");
    }
    // Of a flat box only a plane along its face cuts more than a line out.
    for (int d = 0; d < 3; ++d) {
      if (extent[d] > 0.0 || is_normal_along(d)) continue;
      throw ParameterError(std::string("the opening has no area: it has no width along ") +
                           "xyz"[d] + ", and the normal does not lie along that");
    }
  }

  /// Of length 1.
  [[nodiscard]] Vec3 normal() const { return normal_; }

  /// [m2]; ParameterError where the normal lies along no axis.
  [[nodiscard]] double area() const {
    for (int d = 0; d < 3; ++d) {
      if (!is_normal_along(d)) continue;
      const Vec3 extent = max_ - min_;
      return extent[(d + 1) % 3] * extent[(d + 2) % 3];
    }
    throw ParameterError("'normal' must lie along one axis");
  }

  /// +1 along the normal, -1 against it, 0: not through the rectangle.
  [[nodiscard]] int passage_of(const Path& path) const {
    const Passage p = passage(dot(path.before - point_, normal_), dot(path.now - point_, normal_));
    if (p.direction == 0) return 0;
    const Vec3 x = path.at(p.fraction);
    for (int d = 0; d < 3; ++d) {
      if (x[d] < min_[d] - tolerance_ || x[d] > max_[d] + tolerance_) return 0;
    }
    return p.direction;
  }

  /// The same of grain `i` between two samples, through periodic sides as well.
  [[nodiscard]] int passage_of(const WorldView& world, std::size_t i) const {
    int direction = 0;
    any_way(world, i, [&](const Path& way) {
      direction = passage_of(way);
      return direction != 0;
    });
    return direction;
  }

 private:
  static constexpr double k_rounding = 1e-12;
  [[nodiscard]] bool is_normal_along(int d) const {
    return std::abs(normal_[d]) > 1.0 - k_rounding;
  }

  Vec3 point_, normal_, min_, max_;
  /// Rounding of the interpolated point must not throw a grain out of a box without thickness.
  double tolerance_;
};

}  // namespace dust::sdk
