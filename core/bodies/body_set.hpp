// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"
#include "dust/sdk/motion.hpp"
#include "scenario/setup.hpp"

#include <memory>
#include <string>
#include <vector>

namespace dust::bodies {

/// A solid in the domain: shape, place, material and the velocity of its surface.
struct Body {
  std::string name;
  int material = 0;
  std::unique_ptr<Shape> shape;
  std::unique_ptr<sdk::Motion> motion;  ///< null = at rest
  sdk::Vec3 frame_origin;
  sdk::Vec3 frame_axis{0, 1, 0};
  double frame_angle = 0.0;

  /// Nearest surface point in the domain's frame.
  [[nodiscard]] SurfacePoint nearest(sdk::Vec3 point) const;
  [[nodiscard]] sdk::Vec3 lateral_axis() const;
  /// Velocity [m/s] of the surface at one point (for set-up and tests; loops use the motion's
  /// batch).
  [[nodiscard]] sdk::Vec3 surface_velocity(sdk::Vec3 point, sdk::Vec3 normal, double time) const;
  [[nodiscard]] Triangles triangles(sdk::Vec3 min, sdk::Vec3 max, double edge) const;
};

using BodySet = std::vector<Body>;

/// Makes the body of a specification; the caller supplies the motion.
Body make_body(const scenario::Setup& setup, const scenario::BodySpec& spec,
               std::unique_ptr<sdk::Motion> motion);

}  // namespace dust::bodies
