// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace dust::test {

/// Cylinder along y, solid inside (disc) or outside (ring) of its radius.
class Cylinder final : public bodies::OnePart<Cylinder> {
 public:
  Cylinder(sdk::Vec3 centre, double radius, bool is_ring)
      : centre_(centre), radius_(radius), sign_(is_ring ? -1.0 : 1.0) {}
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p) const override {
    const sdk::Vec3 d{p.x - centre_.x, 0, p.z - centre_.z};
    const double r = norm(d);
    return {sign_ * (r - radius_), r > 0 ? (sign_ / r) * d : sdk::Vec3{sign_, 0, 0}};
  }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  sdk::Vec3 centre_;
  double radius_;
  double sign_;
};

/// Everything behind a plane through `point` with normal `normal`.
class HalfSpace final : public bodies::OnePart<HalfSpace> {
 public:
  HalfSpace(sdk::Vec3 point, sdk::Vec3 normal) : point_(point), normal_(normal / norm(normal)) {}
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p) const override {
    return {dot(p - point_, normal_), normal_};
  }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  sdk::Vec3 point_;
  sdk::Vec3 normal_;
};

/// A plate of any thickness, 0 included, through `middle`; of a finite half length if given.
class Plate final : public bodies::OnePart<Plate> {
 public:
  Plate(sdk::Vec3 middle, sdk::Vec3 normal, double thickness, double half_length = 1e9)
      : middle_(middle),
        normal_(normal / norm(normal)),
        along_(sdk::cross({0, 1, 0}, normal_)),
        half_(0.5 * thickness),
        half_length_(half_length) {}
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p) const override {
    const double s = dot(p - middle_, normal_);
    const double q = dot(p - middle_, along_);
    const sdk::Vec3 up = s < 0 ? -normal_ : normal_;
    const double over_s = std::abs(s) - half_;
    const double over_q = std::abs(q) - half_length_;
    const sdk::Vec3 out = q < 0 ? -along_ : along_;
    if (over_q <= 0.0 || over_q < over_s) {
      if (over_q <= 0.0) return {std::max(over_s, over_q), over_s >= over_q ? up : out};
    }
    if (over_s <= 0.0) return {over_q, out};
    const double r = std::hypot(over_s, over_q);
    return {r, (over_s / r) * up + (over_q / r) * out};
  }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  sdk::Vec3 middle_;
  sdk::Vec3 normal_;
  sdk::Vec3 along_;
  double half_;
  double half_length_;
};

/// A box turned by `angle` about an axis through its centre.
class TurnedBox final : public bodies::OnePart<TurnedBox> {
 public:
  TurnedBox(sdk::Vec3 centre, sdk::Vec3 half, sdk::Vec3 about, double angle)
      : centre_(centre), half_(half) {
    const sdk::Vec3 e = about / norm(about);
    for (int d = 0; d < 3; ++d) {
      sdk::Vec3 v;
      v[d] = 1.0;
      axis_[d] = std::cos(angle) * v + std::sin(angle) * cross(e, v) +
                 (1.0 - std::cos(angle)) * dot(e, v) * e;
    }
  }
  /// A vector given along its edges.
  [[nodiscard]] sdk::Vec3 turned(sdk::Vec3 v) const {
    return v.x * axis_[0] + v.y * axis_[1] + v.z * axis_[2];
  }
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p) const override {
    sdk::Vec3 out;
    sdk::Vec3 largest_normal;
    double largest = -1e9;
    for (int d = 0; d < 3; ++d) {
      const double q = dot(p - centre_, axis_[d]);
      const sdk::Vec3 normal = q < 0 ? -axis_[d] : axis_[d];
      const double over = std::abs(q) - half_[d];
      if (over > 0.0) out += over * normal;
      if (over > largest) largest = over, largest_normal = normal;
    }
    const double r = norm(out);
    if (r > 0.0) return {r, out / r};
    return {largest, largest_normal};
  }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  sdk::Vec3 centre_;
  sdk::Vec3 half_;
  sdk::Vec3 axis_[3];
};

/// The walls of a closed vessel: a turned box without the smaller one in it.
class Vessel final : public bodies::OnePart<Vessel> {
 public:
  Vessel(sdk::Vec3 centre, sdk::Vec3 half, double wall, sdk::Vec3 about, double angle)
      : outer_(centre, half, about, angle),
        inner_(centre, half - sdk::Vec3{wall, wall, wall}, about, angle) {}
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p) const override {
    const bodies::SurfacePoint outer = outer_.nearest(p);
    const bodies::SurfacePoint inner = inner_.nearest(p);
    return outer.distance > -inner.distance ? outer
                                            : bodies::SurfacePoint{-inner.distance, -inner.normal};
  }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  TurnedBox outer_;
  TurnedBox inner_;
};

/// Everything between two parallel planes.
class Slab final : public bodies::OnePart<Slab> {
 public:
  Slab(sdk::Vec3 middle, sdk::Vec3 normal, double thickness)
      : middle_(middle), normal_(normal / norm(normal)), half_(0.5 * thickness) {}
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3 p) const override {
    const double s = dot(p - middle_, normal_);
    return {std::abs(s) - half_, s < 0 ? -normal_ : normal_};
  }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }

 private:
  sdk::Vec3 middle_;
  sdk::Vec3 normal_;
  double half_;
};

/// Surface moving along itself, round the y axis as the pulley of a belt: v = speed (y x normal).
class Turning final : public sdk::Motion {
 public:
  explicit Turning(double speed) : speed_(speed) {}
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      const sdk::Vec3 v = speed_ * sdk::cross({0, 1, 0}, b.normal[n]);
      b.velocity.set(n, v);
    }
  }
  [[nodiscard]] double largest_speed() const override { return std::abs(speed_); }

 private:
  double speed_;
};

inline bodies::Body body(std::unique_ptr<bodies::Shape> shape, double speed) {
  bodies::Body b;
  b.name = "test";
  b.shape = std::move(shape);
  if (speed != 0.0) b.motions.push_back(std::make_unique<Turning>(speed));
  return b;
}

/// A body that goes to and fro, or ever on.
class Shift final : public sdk::Motion {
 public:
  Shift(std::function<sdk::Vec3(double)> place, std::function<sdk::Vec3(double)> velocity,
        double fastest)
      : place_(std::move(place)), velocity_(std::move(velocity)), fastest_(fastest) {}
  static std::unique_ptr<Shift> steady(sdk::Vec3 velocity) {
    return std::make_unique<Shift>([=](double t) { return t * velocity; },
                                   [=](double) { return velocity; }, norm(velocity));
  }
  [[nodiscard]] double largest_speed() const override { return fastest_; }
  [[nodiscard]] bool moves_body() const override { return true; }
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    sdk::RigidPose pose;
    pose.shift = place_(time);
    pose.velocity = velocity_(time);
    return pose;
  }

 private:
  std::function<sdk::Vec3(double)> place_;
  std::function<sdk::Vec3(double)> velocity_;
  double fastest_;
};

inline bodies::Body moving(std::unique_ptr<bodies::Shape> shape,
                           std::unique_ptr<sdk::Motion> motion) {
  bodies::Body b = body(std::move(shape), 0.0);
  b.motions.push_back(std::move(motion));
  return b;
}

}  // namespace dust::test
