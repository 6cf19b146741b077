// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "particles/surfaces.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Finds surfaces that spheres may touch. A body is asked as a whole, so that what it costs does
/// not grow with the number of its parts.
class SurfaceSearch {
 public:
  /// Numbers of those of which Surface::may_touch holds, ascending; valid until the next call.
  /// `surfaces`: as surfaces_of() makes them, the parts of a body one after the other.
  std::span<const std::int32_t> may_touch(std::span<const Surface> surfaces, sdk::Vec3 point,
                                          double reach, double duration);

 private:
  std::vector<std::int32_t> found_;
  std::vector<std::int32_t> parts_;
};

/// A surface and what of it is nearest to a point.
struct NearestSurface {
  const Surface* surface = nullptr;  ///< null: none within reach
  bodies::SurfacePoint point;
};
/// The surface nearest to `point` within `reach` [m], as they stood at their last move_to.
NearestSurface nearest_surface(std::span<const Surface> surfaces, sdk::Vec3 point, double reach);

}  // namespace dust::particles
