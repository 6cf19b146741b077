// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape.hpp"

#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

void add_quad(Triangles& t, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  t.insert(t.end(), {a, b, c, a, c, d});
}

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

/// A flat plate hanging from a hinge: a box of `length` x `thickness`, endless across.
class Plate final : public Shape {
 public:
  struct Parameters {
    Vec3 hinge;
    double length = 0.0;
    double thickness = 0.0;
    double angle = 0.0;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::hinge, "hinge", dimension::length,
             "Upper end of the struck face (the face towards smaller x).");
    s.number(&Parameters::length, "length", dimension::length, "Length down from the hinge.")
        .above(0);
    s.number(&Parameters::thickness, "thickness", dimension::length,
             "Thickness, away from the face.")
        .above(0);
    s.number(&Parameters::angle, "angle", dimension::angle,
             "Inclination from the vertical; positive swings the lower end towards smaller x.")
        .at_least(-std::numbers::pi / 2)
        .at_most(std::numbers::pi / 2)
        .optional();
    return s.build();
  }
  explicit Plate(const Parameters& p)
      : down_{-std::sin(p.angle), 0.0, -std::cos(p.angle)},
        away_{std::cos(p.angle), 0.0, -std::sin(p.angle)},
        half_length_(0.5 * p.length),
        half_thickness_(0.5 * p.thickness) {
    centre_ = p.hinge + half_length_ * down_ + half_thickness_ * away_;
  }
  [[nodiscard]] SurfacePoint nearest(Vec3 point) const override {
    const Vec3 q = point - centre_;
    const double a = dot(q, down_);
    const double b = dot(q, away_);
    const double over_a = std::abs(a) - half_length_;
    const double over_b = std::abs(b) - half_thickness_;
    const Vec3 toward_a = a < 0 ? -down_ : down_;
    const Vec3 toward_b = b < 0 ? -away_ : away_;
    if (over_a > 0.0 && over_b > 0.0) {
      const double r = std::hypot(over_a, over_b);
      return {r, (over_a / r) * toward_a + (over_b / r) * toward_b};
    }
    return over_a > over_b ? SurfacePoint{over_a, toward_a} : SurfacePoint{over_b, toward_b};
  }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }
  [[nodiscard]] Triangles triangles(Vec3 min, Vec3 max, double) const override {
    Vec3 corner[4];
    const double sa[4] = {-1, 1, 1, -1};
    const double sb[4] = {-1, -1, 1, 1};
    for (int n = 0; n < 4; ++n) {
      corner[n] = centre_ + (sa[n] * half_length_) * down_ + (sb[n] * half_thickness_) * away_;
    }
    Triangles t;
    for (int n = 0; n < 4; ++n) {
      Vec3 a = corner[n];
      Vec3 b = corner[(n + 1) % 4];
      a.y = b.y = min.y;
      Vec3 c = b;
      Vec3 d = a;
      c.y = d.y = max.y;
      add_quad(t, a, b, c, d);
    }
    return t;
  }

 private:
  Vec3 centre_;
  Vec3 down_;
  Vec3 away_;
  double half_length_;
  double half_thickness_;
};

template <class S>
ShapeKind kind(std::string name, std::string summary) {
  auto schema = S::schema();
  return {
      std::move(name), std::move(summary), schema, [schema](std::span<const sdk::Value> values) {
        return std::make_unique<S>(sdk::parameters_from<typename S::Parameters>(schema, values));
      }};
}

}  // namespace

const std::vector<ShapeKind>& shape_catalogue() {
  static const std::vector<ShapeKind> catalogue = {
      kind<Conveyor>("conveyor",
                     "Belt round a head and a tail pulley of the same size, axis along y, "
                     "as wide as the domain."),
      kind<Plate>("plate", "Flat plate hanging from a hinge, as wide as the domain."),
  };
  return catalogue;
}

}  // namespace dust::bodies
