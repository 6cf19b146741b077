// SPDX-License-Identifier: Apache-2.0
#include "bodies/revolved.hpp"
#include "bodies/shape_kinds.hpp"
#include "dust/sdk/error.hpp"

#include <cmath>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

/// Conical wall of given thickness, or a solid cone frustum where it is 0. Thickness is measured
/// across the wall; the ends are cut square to the axis.
std::vector<ProfilePoint> wall_profile(double radius, double end_radius, double length,
                                       double thickness) {
  if (thickness == 0.0) return {{0, 0}, {radius, 0}, {end_radius, length}, {0, length}};
  const double width = thickness * std::hypot(length, end_radius - radius) / length;
  return {{radius, 0}, {radius + width, 0}, {end_radius + width, length}, {end_radius, length}};
}

/// What round walls along an axis share; their `Parameters` derive from this.
struct WallParameters {
  Vec3 base, axis;
  double length = 0.0, radius = 0.0, thickness = 0.0;
};

/// A round wall that narrows or widens from the first end to the other.
class RoundWall : public Revolved {
 protected:
  RoundWall(const WallParameters& p, double end_radius)
      : Revolved(p.base, unit_direction(p.axis, "axis"),
                 wall_profile(p.radius, end_radius, p.length, p.thickness)) {}
};

template <class P>
void add_axis(SchemaOf<P>& s) {
  s.vector(&P::base, "base", dimension::length, "Centre of the first end.");
  s.vector(&P::axis, "axis", dimension::none,
           "Direction from the first end to the other; its length does not matter.");
  s.number(&P::length, "length", dimension::length, "Length along the axis.").symbol("L").above(0);
}

template <class P>
void add_first_radius(SchemaOf<P>& s) {
  s.number(&P::radius, "radius", dimension::length,
           "Radius at the first end (inner face of a wall).")
      .above(0);
}

template <class P>
void add_thickness(SchemaOf<P>& s) {
  s.number(&P::thickness, "thickness", dimension::length,
           "Thickness of the wall, outside the radius and across the wall; 0 = solid throughout.")
      .at_least(0)
      .optional();
}

/// A tube, open at both ends, or a solid cylinder.
class Cylinder final : public RoundWall {
 public:
  using Parameters = WallParameters;
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    add_axis(s);
    s.number(&Parameters::radius, "radius", dimension::length,
             "Radius: of the inner face of a tube, of the outer one of a solid cylinder.")
        .symbol("R")
        .above(0);
    add_thickness(s);
    return s.build();
  }
  explicit Cylinder(const Parameters& p) : RoundWall(p, p.radius) {}
};

/// A funnel (hopper), open at both ends, or a solid frustum.
class Frustum final : public RoundWall {
 public:
  struct Parameters : WallParameters {
    double end_radius = 0.0;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    add_axis(s);
    add_first_radius(s);
    s.number(&Parameters::end_radius, "end_radius", dimension::length,
             "Radius at the other end (inner face of a wall).")
        .above(0);
    add_thickness(s);
    return s.build();
  }
  explicit Frustum(const Parameters& p) : RoundWall(p, p.end_radius) {}
};

/// A cone that ends in a tip; with a thickness a conical cap, open at its first end.
class Cone final : public RoundWall {
 public:
  using Parameters = WallParameters;
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    add_axis(s);
    add_first_radius(s);
    add_thickness(s);
    return s.build();
  }
  explicit Cone(const Parameters& p) : RoundWall(p, 0.0) {}
};

/// A round plate with a hole in its middle: orifice, neck, lid.
class Disc final : public Revolved {
 public:
  struct Parameters {
    Vec3 centre, axis;
    double radius = 0.0, hole_radius = 0.0, thickness = 0.0;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::centre, "centre", dimension::length, "Centre of the first face.");
    s.vector(&Parameters::axis, "axis", dimension::none,
             "Direction from the first face to the other; its length does not matter.");
    s.number(&Parameters::radius, "radius", dimension::length, "Outer radius.").above(0);
    s.number(&Parameters::hole_radius, "hole_radius", dimension::length,
             "Radius of the hole; 0 = none.")
        .at_least(0)
        .optional();
    s.number(&Parameters::thickness, "thickness", dimension::length, "Thickness of the plate.")
        .above(0);
    return s.build();
  }
  explicit Disc(const Parameters& p)
      : Revolved(p.centre, unit_direction(p.axis, "axis"),
                 {{p.hole_radius, 0},
                  {p.radius, 0},
                  {p.radius, p.thickness},
                  {p.hole_radius, p.thickness}}) {
    if (p.hole_radius >= p.radius) throw sdk::ParameterError("the hole is as wide as the disc");
  }
};

}  // namespace

ShapeKind cylinder_kind() {
  return make_kind<Cylinder>("cylinder",
                             "Tube, open at both ends, for grains inside or outside; without "
                             "thickness a solid cylinder.");
}
ShapeKind frustum_kind() {
  return make_kind<Frustum>("frustum",
                            "Funnel or hopper, open at both ends; without thickness a solid "
                            "frustum of a cone.");
}
ShapeKind cone_kind() {
  return make_kind<Cone>("cone", "Solid cone; with a thickness a conical cap.");
}
ShapeKind disc_kind() {
  return make_kind<Disc>("disc", "Round plate with a hole in its middle, or without.");
}

}  // namespace dust::bodies
