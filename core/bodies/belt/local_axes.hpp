// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

namespace dust::bodies {

class RunningParts;

/// A shape whose lateral axis is another from place to place, as that of the rolls of a trough is,
/// derives from this too,
/// and is its own Shape::local_axes().
class LocalAxes {
 public:
  virtual ~LocalAxes() = default;
  /// Lateral axis (unit) at a point of the surface: square to the normal there, and such that a
  /// belt on it runs along axis x normal.
  [[nodiscard]] virtual sdk::Vec3 lateral_axis_at(sdk::Vec3 point, sdk::Vec3 normal) const = 0;
  /// How a belt on it bends at a point of the surface, as Shape::find_bends.
  [[nodiscard]] virtual sdk::Vec3 bend_at(sdk::Vec3 /*point*/) const { return {}; }
  /// What stands on the surface and runs with it; null: nothing.
  [[nodiscard]] virtual const RunningParts* running_parts() const { return nullptr; }
};

}  // namespace dust::bodies
