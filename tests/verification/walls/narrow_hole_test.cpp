// SPDX-License-Identifier: Apache-2.0
// Grains on holes that are narrower than they are: they rest on the rim all round.
#include "support/approx.hpp"
#include "unit/bodies/meshes.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

using dust::test::approx;
using namespace dust::test;
using dust::particles::EnergyBalance;
using dust::particles::NewGrain;
using dust::sdk::Value;
using dust::sdk::Vec3;

namespace {

constexpr double k_diameter = 4e-3;
constexpr double k_radius = 0.5 * k_diameter;
constexpr double k_hole = 1.5e-3;
/// [m] Of the centre over the rim of a hole that the grain lies on.
const double k_height = std::sqrt(k_radius * k_radius - k_hole * k_hole);

/// [mm] Of a rim.
constexpr double k_rounding = 0.5;

/// Of a plate drawn as a mesh, "plate of 24"; 0 for the round shapes.
int faces_of(const std::string& shape) {
  if (shape == "rounded plate") return 72;
  return shape.rfind("plate of ", 0) == 0 ? std::stoi(shape.substr(9)) : 0;
}

/// A grain over a hole round the z-axis whose upper rim is at z = 0.
struct Hole : SingleGrain {
  Hole(const std::string& shape, double restitution, double friction, const NewGrain& grain,
       double radius = k_hole)
      : SingleGrain(0.05, restitution, friction, k_diameter, friction > 0.0 ? 0.05 : -1.0) {
    rig.setup.audit.energy = true;
    const Vec3 up{0, 0, 1};
    if (shape == "disc") {
      rig.body("disc", {{"centre", Vec3{0, 0, -1e-3}},
                        {"axis", up},
                        {"radius", 1e-2},
                        {"hole_radius", radius},
                        {"thickness", 1e-3}});
    } else if (shape == "cylinder") {
      rig.body("cylinder", {{"base", Vec3{0, 0, -5e-3}},
                            {"axis", up},
                            {"radius", radius},
                            {"length", 5e-3},
                            {"thickness", 1e-3}});
    } else if (shape == "frustum") {  // a funnel that opens upwards from the hole
      rig.body("frustum", {{"base", Vec3{}},
                           {"axis", up},
                           {"radius", radius},
                           {"end_radius", 1e-2},
                           {"length", 5e-3},
                           {"thickness", 1e-3}});
    } else {
      const TemporaryFolder folder;
      const double r = 1e3 * radius;
      std::vector<std::array<double, 2>> section = {{r, -1}, {10, -1}, {10, 0}};
      if (shape == "rounded plate") {
        for (int n = 0; n <= 15; ++n) {
          const double a = 0.5 * std::numbers::pi * n / 15;
          section.push_back({r + k_rounding * (1 - std::sin(a)), k_rounding * (std::cos(a) - 1)});
        }
      } else {
        section.push_back({r, 0});
      }
      const Corners plate = ring_mesh(section, faces_of(shape));
      rig.body("mesh", {{"file", write_text_stl(folder / "plate.stl", plate)}, {"unit", 1e-3}});
    }
    begin(grain);
  }
  EnergyBalance energy_at(double time) {
    until(time);
    return dem->energy();
  }
};

NewGrain falling(Vec3 position, Vec3 velocity = {}) {
  NewGrain grain{};
  grain.position = position;
  grain.velocity = velocity;
  return grain;
}

}  // namespace

TEST_CASE("a grain that falls on a hole narrower than itself shall come to rest in its middle") {
  using Case = std::pair<std::string, double>;
  for (const auto& [shape, restitution] :
       {Case{"disc", 0.1}, Case{"disc", 0.5}, Case{"cylinder", 0.1}, Case{"cylinder", 0.4},
        Case{"frustum", 0.2}, Case{"frustum", 0.9}, Case{"plate of 4", 0.5},
        Case{"plate of 24", 0.1}, Case{"plate of 72", 0.5}, Case{"plate of 200", 0.1}}) {
    CAPTURE(shape);
    CAPTURE(restitution);
    const int faces = faces_of(shape);
    // Flat faces are nearest in their middle.
    const double nearest = k_hole * (faces > 0 ? std::cos(std::numbers::pi / faces) : 1.0);
    const double height = std::sqrt(k_radius * k_radius - nearest * nearest);
    Hole hole(shape, restitution, 0.5, falling({2e-4, -1e-4, k_radius + 1e-3}, {0.02, 0.01, 0}));
    const EnergyBalance b = hole.energy_at(0.5);
    const GrainState end = hole.now();
    CHECK(std::hypot(end.position.x, end.position.y) < 1e-3 * k_hole);
    // Lower than a rigid one by what it presses into the rim, some 1e-4 of its radius.
    CHECK(end.position.z == approx(height).epsilon(2e-4));
    CHECK(b.translation + b.rotation < 1e-6 * b.gravity);
    // Faces that meet below 8 degrees are touched in strips, and the touch jumps within a strip.
    CHECK(std::abs(b.relative_error()) < (faces > 45 ? 1e-3 : 2e-4));
  }
}

TEST_CASE("a grain that falls on a hole with a rounded rim shall come to rest in its middle") {
  Hole hole("rounded plate", 0.3, 0.5, falling({2e-4, -1e-4, k_radius + 1e-3}, {0.02, 0.01, 0}));
  const EnergyBalance b = hole.energy_at(0.5);
  const GrainState end = hole.now();
  // As far from the middle of the rim's rounding as both radii; folds of 6 degrees lie inside it.
  const double rounding = 1e-3 * k_rounding;
  const double aside = k_hole + rounding;
  const double above = std::sqrt((k_radius + rounding) * (k_radius + rounding) - aside * aside);
  CHECK(std::hypot(end.position.x, end.position.y) < 1e-3 * k_hole);
  CHECK(end.position.z == approx(above - rounding).epsilon(2e-3));
  CHECK(hole.dem->report().contacts > 20);
  CHECK(b.translation + b.rotation < 1e-4 * b.gravity);
  CHECK(std::abs(b.relative_error()) < 1e-3);
}

TEST_CASE("an elastic grain without friction shall keep its energy on the rim of a narrow hole") {
  for (const std::string shape :
       {"disc", "frustum", "plate of 24", "plate of 200", "rounded plate"}) {
    CAPTURE(shape);
    Hole hole(shape, 1.0, 0.0, falling({1e-4, 0, k_radius + 2e-4}, {0.0, 0.02, 0}));
    double highest = 0.0;
    const double whole = hole.rig.mass() * k_g * (k_radius + 2e-4 - k_height);
    for (double time = 0.0; time < 0.3; time += 1e-3) {
      const EnergyBalance b = hole.energy_at(time);
      // A little is lost as the sharp rim turns the normal within a step; none may come.
      REQUIRE(b.error() > -1e-4 * whole);
      REQUIRE(b.error() < 0.01 * whole);
      highest = std::max(highest, hole.now().position.z);
    }
    // Never higher than it came from, by its energy.
    CHECK(highest < k_radius + 2e-4 + 0.5 * 0.02 * 0.02 / k_g + 1e-5);
  }
}

TEST_CASE("a grain that rolls across a hole narrower than itself shall neither gain nor stop") {
  constexpr double k_speed = 0.3;
  // Along a face's middle, and along a fold between two.
  for (const double angle : {0.0, std::numbers::pi / 24.0}) {
    CAPTURE(angle);
    const Vec3 along{std::cos(angle), std::sin(angle), 0};
    NewGrain grain = falling(-6e-3 * along + Vec3{0, 0, k_radius - 1e-7}, k_speed * along);
    grain.rotation = cross(Vec3{0, 0, 1}, along) * (k_speed / k_radius);
    Hole hole("disc", 0.9, 0.5, grain, 0.3 * k_radius);
    const EnergyBalance b = hole.energy_at(0.035);
    CHECK(dot(hole.now().position, along) > 2e-3);
    CHECK(std::abs(b.relative_error()) < 2e-3);
    CHECK(norm(hole.now().velocity) < k_speed);
  }
}

TEST_CASE("a grain that rests on a slope shall keep its springs where larger ones cut its plate") {
  const TemporaryFolder folder;
  const std::string plate =
      write_text_stl(folder / "plate.stl", ring_mesh({{{5, -1}, {20, -1}, {20, 0}, {5, 0}}}, 4));
  const auto on_plate = [&](SingleGrain& on, double largest) {
    on.rig.setup.gravity = {1.0, 0, -9.81};
    on.rig.body("mesh", {{"file", plate}, {"unit", 1e-3}});
    on.rig.diameters = {2e-3, largest};
  };
  SingleGrain small(0.05, 0.1, 0.5, 2e-3, 0.5);
  on_plate(small, 3e-3);
  small.begin(falling({12e-3, 1e-4, 1e-3}));
  small.until(0.2);
  REQUIRE(norm(small.now().velocity) < 1e-9);
  SingleGrain large(0.05, 0.1, 0.5, 2e-3, 0.5);
  on_plate(large, 12e-3);
  large.dem = large.rig.make();
  REQUIRE(large.rig.bodies[0].shape->parts() > small.rig.bodies[0].shape->parts());
  small.dem->synchronise();
  const dust::particles::LawTransfer keeps{.law = 0, .keeps_contact = true, .keeps_rolling = true};
  const auto report = large.dem->transfer_from(*small.dem, 0.2, {&keeps, 1});
  CHECK(report.contacts == 1);
  CHECK(report.without_past == 0);
  const Vec3 rest = small.now().position;
  large.stepper = std::make_unique<dust::test::Stepper>(*large.dem);
  double farthest = 0.0;
  while (large.stepper->time() < 2e-3) {
    large.stepper->step();
    farthest = std::max(farthest, norm(large.now().position - rest));
  }
  // Without its springs it slips by what they were stretched, some 1e-8 m.
  CHECK(farthest < 1e-11);
}
