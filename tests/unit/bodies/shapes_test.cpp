// SPDX-License-Identifier: Apache-2.0
#include "unit/bodies/shapes.hpp"
#include "bodies/seen_edges.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace {

using dust::bodies::Shape;
using dust::bodies::SurfacePoint;
using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::make_shape;

constexpr double k_pi = std::numbers::pi;

/// A shape described a second time, by hand: points of its surface at most `spacing` apart, and
/// whether a point is in the solid.
struct Described {
  std::string name;
  std::unique_ptr<Shape> shape;
  std::vector<Vec3> surface;
  double spacing = 0.0;
  std::function<bool(Vec3)> is_inside;
};

/// Points on the surface that a straight line from (r0, z0) to (r1, z1) sweeps out round z.
void sweep(std::vector<Vec3>& points, double r0, double z0, double r1, double z1, double spacing) {
  const int along =
      std::max(1, static_cast<int>(std::ceil(std::hypot(r1 - r0, z1 - z0) / spacing)));
  for (int a = 0; a <= along; ++a) {
    const double r = r0 + (r1 - r0) * a / along;
    const double z = z0 + (z1 - z0) * a / along;
    const int round = std::max(1, static_cast<int>(std::ceil(2 * k_pi * r / spacing)));
    for (int n = 0; n < round; ++n) {
      const double angle = 2 * k_pi * n / round;
      points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  }
}

constexpr double k_spacing = 0.02;
const Vec3 k_up{0, 0, 2};  // the length of a direction does not matter

std::vector<Described> described() {
  std::vector<Described> all;
  const auto add = [&all](std::string name, std::unique_ptr<Shape> shape,
                          std::function<bool(Vec3)> is_inside) -> std::vector<Vec3>& {
    all.push_back({std::move(name), std::move(shape), {}, k_spacing, std::move(is_inside)});
    return all.back().surface;
  };
  const auto radius = [](Vec3 p) { return std::hypot(p.x, p.y); };
  {
    auto& s = add(
        "box", make_shape("box", {{"min", Vec3{-0.5, -0.4, -0.3}}, {"max", Vec3{0.5, 0.4, 0.3}}}),
        [](Vec3 p) { return std::abs(p.x) < 0.5 && std::abs(p.y) < 0.4 && std::abs(p.z) < 0.3; });
    for (double x = -0.5; x < 0.51; x += k_spacing) {
      for (double y = -0.4; y < 0.41; y += k_spacing) {
        for (const double z : {-0.3, 0.3}) s.push_back({x, y, z});
      }
      for (double z = -0.3; z < 0.31; z += k_spacing) {
        for (const double y : {-0.4, 0.4}) s.push_back({x, y, z});
      }
    }
    for (double y = -0.4; y < 0.41; y += k_spacing) {
      for (double z = -0.3; z < 0.31; z += k_spacing) {
        for (const double x : {-0.5, 0.5}) s.push_back({x, y, z});
      }
    }
  }
  {
    auto& s = add("solid cylinder",
                  make_shape("cylinder",
                             {{"base", Vec3{}}, {"axis", k_up}, {"length", 0.8}, {"radius", 0.4}}),
                  [=](Vec3 p) { return radius(p) < 0.4 && p.z > 0 && p.z < 0.8; });
    sweep(s, 0, 0, 0.4, 0, k_spacing);
    sweep(s, 0.4, 0, 0.4, 0.8, k_spacing);
    sweep(s, 0.4, 0.8, 0, 0.8, k_spacing);
  }
  {
    auto& s =
        add("tube",
            make_shape("cylinder", {{"base", Vec3{}},
                                    {"axis", k_up},
                                    {"length", 0.8},
                                    {"radius", 0.4},
                                    {"thickness", 0.1}}),
            [=](Vec3 p) { return radius(p) > 0.4 && radius(p) < 0.5 && p.z > 0 && p.z < 0.8; });
    sweep(s, 0.4, 0, 0.5, 0, k_spacing);
    sweep(s, 0.5, 0, 0.5, 0.8, k_spacing);
    sweep(s, 0.5, 0.8, 0.4, 0.8, k_spacing);
    sweep(s, 0.4, 0.8, 0.4, 0, k_spacing);
  }
  {
    auto& s = add("solid frustum",
                  make_shape("frustum", {{"base", Vec3{}},
                                         {"axis", k_up},
                                         {"length", 0.6},
                                         {"radius", 0.2},
                                         {"end_radius", 0.5}}),
                  [=](Vec3 p) { return p.z > 0 && p.z < 0.6 && radius(p) < 0.2 + 0.5 * p.z; });
    sweep(s, 0, 0, 0.2, 0, k_spacing);
    sweep(s, 0.2, 0, 0.5, 0.6, k_spacing);
    sweep(s, 0.5, 0.6, 0, 0.6, k_spacing);
  }
  {
    // Measured square to the wall, 0.05 is this wide along the end.
    const double wide = 0.05 * std::hypot(0.6, 0.3) / 0.6;
    auto& s = add("funnel",
                  make_shape("frustum", {{"base", Vec3{}},
                                         {"axis", k_up},
                                         {"length", 0.6},
                                         {"radius", 0.2},
                                         {"end_radius", 0.5},
                                         {"thickness", 0.05}}),
                  [=](Vec3 p) {
                    const double inner = 0.2 + 0.5 * p.z;
                    return p.z > 0 && p.z < 0.6 && radius(p) > inner && radius(p) < inner + wide;
                  });
    sweep(s, 0.2, 0, 0.2 + wide, 0, k_spacing);
    sweep(s, 0.2 + wide, 0, 0.5 + wide, 0.6, k_spacing);
    sweep(s, 0.5 + wide, 0.6, 0.5, 0.6, k_spacing);
    sweep(s, 0.5, 0.6, 0.2, 0, k_spacing);
  }
  {
    auto& s = add(
        "cone",
        make_shape("cone", {{"base", Vec3{}}, {"axis", k_up}, {"length", 0.6}, {"radius", 0.4}}),
        [=](Vec3 p) { return p.z > 0 && radius(p) < 0.4 * (1 - p.z / 0.6); });
    sweep(s, 0, 0, 0.4, 0, k_spacing);
    sweep(s, 0.4, 0, 0, 0.6, k_spacing);
  }
  {
    auto& s =
        add("disc with a hole",
            make_shape("disc", {{"centre", Vec3{}},
                                {"axis", k_up},
                                {"radius", 0.6},
                                {"hole_radius", 0.15},
                                {"thickness", 0.1}}),
            [=](Vec3 p) { return radius(p) > 0.15 && radius(p) < 0.6 && p.z > 0 && p.z < 0.1; });
    sweep(s, 0.15, 0, 0.6, 0, k_spacing);
    sweep(s, 0.6, 0, 0.6, 0.1, k_spacing);
    sweep(s, 0.6, 0.1, 0.15, 0.1, k_spacing);
    sweep(s, 0.15, 0.1, 0.15, 0, k_spacing);
  }
  return all;
}

}  // namespace

TEST_CASE("every exact shape shall give the distance, side and normal that brute force finds") {
  for (const Described& d : described()) {
    CAPTURE(d.name);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    int inside = 0;
    for (int n = 0; n < 400; ++n) {
      const Vec3 p{place(random), place(random), place(random)};
      const SurfacePoint s = d.shape->nearest(p);
      double brute = std::numeric_limits<double>::infinity();
      for (const Vec3& q : d.surface) brute = std::min(brute, norm(p - q));
      CAPTURE(p.x);
      CAPTURE(p.y);
      CAPTURE(p.z);
      CHECK(norm(s.normal) == approx(1.0).epsilon(1e-12));
      CHECK((s.distance < 0) == d.is_inside(p));
      inside += s.distance < 0 ? 1 : 0;
      // The nearest of points at most `spacing` apart is never nearer than the surface, and not
      // farther by more than their spacing.
      CHECK(std::abs(s.distance) <= brute + 1e-12);
      CHECK(brute <= std::abs(s.distance) + d.spacing);
      // The foot lies on the surface, and the normal is the gradient of the distance.
      const Vec3 on = p - s.distance * s.normal;
      CHECK(std::abs(d.shape->nearest(on).distance) < 1e-12);
      constexpr double k_step = 1e-6;
      const double ahead = d.shape->nearest(p + k_step * s.normal).distance;
      CHECK(ahead - s.distance == approx(k_step).epsilon(1e-6));
    }
    CHECK(inside > 2);  // both sides were seen
  }
}

TEST_CASE("many spheres shall touch each part where one after the other would") {
  auto all = described();
  all.push_back({"belt",
                 make_shape("conveyor", {{"head", Vec3{0.4, 0, 0.1}},
                                         {"tail", Vec3{-0.5, 0, -0.2}},
                                         {"radius", 0.3},
                                         {"thickness", 0.01}}),
                 {},
                 0.0,
                 {}});
  all.push_back({"box with walls inside, a mesh",
                 make_shape("container", {{"min", Vec3{-0.5, -0.5, -0.5}},
                                          {"max", Vec3{0.5, 0.5, 0.5}},
                                          {"thickness", 0.05}}),
                 {},
                 0.0,
                 {}});
  constexpr std::size_t k_spheres = 37;
  for (const Described& d : all) {
    CAPTURE(d.name);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.8, 0.8);
    for (int part = 0; part < d.shape->parts(); ++part) {
      double column[8][k_spheres];
      std::int32_t hint[k_spheres];
      for (std::size_t n = 0; n < k_spheres; ++n) {
        for (int k = 0; k < 3; ++k) column[k][n] = place(random);
        column[3][n] = 0.3;
        hint[n] = -1;
      }
      column[0][0] = 0.4, column[2][0] = 0.1;  // on the axis of the belt's pulley
      const dust::bodies::ClosestPoints spheres{k_spheres, column[0], column[1], column[2],
                                                column[3], hint,      column[4], column[5],
                                                column[6], column[7]};
      // A second look has the memory of the first, and the same answer.
      for (int look = 0; look < 2; ++look) {
        d.shape->touch(part, spheres);
        for (std::size_t n = 0; n < k_spheres; ++n) {
          const SurfacePoint one =
              d.shape->contact(part, {column[0][n], column[1][n], column[2][n]}, column[3][n]);
          CHECK(column[4][n] == one.distance);
          if (!std::isfinite(one.distance)) continue;
          CHECK(column[5][n] == one.normal.x);
          CHECK(column[6][n] == one.normal.y);
          CHECK(column[7][n] == one.normal.z);
        }
      }
    }
  }
}

TEST_CASE("faces, rims and tips shall be met where they are") {
  const auto tube = make_shape("cylinder", {{"base", Vec3{}},
                                            {"axis", Vec3{0, 0, 1}},
                                            {"length", 1.0},
                                            {"radius", 0.4},
                                            {"thickness", 0.1}});
  // From inside, from outside, and round the two rims of the upper end.
  CHECK(tube->nearest({0.3, 0, 0.5}).distance == approx(0.1).epsilon(1e-14));
  CHECK(tube->nearest({0.3, 0, 0.5}).normal == Vec3{-1, 0, 0});
  CHECK(tube->nearest({0, -0.7, 0.5}).distance == approx(0.2).epsilon(1e-14));
  CHECK(tube->nearest({0, -0.7, 0.5}).normal == Vec3{0, -1, 0});
  CHECK(tube->nearest({0.45, 0, 1.25}).normal == Vec3{0, 0, 1});
  const SurfacePoint rim = tube->nearest({0.1, 0, 1.4});
  CHECK(rim.distance == approx(0.5).epsilon(1e-14));
  CHECK(rim.normal.x == approx(-0.6).epsilon(1e-14));
  CHECK(rim.normal.z == approx(0.8).epsilon(1e-14));
  // On the axis every direction is right: the distance is the radius.
  CHECK(tube->nearest({0, 0, 0.5}).distance == approx(0.4).epsilon(1e-14));

  const auto cone = make_shape(
      "cone",
      {{"base", Vec3{0, 0, 1}}, {"axis", Vec3{0, 0, -1}}, {"length", 1.0}, {"radius", 1.0}});
  CHECK(cone->nearest({0, 0, -0.5}).distance == approx(0.5).epsilon(1e-14));
  CHECK(cone->nearest({0, 0, -0.5}).normal == Vec3{0, 0, -1});
  CHECK(cone->nearest({0, 0.5, 1.5}).normal == Vec3{0, 0, 1});

  const auto plane = make_shape("plane", {{"point", Vec3{0, 0, 2}}, {"normal", Vec3{0, 0, 5}}});
  CHECK(plane->nearest({3, 4, 2.5}).distance == 0.5);
  CHECK(plane->nearest({3, 4, 1}).distance == -1.0);
}

TEST_CASE("a round hole shall be faced for spheres that are wider than it, and for those alone") {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto disc = make_shape("disc", {{"centre", Vec3{0, 0, -1}},
                                        {"axis", k_up},
                                        {"radius", 9.0},
                                        {"hole_radius", 3.0},
                                        {"thickness", 1.0}});
  disc->expect_spheres(3.0);
  CHECK(disc->parts() == 1);
  disc->expect_spheres(4.0);
  REQUIRE(disc->parts() == 25);
  const auto touched = [&](Vec3 point, double reach) {
    std::vector<double> distances;
    for (int part = 0; part < disc->parts(); ++part) {
      const SurfacePoint s = disc->contact(part, point, reach);
      CHECK((s.distance == infinity || disc->is_within(part, point, s.distance + 1e-9)));
      if (s.distance < reach) distances.push_back(s.distance);
    }
    return distances;
  };
  // In the middle all faces of the rim, as far as the rim is; beside the hole its plane alone.
  const auto on_rim = touched({0, 0, 2}, 4.0);
  CHECK(on_rim.size() == 24);
  for (const double d : on_rim) CHECK(d == approx(std::sqrt(9.0 + 4.0)).epsilon(1e-12));
  CHECK(touched({5, 1, 2}, 4.0) == std::vector<double>{2.0});
  CHECK(touched({-2, 12, -0.5}, 4.0).size() == 1);
  // A small one in the hole touches the face, or where two meet both, less than a hundredth of
  // the hole farther out than the circle.
  for (double angle = 0.01; angle < 6.28; angle += 0.05) {
    const auto found = touched({2.8 * std::cos(angle), 2.8 * std::sin(angle), -0.5}, 0.24);
    REQUIRE(!found.empty());
    CHECK(found.size() <= 2);
    const double nearest = *std::min_element(found.begin(), found.end());
    CHECK(nearest >= 0.2 - 1e-12);
    CHECK(nearest < 0.2 + 0.009 * 3.0);
  }
  const auto tube = make_shape(
      "cylinder",
      {{"base", Vec3{}}, {"axis", k_up}, {"radius", 1.0}, {"length", 2.0}, {"thickness", 0.1}});
  CHECK(tube->is_unchanged_by_turning({0, 0, 5}, {0, 0, 1}));
  tube->expect_spheres(1.5);
  CHECK_FALSE(tube->is_unchanged_by_turning({0, 0, 5}, {0, 0, 1}));
  // What has no hole has no faces; a cap has none wide enough for any sphere.
  const auto solid =
      make_shape("cylinder", {{"base", Vec3{}}, {"axis", k_up}, {"radius", 1.0}, {"length", 2.0}});
  solid->expect_spheres(5.0);
  CHECK(solid->parts() == 1);
  const auto cap = make_shape(
      "cone",
      {{"base", Vec3{}}, {"axis", k_up}, {"radius", 1.0}, {"length", 2.0}, {"thickness", 0.1}});
  cap->expect_spheres(0.01);
  CHECK(cap->parts() == 25);
}

TEST_CASE("written surfaces shall lie on the shapes and look outwards") {
  for (const Described& d : described()) {
    CAPTURE(d.name);
    const auto t = d.shape->triangles({-1, -1, -1}, {1, 1, 1}, 0.05);
    REQUIRE(t.size() >= 12);
    for (std::size_t n = 0; n + 2 < t.size(); n += 3) {
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(std::abs(d.shape->nearest(t[n + c]).distance) < 1e-12);
      }
      const Vec3 middle = (t[n] + t[n + 1] + t[n + 2]) / 3.0;
      const Vec3 normal = cross(t[n + 1] - t[n], t[n + 2] - t[n]);
      // A chord's middle lies inside a round face: look at it from a little outside.
      const SurfacePoint s = d.shape->nearest(middle + (0.005 / norm(normal)) * normal);
      CHECK(dot(s.normal, normal) > 0.9 * norm(normal));
    }
  }
  const auto plane = make_shape("plane", {{"point", Vec3{}}, {"normal", Vec3{1, 1, 1}}});
  const auto hexagon = plane->triangles({-1, -1, -1}, {1, 1, 1}, 1.0);
  CHECK(hexagon.size() == 12);  // four triangles
  for (const Vec3& p : hexagon) CHECK(std::abs(p.x + p.y + p.z) < 1e-12);
}

TEST_CASE("a drawing shall show rims and bends of a surface, not its triangles") {
  const auto count = [](const Shape& shape, int depth) {
    return dust::bodies::visible_edges(shape.triangles({-1, -1, -1}, {1, 1, 1}, 0.02), depth, 2.0)
        .size();
  };
  CHECK(count(*make_shape("box", {{"min", Vec3{-0.5, -0.4, -0.3}}, {"max", Vec3{0.5, 0.4, 0.3}}}),
              1) == 12);
  const auto disc = make_shape(
      "disc", {{"centre", Vec3{}}, {"axis", Vec3{0, 1, 0}}, {"radius", 0.6}, {"thickness", 0.1}});
  const auto t = disc->triangles({-1, -1, -1}, {1, 1, 1}, 0.02);
  const auto along = dust::bodies::visible_edges(t, 1, 2.0);
  CHECK(along.size() > 40);
  for (const auto& [a, b] : along) {
    CHECK(std::hypot(a.x, a.z) == approx(0.6));
    CHECK(std::hypot(b.x, b.z) == approx(0.6));
  }
  // From the side two lines more, where the round turns from the eye.
  CHECK(dust::bodies::visible_edges(t, 0, 2.0).size() == along.size() + 2);
}

TEST_CASE("a round shape shall know what turning leaves it as it is") {
  const auto drum = make_shape("cylinder", {{"base", Vec3{1, 0, 0}},
                                            {"axis", Vec3{0, 1, 0}},
                                            {"length", 1.0},
                                            {"radius", 0.5},
                                            {"thickness", 0.01}});
  CHECK(drum->is_unchanged_by_turning({1, 5, 0}, {0, -1, 0}));
  CHECK_FALSE(drum->is_unchanged_by_turning({1.01, 5, 0}, {0, 1, 0}));
  CHECK_FALSE(drum->is_unchanged_by_turning({1, 5, 0}, {0, 0, 1}));
}

TEST_CASE("shapes that contradict themselves shall be refused") {
  using dust::sdk::ParameterError;
  const auto what = [](auto make) {
    try {
      make();
    } catch (const ParameterError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(what([] {
          make_shape("plane", {{"point", Vec3{}}, {"normal", Vec3{}}});
        }) == "normal has no direction");
  CHECK(what([] {
          make_shape("box", {{"min", Vec3{}}, {"max", Vec3{1, 0, 1}}});
        }) == "max is not above min in each direction");
  CHECK(what([] {
          make_shape("disc", {{"centre", Vec3{}},
                              {"axis", Vec3{0, 0, 1}},
                              {"radius", 0.1},
                              {"hole_radius", 0.2},
                              {"thickness", 0.1}});
        }) == "the hole is as wide as the disc");
}
