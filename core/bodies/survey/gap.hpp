// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

#include <cstddef>
#include <limits>

namespace dust::bodies {

/// Where a gap is looked for, and how long.
struct GapSearch {
  sdk::Vec3 min;         ///< [m] box that the closest points lie in
  sdk::Vec3 max;         ///< [m]
  double limit = 0.0;    ///< [m] wider gaps are of no interest
  std::size_t work = 0;  ///< nearest points that may be asked for
};

/// The narrowest place between two bodies where they are as the run begins.
struct Gap {
  /// [m] 0 where they touch or overlap, infinite where they are farther apart than the limit.
  double width = std::numeric_limits<double>::infinity();
  sdk::Vec3 place;       ///< [m] on the surface of the second
  std::size_t work = 0;  ///< nearest points that were asked for
  bool is_whole = true;  ///< false: the work was not enough to look everywhere
};

/// The smallest gap between `a` and `b`. The surface of `a` is cut into triangles; those that may
/// come nearer than the best found so far are halved down to an eighth of the limit, nearest first;
/// from the best places the closest points are found by projection from surface to surface in turn
/// (von Neumann, Functional Operators II, 1950). So a gap narrower than what is told is missed only
/// where it is shorter than an eighth of the limit.
Gap smallest_gap(const Body& a, const Body& b, const GapSearch& search);

}  // namespace dust::bodies
