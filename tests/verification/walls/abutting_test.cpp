// SPDX-License-Identifier: Apache-2.0
// Bodies that touch each other: a sphere on a surface that several of them make touches it once.
#include "support/approx.hpp"
#include "unit/bodies/meshes.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

using dust::test::approx;
using namespace dust::test;
using dust::particles::NewGrain;
using dust::sdk::Value;
using dust::sdk::Vec3;

namespace {

constexpr double k_diameter = 2e-3;

/// Lower and upper corners of boxes.
using Boxes = std::vector<std::array<Vec3, 2>>;

const Boxes k_one{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.08, 0.08, 0}}};

/// The same floor in squares of 2.9 mm, round the middle 3 cm, so that a path askew crosses seams
/// and comes by corners of four.
Boxes tiles() {
  Boxes all;
  constexpr double edge = 2.9e-3;
  for (int i = -8; i < 8; ++i) {
    for (int j = -8; j < 8; ++j) {
      all.push_back({Vec3{i * edge, j * edge, -0.01}, Vec3{(i + 1) * edge, (j + 1) * edge, 0}});
    }
  }
  return all;
}

/// The same floor as boxes that lie in each other, their tops in one plane.
const Boxes k_nested{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.0, 0.08, 0}},
                     {Vec3{-0.01, -0.08, -0.02}, Vec3{0.08, 0.08, 0}},
                     {Vec3{-0.08, -0.004, -0.005}, Vec3{0.08, 0.004, 0}}};

/// Sticks harder than the grain weighs.
const DemRig::Choice k_wet{"jkr", {{"surface_energy", 0.05}}};

struct Rolling {
  DemRig::Choice cohesion = {};
  Vec3 gravity{0, 0, -k_g};
  double diameter = k_diameter;
  double roller = 0.0;  ///< [m] radius of a cylinder along y whose top is the floor's end
};

/// A grain on a floor of boxes.
struct Floor {
  WallRig rig{0.9, 0.5, k_diameter};
  std::unique_ptr<dust::particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;

  Floor(const Boxes& boxes, const Rolling& rolling, NewGrain grain) {
    if (!rolling.cohesion.name.empty()) {
      rig.laws.clear();
      rig.laws_of(rig.sand, rig.sand, {"hertz_mindlin", {{"restitution", 0.9}, {"friction", 0.5}}},
                  {}, rolling.cohesion);
    }
    if (rolling.diameter != k_diameter)
      rig.diameters.insert(rig.diameters.begin(), rolling.diameter);
    rig.setup.domain.min = {-0.1, -0.1, -0.1};
    rig.setup.domain.max = {0.1, 0.1, 0.1};
    rig.setup.gravity = rolling.gravity;
    for (const auto& [low, high] : boxes) rig.body("box", {{"min", low}, {"max", high}});
    if (rolling.roller > 0.0) {
      rig.body("cylinder", {{"base", Vec3{0, -0.08, -rolling.roller}},
                            {"axis", Vec3{0, 1, 0}},
                            {"length", 0.16},
                            {"radius", rolling.roller}});
    }
    dem = rig.make();
    grain.diameter = rolling.diameter;
    dem->insert(std::vector<NewGrain>{grain});
    stepper = std::make_unique<Stepper>(*dem);
  }
  void until(double time) {
    while (stepper->time() < time) stepper->step();
  }
  /// At rest where it is put, its radius above the floor.
  [[nodiscard]] double resting_height() {
    until(0.3);
    return now().position.z;
  }
  [[nodiscard]] GrainState now() { return grain(*dem, 0); }
};

/// Rolls over the floors side by side.
void compare(const Boxes& floor, const Rolling& rolling = {}) {
  const Rolling level{.cohesion = rolling.cohesion, .diameter = rolling.diameter};
  const double radius = 0.5 * rolling.diameter;
  const double height = Floor(k_one, level, {.position = {-0.02, -0.011, radius}}).resting_height();
  const Vec3 v{0.3, 0.113, 0};
  const NewGrain grain{.position = {-0.02, -0.011, height},
                       .velocity = v,
                       .rotation = {-v.y / height, v.x / height, 0}};
  Floor one(k_one, rolling, grain);
  Floor many(floor, rolling, grain);
  double farthest = 0.0;
  double fastest = 0.0;
  std::int64_t contacts = 0;
  for (int n = 1; n <= 200; ++n) {  // 0.1 s: 32 mm
    one.until(0.0005 * n);
    many.until(0.0005 * n);
    farthest = std::max(farthest, norm(one.now().position - many.now().position));
    fastest = std::max(fastest, norm(one.now().velocity - many.now().velocity));
    contacts = std::max(contacts, many.dem->report().contacts);
  }
  CHECK(many.now().position.x > 0.009);  // has passed its seams
  CHECK(contacts <= 1);                  // those of sub-steps are not counted
  CHECK(farthest < 1e-9);
  CHECK(fastest < 1e-7);
}

}  // namespace

TEST_CASE("a sphere shall roll over boxes that butt as over one box, without a bump") {
  compare(tiles());
}

TEST_CASE("a sphere that sticks shall roll over boxes that butt as over one box") {
  compare(tiles(), {.cohesion = k_wet});
}

TEST_CASE("a sphere that friction turns shall roll down boxes that butt as down one box") {
  // The spring of friction is under load all the way: it shall pass from box to box.
  const Vec3 downhill{1.7, 0.6, -k_g};
  compare(tiles(), {.gravity = downhill});
  compare(k_nested, {.gravity = downhill});
}

TEST_CASE("a sphere with sub-steps shall roll over boxes that butt as over one box") {
  constexpr double fine = 0.1e-3;
  Floor any(k_one, {.diameter = fine}, {.position = {0, 0, fine}});
  REQUIRE(any.dem->class_steps()[0].level > 0);
  compare(tiles(), {.diameter = fine});
  compare(tiles(), {.gravity = {1.7, 0.6, -k_g}, .diameter = fine});
  compare(tiles(), {.cohesion = k_wet, .gravity = {1.7, 0.6, -k_g}, .diameter = fine});
}

TEST_CASE("a sphere shall touch a deck and the roller that it leads to once") {
  // Among radii are some whose top lies between the corners of the pieces that draw it.
  const Boxes deck{{Vec3{-0.08, -0.08, -0.004}, Vec3{0.0, 0.08, 0}}};
  for (const double radius : {0.02, 0.025, 0.03, 0.035, 0.05}) {
    CAPTURE(radius);
    Floor f(deck, {.roller = radius},
            {.position = {-3e-3, 0, 0.5 * k_diameter - 1e-7}, .velocity = {0.1, 0, 0}});
    std::int64_t contacts = 0;
    while (f.stepper->time() < 0.07) {
      f.stepper->step();
      contacts = std::max(contacts, f.dem->report().contacts);
    }
    CHECK(f.now().position.x > 1e-3);
    CHECK(contacts == 1);
  }
}

TEST_CASE("a sphere shall touch boxes whose tops lie in one plane once") {
  compare(k_nested);
  compare(k_nested, {.cohesion = k_wet});
}

TEST_CASE("an impact on a seam of two boxes shall be that on one box") {
  const Boxes halves{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.0, 0.08, 0}},
                     {Vec3{0.0, -0.08, -0.01}, Vec3{0.08, 0.08, 0}}};
  // On the seam, and so near to it that the sphere overlaps the other box's edge. Where rounding
  // does not tell which is nearer, the normal may be an edge's: it leans by sqrt(2 r / R), where
  // the distances differ by a rounding r of 1e-15 domains. That is 1e-6.
  for (const double off : {0.0, 1e-12, 1e-9, -1e-7, 1e-5}) {
    const NewGrain grain{.position = {off, 0.001, 0.5 * k_diameter + 1e-5},
                         .velocity = {0, 0.4, -0.8}};
    Floor one(k_one, {}, grain);
    Floor two(halves, {}, grain);
    one.until(2e-3);
    two.until(2e-3);
    CHECK(one.now().velocity.z > 0.3);
    CHECK(norm(one.now().velocity - two.now().velocity) < 3e-6);  // m/s of 0.8
    CHECK(norm(one.now().rotation - two.now().rotation) < 1e-3);  // rad/s of 400
  }
}

TEST_CASE("a sphere in the corner of two boxes shall touch both, and a step where it is one") {
  SUBCASE("a wall on a floor") {
    const Boxes corner{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.08, 0.08, 0}},
                       {Vec3{0.0, -0.08, 0.0}, Vec3{0.01, 0.08, 0.02}}};
    Floor f(corner, {}, {.position = {-0.4 * k_diameter, 0, 0.5 * k_diameter - 1e-6}});
    f.stepper->step();
    CHECK(f.dem->report().contacts == 2);
  }
  SUBCASE("a wall through a floor") {
    const Boxes corner{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.08, 0.08, 0}},
                       {Vec3{0.0, -0.08, -0.02}, Vec3{0.01, 0.08, 0.02}}};
    Floor f(corner, {}, {.position = {-0.4 * k_diameter, 0, 0.5 * k_diameter - 1e-6}});
    f.stepper->step();
    CHECK(f.dem->report().contacts == 2);
  }
  SUBCASE("a step up, of a tenth of the radius") {
    const Boxes step{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.0, 0.08, 0}},
                     {Vec3{0.0, -0.08, -0.01}, Vec3{0.08, 0.08, 1e-4}}};
    const double radius = 0.5 * k_diameter;
    const double run = std::sqrt(radius * radius - (radius - 1e-4) * (radius - 1e-4));
    Floor f(step, {}, {.position = {-run + 1e-6, 0, radius - 1e-6}});
    f.stepper->step();
    CHECK(f.dem->report().contacts == 2);
  }
}

TEST_CASE("a body that is taken away shall leave its seams to those that stay") {
  const Boxes halves{{Vec3{-0.08, -0.08, -0.01}, Vec3{0.0, 0.08, 0}},
                     {Vec3{0.0, -0.08, -0.01}, Vec3{0.08, 0.08, 0}}};
  // Half a micrometre beside the seam: the edge of the second box is as near as the first's face.
  Floor f(halves, {}, {.position = {-5e-7, 0, 0.5 * k_diameter - 1e-6}});
  f.stepper->step();
  CHECK(f.dem->report().contacts == 1);
  f.rig.bodies[0].removed_at = 0.0;
  f.dem->bodies_changed();
  f.stepper->step();
  CHECK(f.dem->report().contacts == 1);
  CHECK(f.now().velocity.z > 0.0);
}
