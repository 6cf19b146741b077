// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/vec3.hpp"
#include "scenario/setup.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dust::particles {

/// A side of the domain that is a wall, or a body. Grains touch it once.
struct Surface {
  std::string name;
  int material = 0;
  const bodies::Body* body = nullptr;  ///< null: the plane below
  sdk::Vec3 normal;                    ///< into the domain
  double offset = 0.0;                 ///< [m] dot(normal, point of the plane)

  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 point) const {
    if (body != nullptr) return body->nearest(point);
    return {dot(normal, point) - offset, normal};
  }
};

std::vector<Surface> surfaces_of(const scenario::Setup& setup, const bodies::BodySet& bodies);

/// Surface velocities of `count` columns of points and normals at `time` [s].
void surface_velocities(const Surface& surface, double time, std::size_t count,
                        const double* const* point, const double* const* normal,
                        double* const* velocity);

}  // namespace dust::particles
