// SPDX-License-Identifier: Apache-2.0
#include "bodies/mesh/mesh.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "unit/bodies/meshes.hpp"
#include "unit/bodies/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace {

using dust::bodies::Mesh;
using dust::bodies::SurfacePoint;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

/// Nearest point of a triangle as the least of face, edges and corners: another way than the
/// mesh's.
Vec3 nearest_of(const Vec3* c, Vec3 p) {
  const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
  const Vec3 foot = p - (dot(p - c[0], normal) / dot(normal, normal)) * normal;
  bool is_over = true;
  for (int k = 0; k < 3; ++k) {
    is_over = is_over && dot(cross(c[(k + 1) % 3] - c[k], foot - c[k]), normal) >= 0.0;
  }
  if (is_over) return foot;
  Vec3 best = c[0];
  for (int k = 0; k < 3; ++k) {
    const Vec3 along = c[(k + 1) % 3] - c[k];
    const double s = std::clamp(dot(p - c[k], along) / dot(along, along), 0.0, 1.0);
    const Vec3 q = c[k] + s * along;
    if (norm(p - q) < norm(p - best)) best = q;
  }
  return best;
}

double brute_distance(const Corners& corners, Vec3 p) {
  double best = k_infinity;
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    best = std::min(best, norm(p - nearest_of(corners.data() + n, p)));
  }
  return best;
}

/// Whether a ray in an odd direction leaves the mesh an odd number of times.
bool is_inside(const Corners& corners, Vec3 p) {
  const Vec3 ray{0.4123, 0.5231, 0.7457};
  int hits = 0;
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    const Vec3 u = corners[n + 1] - corners[n];
    const Vec3 v = corners[n + 2] - corners[n];
    const Vec3 h = cross(ray, v);
    const double a = dot(u, h);
    if (std::abs(a) < 1e-14) continue;
    const Vec3 s = p - corners[n];
    const double x = dot(s, h) / a;
    const Vec3 q = cross(s, u);
    const double y = dot(ray, q) / a;
    if (x >= 0 && y >= 0 && x + y <= 1 && dot(v, q) / a > 0) ++hits;
  }
  return hits % 2 == 1;
}

/// The parts a sphere touches.
std::vector<SurfacePoint> contacts(const Mesh& mesh, Vec3 p, double radius) {
  std::vector<SurfacePoint> all;
  for (int part = 0; part < mesh.parts(); ++part) {
    const SurfacePoint s = mesh.contact(part, p, radius);
    if (s.distance < radius) all.push_back(s);
  }
  return all;
}

}  // namespace

TEST_CASE("the nearest point of a mesh and its side shall be those of brute force") {
  for (const Corners& corners :
       {box_mesh({-1, -0.7, -0.4}, {1, 0.7, 0.4}, 3), torus_mesh(0.8, 0.3, 17, 9), corner_mesh()}) {
    const Mesh mesh(corners, Mesh::Sides::one);
    REQUIRE(mesh.health().is_closed());
    CHECK(mesh.health().opposing_edges == 0);
    CHECK(mesh.health().inside_out == 0);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-2.2, 2.2);
    int inside = 0;
    for (int n = 0; n < 600; ++n) {
      const Vec3 p{place(random), place(random), place(random)};
      const SurfacePoint s = mesh.nearest(p);
      CHECK(std::abs(s.distance) == approx(brute_distance(corners, p)).epsilon(1e-12));
      CHECK((s.distance < 0) == is_inside(corners, p));
      CHECK(brute_distance(corners, p - s.distance * s.normal) < 1e-12);
      inside += s.distance < 0 ? 1 : 0;
      // Of all parts, the nearest is there, and none is behind.
      double nearest = k_infinity;
      for (int part = 0; part < mesh.parts(); ++part) {
        const SurfacePoint c = mesh.contact(part, p, k_infinity);
        if (s.distance >= 0) CHECK(c.distance >= 0);  // behind a part: not to touch
        if (std::abs(c.distance) < std::abs(nearest)) nearest = c.distance;
        CHECK(mesh.is_within(part, p, std::abs(s.distance) - 1e-9) == false);
      }
      CHECK(nearest == approx(s.distance).epsilon(1e-12));
    }
    CHECK(inside > 10);
  }
}

TEST_CASE(
    "a sphere on a face, an edge or a point of a flat mesh shall be touched as by the plane") {
  // V-MESH-1. The top of a box of 5 x 5 squares: faces, shared edges, points of six triangles.
  const Mesh mesh(box_mesh({-1, -1, -1}, {1, 1, 0}, 5), Mesh::Sides::one);
  CHECK(mesh.parts() == 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.9, 0.9);
  for (int n = 0; n < 300; ++n) {
    Vec3 p{place(random), place(random), 0.05};
    if (n % 3 == 0) p.x = -0.6 + 0.4 * (n % 4);  // over an edge
    if (n % 6 == 0) p.y = -0.2;                  // over a point
    if (n % 6 == 1) p.y = p.x;                   // over a diagonal
    const auto all = contacts(mesh, p, 0.0501);
    REQUIRE(all.size() == 1);
    CHECK(std::abs(all[0].distance - 0.05) < 1e-15);
    CHECK(norm(all[0].normal - Vec3{0, 0, 1}) < 1e-14);
  }
}

TEST_CASE("edges that stand out shall be touched once, corners towards the grains on each side") {
  const Mesh box(box_mesh({-1, -1, -1}, {1, 1, 1}), Mesh::Sides::one);
  CHECK(box.parts() == 1);
  CHECK(contacts(box, {1.06, 0, 1.08}, 0.2).size() == 1);
  CHECK(contacts(box, {1.06, 1.06, 1.06}, 0.2).size() == 1);

  const Mesh corner(corner_mesh(), Mesh::Sides::one);
  CHECK(corner.parts() == 2);
  // In the corner, over the floor, at the wall, over the outer edges of both.
  const auto both = contacts(corner, {0.09, 0.2, 1.08}, 0.1);
  REQUIRE(both.size() == 2);
  for (const SurfacePoint& s : both) {
    const bool is_floor = s.normal.z > 0.5;
    CHECK(norm(s.normal - (is_floor ? Vec3{0, 0, 1} : Vec3{1, 0, 0})) < 1e-14);
    CHECK(s.distance == approx(is_floor ? 0.08 : 0.09).epsilon(1e-12));
  }
  CHECK(contacts(corner, {0.5, 0.2, 1.08}, 0.1).size() == 1);
  CHECK(contacts(corner, {0.09, 0.2, 1.5}, 0.1).size() == 1);
  CHECK(contacts(corner, {2.05, 0.2, 1.05}, 0.1).size() == 1);
  CHECK(contacts(corner, {0.05, 0.2, 2.05}, 0.1).size() == 1);
  CHECK(contacts(corner, {-1.05, 0.2, 2.05}, 0.1).size() == 1);
  // Over the end of the corner's line: both faces and their edges on the side are near.
  CHECK(contacts(corner, {0.05, 1.05, 1.05}, 0.1).size() <= 2);
  CHECK(!contacts(corner, {0.05, 1.03, 1.05}, 0.1).empty());
}

TEST_CASE("hollows of a mesh shall be touched on every side by spheres that are wider") {
  // A plate with a hole of radius 1: folds of 15 degrees, each face a part, and of 5, two a part.
  for (const auto& [faces, walls] : {std::pair{24, 24}, std::pair{72, 36}}) {
    CAPTURE(faces);
    Mesh plate(ring_mesh({{{1, -0.5}, {4, -0.5}, {4, 0}, {1, 0}}}, faces), Mesh::Sides::one);
    const double inner = std::cos(std::numbers::pi / faces);
    const int parts_before = plate.parts();
    plate.expect_spheres(0.9 * inner);
    CHECK(plate.parts() == parts_before);
    plate.expect_spheres(1.001 * inner);
    CHECK(plate.parts() == walls + 1);  // and all that is outside
    const double height = std::sqrt(1.5 * 1.5 - inner * inner) - 1e-6;
    CHECK(contacts(plate, {0, 0, height}, 1.5).size() == static_cast<std::size_t>(walls));
    // Off the middle by 0.02 the far side is 0.03 farther away.
    const auto near = contacts(plate, {0.02, 0, height}, 1.5);
    CHECK(near.size() >= static_cast<std::size_t>(walls / 2 - 1));
    CHECK(near.size() <= static_cast<std::size_t>(walls / 2 + 2));
    CHECK(contacts(plate, {2, 0, 1.49}, 1.5).size() == 1);
    plate.expect_spheres(0.5);
    CHECK(plate.parts() == parts_before);
  }
}

/// So many rings side by side, holes of radius 1 in a plate of 0.5.
Corners screen_mesh(int holes) {
  const Corners ring = ring_mesh({{{1, -0.5}, {4, -0.5}, {4, 0}, {1, 0}}}, 24);
  Corners screen;
  for (int n = 0; n < holes; ++n) {
    for (const Vec3& p : ring) screen.push_back(p + Vec3{10.0 * (n % 8), 10.0 * (n / 8), 0});
  }
  return screen;
}

TEST_CASE("each hole of a screen shall be cut, and a sphere touch one all round") {
  Mesh screen(screen_mesh(40), Mesh::Sides::one);
  screen.expect_spheres(1.5);
  CHECK(screen.parts() == 40 * 25);
  std::vector<std::int32_t> near;
  screen.find_within({30, 20, 1.12}, 1.5, near);
  CHECK(near.size() == 25);
  CHECK(contacts(screen, {30, 20, 1.12}, 1.51).size() == 24);
}

TEST_CASE("parts near a point shall be those that are near when each is asked") {
  for (const auto& [corners, radius] : {std::pair(screen_mesh(24), 1.5),
                                        {screen_mesh(3), 0.1},
                                        {corner_mesh(), 0.0},
                                        {torus_mesh(0.8, 0.3, 17, 9), 0.0}}) {
    Mesh mesh(corners, Mesh::Sides::one);
    mesh.expect_spheres(radius);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-3.0, 25.0);
    std::vector<std::int32_t> near = {-1};
    std::size_t found = 0;
    for (int n = 0; n < 300; ++n) {
      const Vec3 p{place(random), place(random), 0.1 * place(random)};
      const double reach = 0.3 * (3.0 + place(random));
      std::vector<std::int32_t> expected;
      double nearest = k_infinity;
      for (int part = 0; part < mesh.parts(); ++part) {
        if (mesh.is_within(part, p, reach)) expected.push_back(part);
        nearest = std::min(nearest, std::abs(mesh.contact(part, p, k_infinity).distance));
      }
      mesh.find_within(p, reach, near);
      CHECK(near == expected);
      CHECK(std::abs(mesh.nearest(p).distance) == approx(nearest).epsilon(1e-12));
      found += near.size();
    }
    CHECK(found > 50);
  }
}

TEST_CASE("a slot of a mesh shall be touched at both rims by spheres that are wider") {
  // A square ring turned by 45 degrees, drawn out along y: 1 wide, 8 long.
  Corners c = ring_mesh({{{1, -0.5}, {4, -0.5}, {4, 0}, {1, 0}}}, 4);
  const double half = std::sqrt(0.5);
  for (Vec3& p : c) p = {half * half * (p.x - p.y), 8 * half * half * (p.x + p.y), p.z};
  Mesh plate(c, Mesh::Sides::one);
  REQUIRE(plate.health().is_closed());
  REQUIRE(plate.health().inside_out == 0);
  const Vec3 over{0, 0.3, std::sqrt(0.7 * 0.7 - 0.5 * 0.5)};
  plate.expect_spheres(0.7);
  const auto both = contacts(plate, over, 0.701);
  REQUIRE(both.size() == 2);
  CHECK(both[0].normal.x == approx(-both[1].normal.x).epsilon(1e-12));
  CHECK(both[0].normal.z == approx(over.z / 0.7).epsilon(1e-12));
  CHECK(contacts(plate, {0, 0.3, 0.701}, 0.5).empty());
  plate.expect_spheres(0.45);
  CHECK(plate.parts() == Mesh(c, Mesh::Sides::one).parts());
}

TEST_CASE("a gentle bend, or one that stands out, shall stay one part for spheres of any size") {
  const Corners tube = ring_mesh({{{5, 0}, {6, 0}, {6, 20}, {5, 20}}}, 72);
  Mesh mesh(tube, Mesh::Sides::one);
  mesh.expect_spheres(4.5);
  CHECK(mesh.parts() == 1);
  // The tip of a cone is narrow for any sphere, but the cone is not.
  Mesh cone(ring_mesh({{{0, -1}, {11, 10}, {10, 10}, {0, 0}}}, 72), Mesh::Sides::one);
  const int before = cone.parts();
  cone.expect_spheres(0.01);
  CHECK(cone.parts() == before);
  cone.expect_spheres(16);  // touches round its base of 10 at 10 / cos 45 deg
  CHECK(cone.parts() >= 24);
  Mesh ball(torus_mesh(10, 6, 90, 60), Mesh::Sides::one);
  ball.expect_spheres(3.0);  // its hole is 4 in radius
  CHECK(ball.parts() == 1);
}

TEST_CASE("a needle between two faces of a wide tube shall not cut it") {
  // Regular folds of 5 degrees, beside one of them a seam: a face of 0.05 degrees.
  std::vector<double> angles;
  for (int n = 0; n < 72; ++n) angles.push_back(5.0 * n);
  for (const int n : {60, 30, 10}) angles.insert(angles.begin() + n, 5.0 * n - 0.05);
  const double section[4][2] = {{500, 0}, {510, 0}, {510, 200}, {500, 200}};
  const auto at = [&](const double* p, std::size_t n) {
    const double a = std::numbers::pi / 180 * angles[n % angles.size()];
    return Vec3{p[0] * std::cos(a), p[0] * std::sin(a), p[1]};
  };
  Corners c;
  for (std::size_t n = 0; n < angles.size(); ++n) {
    for (int e = 0; e < 4; ++e) {
      const double* p = section[e];
      const double* q = section[(e + 1) % 4];
      add_quad(c, at(p, n), at(p, n + 1), at(q, n + 1), at(q, n));
    }
  }
  Mesh tube(c, Mesh::Sides::one);
  REQUIRE(tube.health().is_closed());
  tube.expect_spheres(20);
  CHECK(tube.parts() == 1);
}

TEST_CASE("a face with a narrow place shall stay whole where it bends gently") {
  // Two ribs round the inside of a wide tube, 10 apart: a sphere of 6 bridges the groove between
  // them, along which the tube bends by 5 degrees from face to face.
  const Corners tube = ring_mesh({{{500, 0},
                                   {510, 0},
                                   {510, 200},
                                   {500, 200},
                                   {500, 120},
                                   {480, 120},
                                   {480, 115},
                                   {500, 115},
                                   {500, 105},
                                   {480, 105},
                                   {480, 100},
                                   {500, 100}}},
                                 72);
  Mesh mesh(tube, Mesh::Sides::one);
  REQUIRE(mesh.health().is_closed());
  const int uncut = mesh.parts();
  mesh.expect_spheres(6);
  CHECK(mesh.parts() <= uncut + 3);  // the groove and the ribs beside it by themselves
  CHECK(contacts(mesh, {495, 0, 110}, 6).size() == 3);
}

TEST_CASE("a hole with a rounded rim shall be touched on every side by spheres that are wider") {
  constexpr double k_radius = 5.0;
  Mesh ring(torus_mesh(10, 6, 90, 60), Mesh::Sides::one);  // a hole of 4
  ring.expect_spheres(k_radius);
  const Vec3 middle{0, 0, std::sqrt((6 + k_radius) * (6 + k_radius) - 100.0)};
  // Flat faces lie a little inside the torus.
  const auto all = contacts(ring, middle, 1.01 * k_radius);
  CHECK(all.size() >= 30);
  Vec3 sum;
  for (const SurfacePoint& s : all) sum += s.normal;
  CHECK(std::hypot(sum.x, sum.y) < 0.02 * sum.z);
}

TEST_CASE("a vessel shall be touched on each wall of its corners and once at its rim") {
  const auto vessel =
      make_shape("container", {{"min", Vec3{0, 0, 0}}, {"max", Vec3{4, 3, 2}}, {"thickness", 0.1}});
  const auto touched = [&](Vec3 p, double radius) {
    int count = 0;
    for (int part = 0; part < vessel->parts(); ++part) {
      count += vessel->contact(part, p, radius).distance < radius ? 1 : 0;
    }
    return count;
  };
  constexpr double r = 0.3;  // larger than the walls are thick: the outside is in reach
  CHECK(touched({2, 1.5, 0.29}, r) == 1);
  CHECK(touched({0.29, 1.5, 0.29}, r) == 2);
  CHECK(touched({0.29, 0.29, 0.29}, r) == 3);
  CHECK(touched({3.71, 2.71, 1.0}, r) == 2);
  CHECK(touched({2, 1.5, 1}, r) == 0);
  CHECK(touched({-0.05, 1.5, 2.25}, r) == 1);  // on the rim
  CHECK(touched({0.1, 1.5, 2.2}, r) == 1);
  CHECK(touched({-0.39, 1.5, 1}, r) == 1);  // outside
  CHECK(touched({2, 1.5, -0.39}, r) == 1);
  CHECK(vessel->nearest({2, 1.5, 0.25}).distance == approx(0.25).epsilon(1e-14));
  CHECK(vessel->nearest({2, 1.5, -0.05}).distance == approx(-0.05).epsilon(1e-14));
  CHECK(vessel->nearest({-0.1, -0.1, 2.1}).distance == approx(0.1).epsilon(1e-14));
  CHECK(vessel->is_solid());
  CHECK_THROWS_WITH_AS(
      make_shape("container", {{"min", Vec3{}},
                               {"max", Vec3{1, 1, 1}},
                               {"thickness", 0.1},
                               {"open", std::vector<std::string>{"left", "right", "front", "back",
                                                                 "bottom", "top"}}}),
      "open names all sides: there are no walls", dust::sdk::ParameterError);
}

TEST_CASE("binary and text STL files shall give the same part, in the unit and place asked for") {
  const TemporaryFolder folder;
  const Corners box = box_mesh({0, 0, 0}, {10, 20, 30});
  const auto binary = write_binary_stl(folder / "b.stl", box);
  const auto text = write_text_stl(folder / "t.stl", box);
  for (const std::string& file : {binary, text}) {
    const auto part = make_shape("mesh", {{"file", file},
                                          {"unit", 1e-3},
                                          {"rotated_by", std::numbers::pi / 2},
                                          {"moved_by", Vec3{0, 0, 0.1}}});
    // Turned about z: x in -20 .. 0 mm, y in 0 .. 10 mm, z in 100 .. 130 mm.
    CHECK(part->nearest({-0.010, 0.005, 0.131}).distance == approx(1e-3).epsilon(1e-9));
    CHECK(part->nearest({0.002, 0.005, 0.110}).distance == approx(2e-3).epsilon(1e-9));
    CHECK(part->nearest({-0.010, 0.005, 0.11}).distance == approx(-5e-3).epsilon(1e-9));
    REQUIRE(part->notes().size() == 1);
    CHECK(part->notes()[0].find("12 triangles, 8 points, 1 shell, closed, volume 6 cm3, area 22 "
                                "cm2, 1 parts that a grain can touch at once; edges 10 mm to "
                                "36.06 mm") != std::string::npos);
    CHECK(part->warnings().empty());
  }
}

TEST_CASE("a mesh that is not fit shall be refused with what is wrong and what to do") {
  const TemporaryFolder folder;
  int number = 0;
  const auto problem = [&](const Corners& corners, std::map<std::string, Value> more = {}) {
    more["file"] = write_binary_stl(folder / ("m" + std::to_string(number++) + ".stl"), corners);
    more.emplace("unit", 1e-3);
    try {
      make_shape("mesh", more);
    } catch (const dust::sdk::ParameterError& e) {
      std::string text = e.what();
      const auto at = text.find(".stl");
      return at == std::string::npos ? text : text.substr(at + 4);
    }
    return std::string();
  };
  const Corners box = box_mesh({0, 0, 0}, {10, 10, 10});
  CHECK(problem(box).empty());
  Corners open(box.begin() + 3, box.end());
  CHECK(problem(open).find(" is open: 3 edges have one triangle only, the first at (") == 0);
  CHECK(problem(open).find("; close it where it was drawn, or give open: allowed if it is a thin "
                           "sheet") != std::string::npos);
  CHECK(problem(open, {{"open", std::string("allowed")}}).empty());
  Corners inside_out = box;
  for (std::size_t n = 0; n < box.size(); n += 3) std::swap(inside_out[n], inside_out[n + 1]);
  CHECK(problem(inside_out) == " is inside out: its triangles look inwards; give flip: true");
  CHECK(problem(inside_out, {{"flip", true}}).empty());
  CHECK(problem(box, {{"flip", true}}).find("give flip: false") != std::string::npos);
  Corners one_turned = box;
  std::swap(one_turned[0], one_turned[1]);
  CHECK(problem(one_turned).find(": at 3 edges the triangles look to different sides, the first") ==
        0);
  Corners two = box;
  for (const Vec3& p : inside_out) two.push_back(p + Vec3{20, 0, 0});
  CHECK(problem(two).find(" is inside out (1 of its 2 shells)") == 0);
  // A cavity looks inwards by right.
  Corners hollow = box_mesh({0, 0, 0}, {10, 10, 10});
  for (const Vec3& p : inside_out) hollow.push_back(Vec3{4, 4, 4} + 0.2 * p);
  CHECK(problem(hollow).empty());
  CHECK(problem(box, {{"thickness", 1e-3}}).find("thickness is for open sheets") == 0);

  const auto what = [&](const std::string& content) {
    const auto file = folder / "x.stl";
    std::ofstream(file, std::ios::binary) << content;
    try {
      make_shape("mesh", {{"file", file.string()}, {"unit", 1.0}});
    } catch (const dust::sdk::ParameterError& e) {
      return std::string(e.what()).substr(file.string().size());
    }
    return std::string("no error");
  };
  CHECK(what("hello") == " is not an STL file (neither binary nor text)");
  CHECK(what("solid a\nendsolid\n") == " holds no triangles");
  CHECK(what("solid a\n vertex 1 two 3\n") ==
        ", line 2: three numbers are expected after 'vertex'");
  CHECK(what("solid a\n vertex 1 2 3\n").find("the file is cut short") != std::string::npos);
  std::string cut(80, ' ');
  cut += std::string("\x02\0\0\0", 4) + std::string(60, 'x');
  CHECK(what(cut) ==
        ": 2 triangles are announced, which takes 184 bytes, but the file has 144: it "
        "is damaged");
  // Also where the header of a binary file begins as a text does.
  CHECK(what("solid" + cut.substr(5)).find(": 2 triangles are announced") == 0);
}

TEST_CASE("doubled and collapsed triangles shall be left out and told") {
  const TemporaryFolder folder;
  Corners box = box_mesh({0, 0, 0}, {10, 10, 10});
  const Corners first(box.begin(), box.begin() + 3);
  box.insert(box.end(), first.begin(), first.end());
  box.insert(box.end(), {{0, 0, 0}, {0, 0, 0}, {10, 0, 0}});
  const auto part =
      make_shape("mesh", {{"file", write_binary_stl(folder / "m.stl", box)}, {"unit", 1e-3}});
  REQUIRE(part->warnings().size() == 2);
  CHECK(part->warnings()[0].find("1 triangles were given twice: left out") != std::string::npos);
  CHECK(part->warnings()[1].find("1 triangles have two corners in one point") != std::string::npos);
  CHECK(part->nearest({0.005, 0.005, 0.011}).distance == approx(1e-3).epsilon(1e-9));
}

TEST_CASE("a thin sheet shall be touched from both sides, and have a thickness if asked for") {
  const TemporaryFolder folder;
  Corners sheet;
  dust::test::add_quad(sheet, {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  const auto file = write_text_stl(folder / "sheet.stl", sheet);
  const auto thin =
      make_shape("mesh", {{"file", file}, {"unit", 1e-3}, {"open", std::string("allowed")}});
  CHECK(thin->nearest({0.005, 0.005, 0.002}).normal == Vec3{0, 0, 1});
  CHECK(thin->nearest({0.005, 0.005, -0.002}).normal == Vec3{0, 0, -1});
  CHECK(thin->nearest({0.005, 0.005, -0.002}).distance == approx(2e-3).epsilon(1e-12));
  CHECK_FALSE(thin->is_solid());
  const auto thick = make_shape(
      "mesh",
      {{"file", file}, {"unit", 1e-3}, {"open", std::string("allowed")}, {"thickness", 1e-3}});
  CHECK(thick->is_solid());
  CHECK(thick->nearest({0.005, 0.005, -0.002}).distance == approx(1.5e-3).epsilon(1e-12));
  CHECK(thick->nearest({0.005, 0.005, 1e-4}).distance == approx(-4e-4).epsilon(1e-9));
}
