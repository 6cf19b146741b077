// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape_kinds.hpp"

#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

/// Belt round two equal pulleys: all points within `reach` = radius + thickness of the line between
/// the pulley axes. One closed outline without edges, so a grain never meets a corner.
class Conveyor final : public Shape {
 public:
  struct Parameters {
    Vec3 head;
    Vec3 tail;
    double radius = 0.0;
    double thickness = 0.0;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::head, "head", dimension::length, "A point of the head pulley's axis.");
    s.vector(&Parameters::tail, "tail", dimension::length,
             "A point of the tail pulley's axis; outside the domain it is cut off at the side.");
    s.number(&Parameters::radius, "radius", dimension::length, "Radius of both pulleys.")
        .symbol("R")
        .above(0);
    s.number(&Parameters::thickness, "thickness", dimension::length, "Thickness of the belt.")
        .at_least(0)
        .optional();
    return s.build();
  }
  explicit Conveyor(const Parameters& p) : head_(p.head), reach_(p.radius + p.thickness) {
    head_.y = 0.0;
    Vec3 along = p.tail - p.head;
    along.y = 0.0;
    length_ = norm(along);
    if (!(length_ > 0.0)) throw sdk::ParameterError("head and tail are the same point");
    back_ = along / length_;
  }

  [[nodiscard]] SurfacePoint nearest(Vec3 point) const override {
    const Vec3 q{point.x - head_.x, 0.0, point.z - head_.z};
    const double s = std::clamp(dot(q, back_), 0.0, length_);
    const Vec3 d = q - s * back_;
    const double r = norm(d);
    const Vec3 normal = r > 0.0 ? d / r : Vec3{-back_.z, 0.0, back_.x};
    return {r - reach_, normal};
  }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }
  [[nodiscard]] Triangles triangles(Vec3 min, Vec3 max, double edge) const override {
    // Outline, starting where the return run leaves the head pulley.
    const Vec3 up = cross(Vec3{0, 1, 0}, back_);  // normal of one run
    const int pieces = std::max(8, static_cast<int>(std::ceil(std::numbers::pi * reach_ / edge)));
    std::vector<Vec3> outline;
    const double reach_back = length_;
    for (int end = 0; end < 2; ++end) {
      const Vec3 centre = end == 0 ? head_ : head_ + reach_back * back_;
      const Vec3 from = end == 0 ? -up : up;
      const Vec3 over = end == 0 ? -back_ : back_;
      for (int n = 0; n <= pieces; ++n) {
        const double a = std::numbers::pi * n / pieces;
        outline.push_back(centre + reach_ * (std::cos(a) * from + std::sin(a) * over));
      }
    }
    Triangles t;
    for (std::size_t n = 0; n < outline.size(); ++n) {
      Vec3 a = outline[n];
      Vec3 b = outline[(n + 1) % outline.size()];
      if (!clip_x(a, b, min.x, max.x)) continue;
      a.y = b.y = min.y;
      Vec3 c = b;
      Vec3 d = a;
      c.y = d.y = max.y;
      add_quad(t, a, b, c, d);
    }
    return t;
  }

 private:
  static bool clip_x(Vec3& a, Vec3& b, double low, double high) {
    if (std::max(a.x, b.x) < low || std::min(a.x, b.x) > high) return false;
    const auto cut = [&](Vec3& p, const Vec3& q) {
      const double x = std::clamp(p.x, low, high);
      if (x != p.x) p = p + (x - p.x) / (q.x - p.x) * (q - p);
    };
    const Vec3 a0 = a;
    cut(a, b);
    cut(b, a0);
    return true;
  }

  Vec3 head_;
  Vec3 back_;
  double length_ = 0.0;
  double reach_;
};

}  // namespace

ShapeKind conveyor_kind() {
  return make_kind<Conveyor>(
      "conveyor",
      "Belt round a head and a tail pulley of the same size, axis along y, as wide as the domain.");
}

}  // namespace dust::bodies
