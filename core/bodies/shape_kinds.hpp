// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace dust::bodies {

ShapeKind conveyor_kind();
ShapeKind belt_conveyor_kind();
ShapeKind plate_kind();
ShapeKind plane_kind();
ShapeKind box_kind();
ShapeKind cylinder_kind();
ShapeKind frustum_kind();
ShapeKind cone_kind();
ShapeKind disc_kind();
ShapeKind container_kind();
ShapeKind mesh_kind();

/// The kind of the shape `S`, which has `struct Parameters`, `static ParameterSchema schema()` and
/// a constructor from `Parameters`.
template <class S>
ShapeKind make_kind(std::string name, std::string summary) {
  auto schema = S::schema();
  return {
      std::move(name), std::move(summary), schema, [schema](std::span<const sdk::Value> values) {
        return std::make_unique<S>(sdk::parameters_from<typename S::Parameters>(schema, values));
      }};
}

inline void add_quad(Triangles& t, sdk::Vec3 a, sdk::Vec3 b, sdk::Vec3 c, sdk::Vec3 d) {
  t.insert(t.end(), {a, b, c, a, c, d});
}

/// What the line from `a` to `b` sweeps along y, between `low` and `high`.
inline void add_strip(Triangles& t, sdk::Vec3 a, sdk::Vec3 b, double low, double high) {
  a.y = b.y = low;
  sdk::Vec3 c = b;
  sdk::Vec3 d = a;
  c.y = d.y = high;
  add_quad(t, a, b, c, d);
}

/// A unit vector perpendicular to the unit vector `axis`: the axis of the domain least along it,
/// made perpendicular.
inline sdk::Vec3 perpendicular(sdk::Vec3 axis) {
  int least = 0;
  for (int d = 1; d < 3; ++d) {
    if (std::abs(axis[d]) < std::abs(axis[least])) least = d;
  }
  sdk::Vec3 e;
  e[least] = 1.0;
  e -= dot(e, axis) * axis;
  return e / norm(e);
}

/// `v` as a unit vector; a ParameterError that names `parameter` when it has no direction.
sdk::Vec3 unit_direction(sdk::Vec3 v, const char* parameter);

}  // namespace dust::bodies
