// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "bodies/shape.hpp"
#include "dust/sdk/vec3.hpp"

#include <string>

namespace dust::bodies {

/// A shape of which a part runs with its surface, as the cleats of a belt do: another solid at each
/// instant, the same again whenever the surface has run on by spacing(). `run` [m] is how far it
/// has run, from 0 to spacing(); all points are in the shape's frame. Of the shape's parts the
/// first stays in its place and the others go to others.
class RunningParts {
 public:
  static constexpr int k_static = 0;   ///< part of Shape::contact
  static constexpr int k_running = 1;  ///< and all after it
  /// What a motion has to be asked for the velocity of a point: `factor` times its answer.
  struct VelocityQuery {
    sdk::Vec3 axis;
    sdk::Vec3 normal;
    double factor = 1.0;
    sdk::Vec3 bend;  ///< [1/m] as of Shape::find_bends
  };
  virtual ~RunningParts() = default;
  [[nodiscard]] virtual double spacing() const = 0;               ///< [m]
  [[nodiscard]] virtual sdk::Vec3 running_direction() const = 0;  ///< unit, of the carrying run
  /// Speed of the fastest point over that of the surface.
  [[nodiscard]] virtual double largest_factor() const = 0;
  /// As of Shape.
  [[nodiscard]] virtual SurfacePoint nearest_after(double run, sdk::Vec3 point) const = 0;
  [[nodiscard]] virtual SurfacePoint contact_after(double run, int part, sdk::Vec3 point,
                                                   double reach) const = 0;
  [[nodiscard]] virtual Triangles triangles_after(double run, sdk::Vec3 min, sdk::Vec3 max,
                                                  double edge) const = 0;
  /// Of a point of the surface with its normal.
  [[nodiscard]] virtual VelocityQuery velocity_query_after(double run, sdk::Vec3 point,
                                                           sdk::Vec3 normal) const = 0;
};

/// Those of a body, null if none. Its placement is that of its parts on the carrying run: shifted
/// along it by how far they have run.
const RunningParts* running_parts(const Body& body);
/// How far the surface of a body with running parts has run at a placement.
double run_at(const Body& body, const RunningParts& parts, const Placement& at);
/// Speed [m/s] along its normal of a point of a body's surface that is placed so.
double normal_speed(const Body& body, const Placement& at, sdk::Vec3 point, sdk::Vec3 normal);
/// Why the motions of a body cannot move its running parts; empty if they can.
std::string motion_conflict(const Body& body);

}  // namespace dust::bodies
