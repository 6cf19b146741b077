// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "bodies/bounds.hpp"

namespace dust::bodies {

[[nodiscard]] Bounds bounds_of(const Triangles& corners);
/// Of a body at a placement, as far as a box that is `size` [m] larger on every side than the one
/// from `min` to `max`; curved faces as chords within `edge` [m], see Body::triangles.
[[nodiscard]] Bounds bounds_of(const Body& body, const Placement& placement, sdk::Vec3 min,
                               sdk::Vec3 max, double size, double edge);

[[nodiscard]] Bounds common(const Bounds& a, const Bounds& b);
/// [m] Between two boxes; 0 where they meet.
[[nodiscard]] double distance(const Bounds& a, const Bounds& b);

}  // namespace dust::bodies
