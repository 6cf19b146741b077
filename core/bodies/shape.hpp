// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dust::bodies {

class LocalAxes;

/// The point of a surface nearest to a given point.
struct SurfacePoint {
  double distance = 0.0;  ///< [m] signed: negative inside the solid
  sdk::Vec3 normal;       ///< outward unit normal of the surface there
};

/// Straight piece of a body's outline in a side view, or a curve cut into pieces: for pictures and
/// for the written surfaces. Triangles, three corners each.
using Triangles = std::vector<sdk::Vec3>;

/// Spheres and where they touch, in columns: one part, many grains, no call per grain.
struct ClosestPoints {
  std::size_t count = 0;
  const double* x = nullptr;  ///< [m] centres
  const double* y = nullptr;
  const double* z = nullptr;
  const double* reach = nullptr;  ///< [m] as of Shape::contact
  /// -1 at first, then what the shape remembers of the sphere's last place (a triangle) so as to
  /// find the next faster.
  std::int32_t* hint = nullptr;
  double* distance = nullptr;  ///< [m]
  double* normal_x = nullptr;
  double* normal_y = nullptr;
  double* normal_z = nullptr;

  void put(std::size_t n, const SurfacePoint& s) const {
    distance[n] = s.distance;
    normal_x[n] = s.normal.x;
    normal_y[n] = s.normal.y;
    normal_z[n] = s.normal.z;
  }
};

/// A solid with an exact surface, in its own frame. A sphere touches each of its parts once, where
/// it is nearest. Most shapes are one part: convex ones, and round hollow ones (tube, funnel,
/// orifice) where no sphere is wider than the hole; those with corners towards the grains have
/// several.
class Shape {
 public:
  virtual ~Shape() = default;
  /// Called before anything else, with the radius [m] of the largest sphere that will come: on
  /// it depends what parts a shape has.
  virtual void expect_spheres(double /*largest_radius*/) {}
  /// Nearest surface point; exact, also at edges and corners.
  [[nodiscard]] virtual SurfacePoint nearest(sdk::Vec3 point) const = 0;
  [[nodiscard]] virtual int parts() const { return 1; }
  /// Where a sphere round `point` touches a part: as `nearest`, or infinitely far where it cannot
  /// touch this part (another one is nearer at an edge they share) or has no point nearer than
  /// `reach` [m].
  [[nodiscard]] virtual SurfacePoint contact(int /*part*/, sdk::Vec3 point,
                                             double /*reach*/) const {
    return nearest(point);
  }
  /// `contact` of many spheres.
  virtual void touch(int part, const ClosestPoints& spheres) const = 0;
  /// Whether the part is nearer than `reach` [m], so that a sphere may come to touch it: for lists.
  [[nodiscard]] virtual bool is_within(int /*part*/, sdk::Vec3 point, double reach) const {
    return nearest(point).distance < reach;
  }
  /// The parts of which that is so, ascending; `parts` is emptied first.
  virtual void find_within(sdk::Vec3 point, double reach, std::vector<std::int32_t>& parts) const;
  /// Whether it has an inside, so that the air can be cut by it.
  [[nodiscard]] virtual bool is_solid() const { return true; }
  /// What to tell of it in the log, and what the user should look at.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
  /// [m] Shortest edge of a mesh, 0 for exact surfaces.
  [[nodiscard]] virtual double shortest_edge() const { return 0.0; }
  /// [m] Thinnest wall of a mesh, thickness of a sheet; 0 for exact surfaces and sheets without.
  [[nodiscard]] virtual double thinnest_wall() const { return 0.0; }
  /// The surface as triangles inside the box [min, max], curved parts with at most `edge` [m].
  [[nodiscard]] virtual Triangles triangles(sdk::Vec3 min, sdk::Vec3 max, double edge) const = 0;
  /// Lateral axis (unit): the pulley's axis of a conveyor, the width of a plate.
  [[nodiscard]] virtual sdk::Vec3 lateral_axis() const = 0;
  /// Whether a belt on it bends round an axis anywhere, as on a conveyor's pulleys.
  [[nodiscard]] virtual bool is_bent() const { return false; }
  /// How a belt on it bends at points of the surface, unless local_axes() say it: the vector [m] to
  /// the point from the axis that it bends round, over its length squared; zero on flat runs.
  virtual void find_bends(std::size_t count, const double* const* /*point*/,
                          double* const* bend) const {
    for (int d = 0; d < 3; ++d) std::fill_n(bend[d], count, 0.0);
  }
  /// Where the lateral axis differs from place to place; else null.
  [[nodiscard]] virtual const LocalAxes* local_axes() const { return nullptr; }
  /// Whether the shape stays where it is when it turns about the line through `point` along the
  /// unit vector `axis`: a drum about its own axis.
  [[nodiscard]] virtual bool is_unchanged_by_turning(sdk::Vec3, sdk::Vec3) const { return false; }
  /// Where surfaces run together so that a sphere of `radius` [m] is drawn in and has no room: what
  /// place of the shape this is, if the point is there; else empty. For messages.
  [[nodiscard]] virtual std::string nip_at(sdk::Vec3 /*point*/, double /*radius*/) const {
    return {};
  }
};

/// Base of a shape S of one part: its `nearest`, without a virtual call per sphere.
template <class S>
class OnePart : public Shape {
 public:
  void touch(int /*part*/, const ClosestPoints& spheres) const final {
    const S& shape = static_cast<const S&>(*this);
    for (std::size_t n = 0; n < spheres.count; ++n) {
      spheres.put(n, shape.S::nearest({spheres.x[n], spheres.y[n], spheres.z[n]}));
    }
  }
};

/// A kind of shape: how a scenario names it and what it needs.
struct ShapeKind {
  std::string name;
  std::string summary;
  sdk::ParameterSchema parameters;
  std::function<std::unique_ptr<Shape>(std::span<const sdk::Value>)> make;
};

/// All shapes the core knows.
const std::vector<ShapeKind>& shape_catalogue();

}  // namespace dust::bodies
