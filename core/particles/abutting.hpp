// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/vec3.hpp"

#include <memory>
#include <span>
#include <vector>

namespace dust::particles {

struct Surface;

/// A body that touches another one while both stand still: plates that butt, floors that lie in one
/// plane, a wall on a floor.
struct AbuttingBody {
  const bodies::Body* body = nullptr;
  bodies::Placement place;
  sdk::Vec3 low, high;     ///< [m] the box that both bodies reach into
  double tolerance = 0.0;  ///< [m] surfaces that lie so near to each other are flush, at most
  double rounding = 0.0;   ///< [m] distances that differ by less are the same
  bool is_first = false;   ///< it touches where both are equally near

  /// Whether this body, not the one whose surface `near` is, touches a sphere round `point`: the
  /// foot of the sphere lies on this body or in it, and a part of this one that it lies on is
  /// nearer. `reach` [m]: of the sphere.
  [[nodiscard]] bool takes_over(sdk::Vec3 point, double reach,
                                const bodies::SurfacePoint& near) const;
};
using AbuttingBodies = std::vector<AbuttingBody>;

/// Tells surfaces of bodies that stand still what touches them, so that a sphere touches flush
/// bodies once, as it touches the faces of a mesh (docs/theory/grains.md).
void find_abutting(const bodies::BodySet& bodies, sdk::Vec3 min, sdk::Vec3 max,
                   std::span<Surface> surfaces);

}  // namespace dust::particles
