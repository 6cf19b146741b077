// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape_kinds.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/plugin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

struct Outline {
  Vec3 head;            ///< of the head pulley's axis, y = 0
  Vec3 back;            ///< unit vector from the head to the tail pulley, y = 0
  double length = 0.0;  ///< [m] between both
  double reach = 0.0;   ///< [m] radius and thickness
};

/// The point of the belt nearest to (x, z).
inline SurfacePoint nearest_of(const Outline& o, double x, double z) {
  const double qx = x - o.head.x;
  const double qz = z - o.head.z;
  const double s = std::min(std::max(qx * o.back.x + qz * o.back.z, 0.0), o.length);
  const double dx = qx - s * o.back.x;
  const double dz = qz - s * o.back.z;
  const double r = std::sqrt(dx * dx + dz * dz);
  const bool is_off_axis = r > 0.0;
  const double divisor = is_off_axis ? r : 1.0;
  return {r - o.reach,
          {is_off_axis ? dx / divisor : -o.back.z, 0.0, is_off_axis ? dz / divisor : o.back.x}};
}

DUST_KERNEL void touch_all(const Outline& outline, const ClosestPoints& t) {
  const Outline o = outline;
  const double *x = t.x, *z = t.z;
  double *distance = t.distance, *nx = t.normal_x, *ny = t.normal_y, *nz = t.normal_z;
#pragma omp simd
  for (std::size_t n = 0; n < t.count; ++n) {
    const SurfacePoint s = nearest_of(o, x[n], z[n]);
    distance[n] = s.distance;
    nx[n] = s.normal.x;
    ny[n] = 0.0;
    nz[n] = s.normal.z;
  }
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
  explicit Conveyor(const Parameters& p) {
    belt_.reach = p.radius + p.thickness;
    belt_.head = {p.head.x, 0.0, p.head.z};
    Vec3 along = p.tail - p.head;
    along.y = 0.0;
    belt_.length = norm(along);
    if (!(belt_.length > 0.0)) throw sdk::ParameterError("head and tail are the same point");
    belt_.back = along / belt_.length;
  }

  [[nodiscard]] SurfacePoint nearest(Vec3 point) const override {
    return nearest_of(belt_, point.x, point.z);
  }
  void touch(int /*part*/, const ClosestPoints& spheres) const override {
    touch_all(belt_, spheres);
  }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }
  [[nodiscard]] bool is_bent() const override { return true; }
  void find_bends(std::size_t count, const double* const* point,
                  double* const* bend) const override {
    for (std::size_t n = 0; n < count; ++n) {
      const Vec3 q{point[0][n] - belt_.head.x, 0.0, point[2][n] - belt_.head.z};
      const double s = dot(q, belt_.back);
      const bool is_on_run = s > 0.0 && s < belt_.length;
      const Vec3 arm = q - (s > 0.0 ? belt_.length : 0.0) * belt_.back;
      const double by = is_on_run ? 0.0 : 1.0 / std::max(dot(arm, arm), 1e-300);
      for (int d = 0; d < 3; ++d) bend[d][n] = by * arm[d];
    }
  }
  [[nodiscard]] Triangles triangles(Vec3 min, Vec3 max, double edge) const override {
    // Outline, starting where the return run leaves the head pulley.
    const Vec3 up = cross(Vec3{0, 1, 0}, belt_.back);  // normal of one run
    const int pieces =
        std::max(8, static_cast<int>(std::ceil(std::numbers::pi * belt_.reach / edge)));
    std::vector<Vec3> outline;
    const double reach_back = belt_.length;
    for (int end = 0; end < 2; ++end) {
      const Vec3 centre = end == 0 ? belt_.head : belt_.head + reach_back * belt_.back;
      const Vec3 from = end == 0 ? -up : up;
      const Vec3 over = end == 0 ? -belt_.back : belt_.back;
      for (int n = 0; n <= pieces; ++n) {
        const double a = std::numbers::pi * n / pieces;
        outline.push_back(centre + belt_.reach * (std::cos(a) * from + std::sin(a) * over));
      }
    }
    Triangles t;
    for (std::size_t n = 0; n < outline.size(); ++n) {
      Vec3 a = outline[n];
      Vec3 b = outline[(n + 1) % outline.size()];
      if (!clip_x(a, b, min.x, max.x)) continue;
      add_strip(t, a, b, min.y, max.y);
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

  Outline belt_;
};

}  // namespace

ShapeKind conveyor_kind() {
  return make_kind<Conveyor>(
      "conveyor",
      "Belt round a head and a tail pulley of the same size, axis along y, as wide as the domain.");
}

}  // namespace dust::bodies
