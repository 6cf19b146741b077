// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/vec3.hpp"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dust::bodies {

/// The point of a surface nearest to a given point.
struct SurfacePoint {
  double distance = 0.0;  ///< [m] signed: negative inside the solid
  sdk::Vec3 normal;       ///< outward unit normal of the surface there
};

/// Straight piece of a body's outline in a side view, or a curve cut into pieces: for pictures and
/// for the written surfaces. Triangles, three corners each.
using Triangles = std::vector<sdk::Vec3>;

/// A solid with an exact surface, in its own frame. Convex, so that a sphere touches it once.
class Shape {
 public:
  virtual ~Shape() = default;
  /// Nearest surface point; exact, also at edges and corners.
  [[nodiscard]] virtual SurfacePoint nearest(sdk::Vec3 point) const = 0;
  /// The surface as triangles inside the box [min, max], curved parts with at most `edge` [m].
  [[nodiscard]] virtual Triangles triangles(sdk::Vec3 min, sdk::Vec3 max, double edge) const = 0;
  /// Lateral axis (unit): the pulley's axis of a conveyor, the width of a plate.
  [[nodiscard]] virtual sdk::Vec3 lateral_axis() const = 0;
};

/// A kind of shape: how a scenario names it and what it needs.
struct ShapeKind {
  std::string name;
  std::string summary;
  sdk::ParameterSchema parameters;
  std::function<std::unique_ptr<Shape>(std::span<const sdk::Value>)> make;
};

/// All shapes the core knows: conveyor, plate.
const std::vector<ShapeKind>& shape_catalogue();

}  // namespace dust::bodies
