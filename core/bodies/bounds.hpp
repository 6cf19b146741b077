// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <limits>

namespace dust::bodies {

/// A box along the axes [m]; empty as it is made.
struct Bounds {
  static constexpr double k_far = std::numeric_limits<double>::infinity();
  sdk::Vec3 low{k_far, k_far, k_far};
  sdk::Vec3 high{-k_far, -k_far, -k_far};

  [[nodiscard]] bool is_empty() const {
    return !(low.x <= high.x && low.y <= high.y && low.z <= high.z);
  }
  /// By `margin` [m] on every side.
  [[nodiscard]] Bounds grown(double margin) const {
    const sdk::Vec3 m{margin, margin, margin};
    return {low - m, high + m};
  }
  /// [m2] Square of the distance to a point; 0 inside.
  [[nodiscard]] double distance2(sdk::Vec3 point) const {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double off = std::max({low[d] - point[d], point[d] - high[d], 0.0});
      sum += off * off;
    }
    return sum;
  }
};

inline void include(Bounds& all, const Bounds& other) {
  for (int d = 0; d < 3; ++d) {
    all.low[d] = std::min(all.low[d], other.low[d]);
    all.high[d] = std::max(all.high[d], other.high[d]);
  }
}
inline void include(Bounds& all, sdk::Vec3 point) { include(all, Bounds{point, point}); }

}  // namespace dust::bodies
