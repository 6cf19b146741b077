// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <array>

namespace dust::airborne {

/// What a plane leaves in a box: a polygon, of which each edge lies on a face of the box.
struct PlaneCut {
  /// On the lower and upper face in x, y, z; no length where the plane does not meet it.
  struct Edge {
    double length = 0.0;  ///< [m]
    sdk::Vec3 middle;     ///< [m] from the middle of the box
  };
  std::array<Edge, 6> edges;
  double area = 0.0;  ///< [m2]
  sdk::Vec3 centre;   ///< [m] from the middle of the box
};

/// The plane of unit `normal` that passes the middle of a box of edges `size` at `offset` [m].
/// Nothing where it does not meet the box.
[[nodiscard]] PlaneCut cut_box(sdk::Vec3 size, sdk::Vec3 normal, double offset);

/// The same at the offset, on the side of the middle where `offset` is, at which the polygon has
/// this area [m2], or the largest that there is. A surface known by its area and normal, as the
/// open shares of a cell's faces give them, is put where it meets the faces that it must meet.
[[nodiscard]] PlaneCut cut_box_of_area(sdk::Vec3 size, sdk::Vec3 normal, double offset,
                                       double area);

}  // namespace dust::airborne
