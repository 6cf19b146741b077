// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

#include <limits>

namespace dust::bodies {

/// A box along the axes [m]; empty as it is made.
struct Bounds {
  static constexpr double k_far = std::numeric_limits<double>::infinity();
  sdk::Vec3 low{k_far, k_far, k_far};
  sdk::Vec3 high{-k_far, -k_far, -k_far};

  [[nodiscard]] bool is_empty() const;
  /// By `margin` [m] on every side.
  [[nodiscard]] Bounds grown(double margin) const;
};

[[nodiscard]] Bounds bounds_of(const Triangles& corners);
/// Of a body at a placement, as far as a box that is `size` [m] larger on every side than the one
/// from `min` to `max`; curved faces as chords within `edge` [m], see Body::triangles.
[[nodiscard]] Bounds bounds_of(const Body& body, const Placement& placement, sdk::Vec3 min,
                               sdk::Vec3 max, double size, double edge);

[[nodiscard]] Bounds common(const Bounds& a, const Bounds& b);
/// [m] Between two boxes; 0 where they meet.
[[nodiscard]] double distance(const Bounds& a, const Bounds& b);

}  // namespace dust::bodies
