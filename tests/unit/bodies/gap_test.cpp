// SPDX-License-Identifier: Apache-2.0
#include "bodies/survey/gap.hpp"
#include "bodies/mesh/mesh.hpp"
#include "bodies/survey/bounds_of.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "unit/bodies/meshes.hpp"
#include "unit/bodies/shapes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

using dust::bodies::Body;
using dust::bodies::Gap;
using dust::bodies::GapSearch;
using dust::bodies::Mesh;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr GapSearch k_search{{-1, -1, -1}, {1, 1, 1}, 0.06, 60'000};  // limit 60 mm

Body body_of(const std::string& shape, const std::map<std::string, Value>& values) {
  Body body;
  body.shape = make_shape(shape, values);
  return body;
}
Body box(Vec3 min, Vec3 max) { return body_of("box", {{"min", min}, {"max", max}}); }
Body cylinder(Vec3 base, Vec3 axis, double length, double radius) {
  return body_of("cylinder",
                 {{"base", base}, {"axis", axis}, {"length", length}, {"radius", radius}});
}

/// The gap is the same whichever body is looked at first.
Gap both_ways(const Body& a, const Body& b, const GapSearch& search = k_search) {
  const Gap there = smallest_gap(a, b, search);
  const Gap back = smallest_gap(b, a, search);
  if (there.width == k_infinity) {
    CHECK(back.width == k_infinity);
  } else {
    CHECK(there.width == approx(back.width).epsilon(1e-6));
  }
  return there;
}

}  // namespace

TEST_CASE("the gap between bodies shall be the distance of their closest points") {
  SUBCASE("level faces, one small before one large") {
    const Body floor = box({-0.9, -0.9, -0.9}, {0.9, 0.9, -0.5});
    const Body foot = box({0.31, 0.2, -0.492}, {0.35, 0.25, 0.0});
    const Gap gap = both_ways(floor, foot);
    CHECK(gap.width == approx(0.008).epsilon(1e-9));
    CHECK(gap.is_whole);
    CHECK(gap.place.x == approx(0.33).epsilon(0.07));
  }
  SUBCASE("an edge over a face, askew") {
    Body wedge = box({-0.2, -0.01, 0.0}, {0.2, 0.01, 0.2});
    wedge.frame_axis = {0, 1, 0};
    wedge.frame_angle = 0.3;  // its corner edge goes down to -0.2 sin(0.3)
    const double lowest = -0.2 * std::sin(0.3);
    const Body floor = box({-0.9, -0.9, -0.5}, {0.9, 0.9, lowest - 0.0125});
    CHECK(both_ways(wedge, floor).width == approx(0.0125).epsilon(1e-6));
  }
  SUBCASE("two cylinders across each other") {
    const Body one = cylinder({-0.5, 0, 0}, {1, 0, 0}, 1.0, 0.1);
    const Body other = cylinder({0, -0.5, 0.25}, {0, 1, 0}, 1.0, 0.13);
    const Gap gap = both_ways(one, other);
    CHECK(gap.width == approx(0.02).epsilon(1e-5));      // where the search ends
    CHECK(std::hypot(gap.place.x, gap.place.y) < 2e-3);  // flat there: the place is loose
  }
}

TEST_CASE("bodies that touch, overlap or are far apart shall have no gap") {
  const Body floor = box({-0.9, -0.9, -0.9}, {0.9, 0.9, -0.5});
  CHECK(both_ways(floor, box({0, 0, -0.5}, {0.1, 0.1, 0.0})).width == 0.0);
  CHECK(both_ways(floor, box({0, 0, -0.6}, {0.1, 0.1, 0.0})).width == 0.0);
  CHECK(both_ways(floor, box({0, 0, -0.43}, {0.1, 0.1, 0.0})).width == k_infinity);
}

TEST_CASE("gaps outside the box shall not count") {
  const Body floor = box({-3, -3, -0.9}, {3, 3, -0.5});
  const Body near_outside = box({1.5, 0, -0.49}, {1.6, 0.1, 0});
  CHECK(both_ways(floor, near_outside).width == k_infinity);
}

TEST_CASE("a sheet shall be nearer by half its thickness") {
  const TemporaryFolder folder;
  Corners sheet;
  add_quad(sheet, {-0.3, -0.3, 0}, {0.3, -0.3, 0}, {0.3, 0.3, 0}, {-0.3, 0.3, 0});
  const std::string file = write_binary_stl(folder / "sheet.stl", sheet);
  const Body body = body_of(
      "mesh",
      {{"file", file}, {"unit", 1.0}, {"open", std::string("allowed")}, {"thickness", 0.012}});
  const Body foot = box({0.05, 0.05, 0.03}, {0.1, 0.1, 0.5});
  CHECK(both_ways(body, foot).width == approx(0.024).epsilon(1e-6));
  CHECK(body.shape->thinnest_wall() == approx(0.012));
}

TEST_CASE("a search whose work ends shall say so") {
  const Body floor = box({-0.9, -0.9, -0.9}, {0.9, 0.9, -0.5});
  const Body roof = box({-0.9, -0.9, -0.48}, {0.9, 0.9, 0.0});
  GapSearch search = k_search;
  search.work = 200;
  const Gap gap = smallest_gap(floor, roof, search);
  CHECK_FALSE(gap.is_whole);
  CHECK(gap.width == approx(0.02));
  CHECK(gap.work < 200 + 2 * 16 * 40 + 10);  // and the projections from the best places
}

TEST_CASE("the thinnest wall of a mesh shall be measured straight through") {
  const auto wall = [](const Corners& corners) {
    return Mesh(corners, Mesh::Sides::one).thinnest_wall();
  };
  CHECK(wall(box_mesh({0, 0, 0}, {0.1, 0.05, 0.003}, 3)) == approx(0.003).epsilon(1e-4));
  // Floor 1 high, wall 1 wide.
  CHECK(wall(corner_mesh()) == approx(1.0).epsilon(1e-4));
  // A ring of 12 facets across: twice the distance of the facets from the middle.
  const double flat = 2.0 * 0.2 * std::cos(std::numbers::pi / 12);
  CHECK(wall(torus_mesh(1.0, 0.2, 48, 12)) == approx(flat).epsilon(0.02));
  CHECK(Mesh(box_mesh({0, 0, 0}, {1, 1, 1}), Mesh::Sides::both).thinnest_wall() == 0.0);
}

TEST_CASE("bodies that their motions take to other places shall be looked at where they begin") {
  const auto rib = [](double ahead) {
    Body body = box({-0.01, -0.2, 0.1}, {0.01, 0.2, 0.15});
    body.motions.push_back(
        dust::test::ModelLoader::make<dust::sdk::Motion>("motion", "circulate",
                                                         {{"head", Vec3{0.5, 0, 0}},
                                                          {"tail", Vec3{-0.5, 0, 0}},
                                                          {"radius", 0.1},
                                                          {"speed", 1.0},
                                                          {"ahead", ahead}}));
    return body;
  };
  // Drawn at one place over the belt: of 20 mm each, apart by their way along it less that.
  CHECK(both_ways(rib(0.5), rib(0.55)).width == approx(0.03).epsilon(1e-9));
  CHECK(both_ways(rib(0.5), rib(0.8)).width == k_infinity);
  CHECK(both_ways(rib(0.5), rib(0.51)).width == 0.0);
}

TEST_CASE("a body in a turned frame shall be drawn through the whole of a box") {
  // A plate across x in its frame, endless along y; turned by a right angle it is endless along x,
  // from 0.5 to 0.51 m in y.
  Body plate =
      body_of("plate", {{"hinge", Vec3{0.5, 0, 0.5}}, {"length", 0.2}, {"thickness", 0.01}});
  plate.frame_axis = {0, 0, 1};
  plate.frame_angle = 0.5 * std::numbers::pi;
  const dust::bodies::Bounds drawn =
      dust::bodies::bounds_of(plate.triangles({0, 0, 0}, {1, 1, 1}, 0.1));
  CHECK(drawn.low.x <= 1e-9);
  CHECK(drawn.high.x >= 1.0 - 1e-9);
  // And a box that stands on it is seen to touch, whichever is looked at first.
  const Body block = box({0.6, 0.45, 0.5}, {0.8, 0.55, 0.9});
  const GapSearch search{{0, 0, 0}, {1, 1, 1}, 0.01, 60'000};
  CHECK(both_ways(plate, block, search).width == 0.0);
}
