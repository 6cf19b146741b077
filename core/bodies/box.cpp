// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape_kinds.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

/// A solid box along the axes; a frame turns it.
class Box final : public OnePart<Box> {
 public:
  struct Parameters {
    Vec3 min;
    Vec3 max;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", dimension::length, "Lower corner.");
    s.vector(&Parameters::max, "max", dimension::length, "Upper corner.");
    return s.build();
  }
  explicit Box(const Parameters& p)
      : min_(p.min), max_(p.max), centre_(0.5 * (p.min + p.max)), half_(0.5 * (p.max - p.min)) {
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d]))
        throw sdk::ParameterError("max is not above min in each direction");
    }
  }

  [[nodiscard]] SurfacePoint nearest(Vec3 point) const override {
    const Vec3 q = point - centre_;
    Vec3 over;
    int deepest = 0;  // of the three slabs, the one the point is least inside
    for (int d = 0; d < 3; ++d) {
      over[d] = std::abs(q[d]) - half_[d];
      if (over[d] > over[deepest]) deepest = d;
    }
    if (over[deepest] <= 0.0) {
      Vec3 n;
      n[deepest] = q[deepest] < 0.0 ? -1.0 : 1.0;
      return {over[deepest], n};
    }
    Vec3 away;
    int outside = 0;
    for (int d = 0; d < 3; ++d) {
      if (over[d] <= 0.0) continue;
      away[d] = q[d] < 0.0 ? -over[d] : over[d];
      ++outside;
    }
    const double r = outside == 1 ? over[deepest] : norm(away);
    return {r, away / r};
  }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }
  [[nodiscard]] Triangles triangles(Vec3, Vec3, double) const override {
    Triangles t;
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3;
      const int f = (d + 2) % 3;
      for (const bool is_high : {false, true}) {
        const auto corner = [&](bool high_e, bool high_f) {
          Vec3 p;
          p[d] = is_high ? max_[d] : min_[d];
          p[e] = high_e ? max_[e] : min_[e];
          p[f] = high_f ? max_[f] : min_[f];
          return p;
        };
        add_quad(t, corner(false, false), corner(is_high, !is_high), corner(true, true),
                 corner(!is_high, is_high));
      }
    }
    return t;
  }

 private:
  Vec3 min_;
  Vec3 max_;
  Vec3 centre_;
  Vec3 half_;
};

}  // namespace

ShapeKind box_kind() { return make_kind<Box>("box", "Solid box along the axes of its frame."); }

}  // namespace dust::bodies
