// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape_kinds.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>

namespace dust::bodies {

using sdk::Vec3;

Vec3 unit_direction(Vec3 v, const char* parameter) {
  const double length = norm(v);
  if (!(length > 0.0)) throw sdk::ParameterError(std::string(parameter) + " has no direction");
  return v / length;
}

namespace {

using sdk::SchemaOf;
namespace dimension = sdk::dimension;

/// Everything behind a plane is solid: distance = (x - p) . n.
class Plane final : public OnePart<Plane> {
 public:
  struct Parameters {
    Vec3 point;
    Vec3 normal;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::point, "point", dimension::length, "A point of the plane.");
    s.vector(&Parameters::normal, "normal", dimension::none,
             "Direction out of the solid, towards the grains; its length does not matter.");
    return s.build();
  }
  explicit Plane(const Parameters& p)
      : point_(p.point), normal_(unit_direction(p.normal, "normal")) {}

  [[nodiscard]] SurfacePoint nearest(Vec3 x) const override {
    return {dot(x - point_, normal_), normal_};
  }
  /// Horizontal where the plane allows it: a belt motion on a floor (n = +z) runs to +x.
  [[nodiscard]] Vec3 lateral_axis() const override {
    const Vec3 y{0, 1, 0};
    const Vec3 along = y - dot(y, normal_) * normal_;
    const double length = norm(along);
    return length > 1e-6 ? along / length : Vec3{1, 0, 0};
  }
  /// The polygon in which the plane cuts the box.
  [[nodiscard]] Triangles triangles(Vec3 min, Vec3 max, double) const override {
    const Vec3 e = perpendicular(normal_);
    const Vec3 f = cross(normal_, e);
    const Vec3 middle = 0.5 * (min + max);
    const Vec3 foot = middle - dot(middle - point_, normal_) * normal_;
    const double size = norm(max - min);
    std::vector<Vec3> polygon;
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      polygon.push_back(foot + (a * size) * e + (b * size) * f);
    }
    for (int d = 0; d < 3; ++d) {
      cut(polygon, d, min[d], 1.0);
      cut(polygon, d, max[d], -1.0);
    }
    Triangles t;
    for (std::size_t n = 2; n < polygon.size(); ++n) {
      t.insert(t.end(), {polygon[0], polygon[n - 1], polygon[n]});
    }
    return t;
  }

 private:
  /// Keeps the part of a convex polygon with sign * (x_d - limit) >= 0.
  static void cut(std::vector<Vec3>& polygon, int d, double limit, double sign) {
    std::vector<Vec3> kept;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
      const Vec3 a = polygon[n];
      const Vec3 b = polygon[(n + 1) % polygon.size()];
      const double in_a = sign * (a[d] - limit);
      const double in_b = sign * (b[d] - limit);
      if (in_a >= 0.0) kept.push_back(a);
      if ((in_a > 0.0 && in_b < 0.0) || (in_a < 0.0 && in_b > 0.0)) {
        Vec3 p = a + (in_a / (in_a - in_b)) * (b - a);
        p[d] = limit;
        kept.push_back(p);
      }
    }
    polygon.swap(kept);
  }

  Vec3 point_;
  Vec3 normal_;
};

}  // namespace

ShapeKind plane_kind() {
  return make_kind<Plane>("plane", "Endless plane; everything behind it is solid.");
}

}  // namespace dust::bodies
