// SPDX-License-Identifier: Apache-2.0
#include "unit/bodies/meshes.hpp"
#include "particles/surface_search.hpp"
#include "support/approx.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <random>
#include <vector>

using dust::test::approx;
using namespace dust::test;
using dust::particles::NewGrain;
using dust::sdk::Value;
using dust::sdk::Vec3;

namespace {

constexpr double k_diameter = 2e-3;

/// A grain over a floor whose top is z = 0: the exact plane, or a mesh of many triangles.
struct Floor : SingleGrain {
  Floor(const std::string& mesh, double restitution, double friction, const NewGrain& grain,
        double gravity, double rolling = -1.0)
      : SingleGrain(0.1, restitution, friction, k_diameter, rolling, gravity) {
    if (mesh.empty()) {
      rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
    } else {
      rig.body("mesh", {{"file", mesh}, {"unit", 1e-3}});
    }
    begin(grain);
  }
};

/// Squares of 1.6 mm, half a grain's size and not commensurate with its path, as a text file: the
/// binary one rounds corners to floats, the plane z = 0 it keeps.
std::string floor_mesh(const TemporaryFolder& folder) {
  return write_text_stl(folder / "floor.stl", box_mesh({-40, -40, -10}, {40, 40, 0}, 50));
}

}  // namespace

TEST_CASE("a sphere shall roll over a mesh of a plane as over the plane, without a bump") {
  const TemporaryFolder folder;
  const std::string mesh = floor_mesh(folder);
  const WallRig rest(0.9, 0.5, k_diameter);
  const double height = 0.5 * k_diameter - rest.resting_overlap();
  // Rolling from the start: v = omega R. Askew to the triangles.
  const Vec3 v{0.3, 0.113, 0};
  const NewGrain grain{.position = {-0.02, -0.011, height},
                       .velocity = v,
                       .rotation = {-v.y / height, v.x / height, 0},
                       .diameter = k_diameter};
  Floor plane("", 0.9, 0.5, grain, k_g);
  Floor tiles(mesh, 0.9, 0.5, grain, k_g);
  const auto energy = [&](const GrainState& g) {
    return 0.5 * dot(g.velocity, g.velocity) +
           0.2 * g.radius * g.radius * dot(g.rotation, g.rotation);
  };
  const double start = energy(tiles.now());
  double lowest = 1.0;
  double highest = 0.0;
  for (int n = 1; n <= 20; ++n) {
    // 0.1 s: 32 mm, some 20 squares and their diagonals.
    plane.until(0.005 * n);
    tiles.until(0.005 * n);
    const GrainState a = plane.now();
    const GrainState b = tiles.now();
    CHECK(norm(a.position - b.position) < 1e-10);
    CHECK(norm(a.velocity - b.velocity) < 1e-10);
    CHECK(norm(a.rotation - b.rotation) < 1e-7);  // rad/s of 320
    lowest = std::min(lowest, b.position.z);
    highest = std::max(highest, b.position.z);
  }
  CHECK(energy(tiles.now()) == approx(start).epsilon(1e-4));
  CHECK(highest - lowest < 1e-10);  // no bump
}

TEST_CASE("an impact on a face, an edge or a point of a flat mesh shall be that on the plane") {
  // V-MESH-1 with the impacts of V-CO2 and V-CO4: head-on and oblique.
  const TemporaryFolder folder;
  const std::string mesh = floor_mesh(folder);
  const Vec3 faces{0.0003, 0.0011, 0};
  const Vec3 edge{0, 0.0007, 0};
  const Vec3 diagonal{0.0008, 0.0008, 0};
  const Vec3 point{0, 0, 0};
  for (const Vec3 place : {faces, edge, diagonal, point}) {
    for (const Vec3 velocity : {Vec3{0, 0, -1}, Vec3{1.2, 0.4, -0.8}}) {
      const double gap = 1e-5;
      const Vec3 start{place.x - velocity.x * gap / -velocity.z,
                       place.y - velocity.y * gap / -velocity.z, 0.5 * k_diameter + gap};
      const NewGrain grain{.position = start, .velocity = velocity, .diameter = k_diameter};
      Floor plane("", 0.5, 0.3, grain, 0.0);
      Floor tiles(mesh, 0.5, 0.3, grain, 0.0);
      plane.until(2e-3);
      tiles.until(2e-3);
      const GrainState a = plane.now();
      const GrainState b = tiles.now();
      CHECK(a.velocity.z > 0.3);
      CHECK(norm(a.velocity - b.velocity) < 1e-10);
      CHECK(norm(a.position - b.position) < 1e-10);
      CHECK(norm(a.rotation - b.rotation) < 1e-7);
    }
  }
}

TEST_CASE("a grain in the corner of a vessel shall rest as between three walls of the domain") {
  const auto come_to_rest = [](bool is_vessel) {
    SingleGrain single(0.02, 0.3, 0.4, k_diameter);
    WallRig& rig = single.rig;
    if (!is_vessel) rig.setup.domain.min = {};
    rig.setup.gravity = {-4, -3, -8};
    if (is_vessel) {
      rig.body("container",
               {{"min", Vec3{}}, {"max", Vec3{0.02, 0.02, 0.02}}, {"thickness", 1e-3}});
    } else {
      for (const int side : {0, 2, 4}) rig.wall(side, rig.sand);
    }
    single.begin({.position = {1.4e-3, 1.6e-3, 1.2e-3}, .rotation = {5, 3, 1}});
    single.until(0.2);
    CHECK(single.dem->report().contacts == 3);
    return single.now();
  };
  const GrainState walls = come_to_rest(false);
  const GrainState vessel = come_to_rest(true);
  CHECK(norm(walls.position - vessel.position) < 1e-10);
  CHECK(norm(vessel.velocity) < 1e-5);
  CHECK(vessel.position.x < 0.5 * k_diameter);
  CHECK(vessel.position.y < 0.5 * k_diameter);
  CHECK(vessel.position.z < 0.5 * k_diameter);
}

TEST_CASE("a grain shall rest in a corner with a fillet narrower than itself as without one") {
  // The fillet is hidden under the grain: 0.4 mm in radius, of folds of 3 degrees.
  constexpr int k_folds = 30;
  const auto come_to_rest = [](bool has_fillet) {
    const TemporaryFolder folder;
    std::vector<std::array<double, 2>> section = {{-2, -2}, {-2, 10}, {0, 10}};
    for (int n = 0; n <= k_folds; ++n) {
      const double a = 0.5 * std::numbers::pi * n / k_folds;
      if (has_fillet) section.push_back({0.4 - 0.4 * std::cos(a), 0.4 - 0.4 * std::sin(a)});
    }
    if (!has_fillet) section.push_back({0, 0});
    section.insert(section.end(), {{10, 0}, {10, -2}});
    const Corners corner = extruded_mesh(section, -10, 10);
    SingleGrain single(0.02, 0.3, 0.4, k_diameter);
    single.rig.setup.gravity = {-4, 0, -8};
    single.rig.body("mesh",
                    {{"file", write_text_stl(folder / "corner.stl", corner)}, {"unit", 1e-3}});
    single.begin({.position = {1.4e-3, 0, 1.2e-3}, .rotation = {0, 3, 0}});
    single.until(0.2);
    CHECK(single.dem->report().contacts == 2);
    return single.now();
  };
  const GrainState sharp = come_to_rest(false);
  const GrainState round = come_to_rest(true);
  CHECK(norm(sharp.position - round.position) < 1e-10);
  CHECK(norm(round.velocity) < 1e-5);
  CHECK(round.position.x < 0.5 * k_diameter);
  CHECK(round.position.z < 0.5 * k_diameter);
}

TEST_CASE("a sphere shall slide down a funnel of triangles as down the exact one") {
  // A frustum of 72 sides: its faces lie inside the round one by 1 - cos(2.5 deg) = 0.1 % of the
  // radius at most, so that paths differ by little.
  const TemporaryFolder folder;
  const Corners c = ring_mesh({{{5, 0}, {6, 0}, {21, 20}, {20, 20}}}, 72);
  const auto slide = [&](bool is_mesh) {
    SingleGrain single(0.05, 0.2, 0.0, k_diameter);
    WallRig& rig = single.rig;
    if (is_mesh) {
      rig.body("mesh", {{"file", write_text_stl(folder / "f.stl", c)}, {"unit", 1e-3}});
    } else {
      // The inner face of the mesh; thickness across the wall: 1 mm wide along the end.
      rig.body("frustum", {{"base", Vec3{}},
                           {"axis", Vec3{0, 0, 1}},
                           {"length", 0.02},
                           {"radius", 0.005},
                           {"end_radius", 0.02},
                           {"thickness", 1e-3 * 20 / 25.0}});
    }
    // Touching the wall at z = 15 mm, on its way down the slope.
    single.begin({.position = {0.0145, 0.0005, 0.0151}});
    single.until(0.05);
    return single.now();
  };
  const GrainState exact = slide(false);
  const GrainState mesh = slide(true);
  CHECK(exact.velocity.z < -0.2);
  CHECK(norm(exact.position - mesh.position) < 1e-4);
  CHECK(norm(exact.velocity - mesh.velocity) < 0.05 * norm(exact.velocity));
}

TEST_CASE("the surfaces that a sphere may touch shall be those that say so one by one") {
  const TemporaryFolder folder;
  WallRig rig(0.5, 0.5, k_diameter);
  rig.setup.domain.sides[0].grains = dust::scenario::GrainSide::wall;
  Corners pegs;
  for (int n = 0; n < 30; ++n) {
    const Vec3 corner{6.0 * (n % 6), 6.0 * (n / 6), 0};
    const Corners peg = box_mesh(corner, corner + Vec3{3, 3, 5});
    pegs.insert(pegs.end(), peg.begin(), peg.end());
  }
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
  rig.body("mesh", {{"file", write_text_stl(folder / "pegs.stl", pegs)}, {"unit", 1e-3}},
           WallRig::motion("translate", {{"velocity", Vec3{0.1, 0, 0}}}));
  rig.body("plane", {{"point", Vec3{0, 0, 0.02}}, {"normal", Vec3{0, 0, -1}}});
  auto surfaces = dust::particles::surfaces_of(rig.setup, rig.bodies);
  REQUIRE(surfaces.size() == 33);
  dust::particles::move_to(0.02, surfaces);
  dust::particles::SurfaceSearch search;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.01, 0.05);
  std::size_t found = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{place(random), place(random), 0.5 * place(random)};
    const double reach = 0.2 * (0.01 + place(random));
    std::vector<std::int32_t> expected;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (surfaces[s].may_touch(p, reach, 0.01)) expected.push_back(static_cast<std::int32_t>(s));
    }
    const auto near = search.may_touch(surfaces, p, reach, 0.01);
    CHECK(std::vector<std::int32_t>(near.begin(), near.end()) == expected);
    found += near.size();
  }
  CHECK(found > 500);
}
