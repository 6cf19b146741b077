// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape_kinds.hpp"

#include <cmath>
#include <numbers>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

/// A flat plate hanging from a hinge: a box of `length` x `thickness`, endless across.
class Plate final : public OnePart<Plate> {
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
      add_strip(t, corner[n], corner[(n + 1) % 4], min.y, max.y);
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

}  // namespace

ShapeKind plate_kind() {
  return make_kind<Plate>("plate", "Flat plate hanging from a hinge, as wide as the domain.");
}

}  // namespace dust::bodies
