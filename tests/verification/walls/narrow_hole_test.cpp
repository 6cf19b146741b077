// SPDX-License-Identifier: Apache-2.0
// Grains on holes that are narrower than they are: they rest on the rim all round.
#include "support/approx.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

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

/// A grain over a hole round the z-axis whose upper rim is at z = 0.
struct Hole {
  WallRig rig;
  std::unique_ptr<dust::particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;

  Hole(const std::string& shape, double restitution, double friction, NewGrain grain,
       double radius = k_hole)
      : rig(restitution, friction, k_diameter, friction > 0.0 ? 0.05 : -1.0) {
    rig.setup.domain.min = {-0.05, -0.05, -0.05};
    rig.setup.domain.max = {0.05, 0.05, 0.05};
    rig.setup.gravity = {0, 0, -k_g};
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
    } else {  // a funnel that opens upwards from the hole
      rig.body("frustum", {{"base", Vec3{}},
                           {"axis", up},
                           {"radius", radius},
                           {"end_radius", 1e-2},
                           {"length", 5e-3},
                           {"thickness", 1e-3}});
    }
    dem = rig.make();
    grain.diameter = k_diameter;
    dem->insert(std::vector<NewGrain>{grain});
    stepper = std::make_unique<Stepper>(*dem);
  }
  EnergyBalance until(double time) {
    while (stepper->time() < time) stepper->step();
    return dem->energy();
  }
  GrainState now() { return grain(*dem, 0); }
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
        Case{"frustum", 0.2}, Case{"frustum", 0.9}}) {
    CAPTURE(shape);
    CAPTURE(restitution);
    Hole hole(shape, restitution, 0.5, falling({2e-4, -1e-4, k_radius + 1e-3}, {0.02, 0.01, 0}));
    const EnergyBalance b = hole.until(0.5);
    const GrainState end = hole.now();
    CHECK(std::hypot(end.position.x, end.position.y) < 1e-3 * k_hole);
    // Lower than a rigid one by what it presses into the rim, some 1e-4 of its radius.
    CHECK(end.position.z == approx(k_height).epsilon(2e-4));
    CHECK(b.translation + b.rotation < 1e-6 * b.gravity);
    CHECK(std::abs(b.relative_error()) < 2e-4);
  }
}

TEST_CASE("an elastic grain without friction shall keep its energy on the rim of a narrow hole") {
  for (const std::string shape : {"disc", "frustum"}) {
    CAPTURE(shape);
    Hole hole(shape, 1.0, 0.0, falling({1e-4, 0, k_radius + 2e-4}, {0.0, 0.02, 0}));
    double highest = 0.0;
    const double whole = hole.rig.mass() * k_g * (k_radius + 2e-4 - k_height);
    for (double time = 0.0; time < 0.3; time += 1e-3) {
      const EnergyBalance b = hole.until(time);
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
    const EnergyBalance b = hole.until(0.035);
    CHECK(dot(hole.now().position, along) > 2e-3);
    CHECK(std::abs(b.relative_error()) < 2e-3);
    CHECK(norm(hole.now().velocity) < k_speed);
  }
}
