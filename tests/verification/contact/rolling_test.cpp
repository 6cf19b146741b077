// SPDX-License-Identifier: Apache-2.0
// Sliding, rolling and rolling resistance on planes and belts against closed forms.
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_g = 9.81;
constexpr double k_radius = 3e-4;

/// A grain on the plane z = 0 under gravity tilted by `angle` towards +x.
struct Plane {
  DemRig rig;
  std::unique_ptr<dust::particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;

  Plane(double friction, double rolling, double angle, Vec3 velocity, Vec3 spin,
        double radius = k_radius, double belt_speed = 0.0) {
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.5, friction, rolling);
    rig.diameters = {2 * radius};
    rig.setup.domain.min = {-2, -2, belt_speed == 0.0 ? 0.0 : -1.0};
    rig.setup.domain.max = {2, 2, 2};
    rig.setup.gravity = {k_g * std::sin(angle), 0, -k_g * std::cos(angle)};
    if (belt_speed == 0.0) {
      rig.wall(4, sand);
    } else {
      dust::scenario::BodySpec spec;
      spec.name = "belt";
      spec.material = sand;
      spec.shape = {.kind = "shape",
                    .name = "conveyor",
                    .values = {Vec3{1, 0, -0.1}, Vec3{-1, 0, -0.1}, 0.1, 0.0},
                    .path = {},
                    .where = {}};
      rig.bodies.push_back(dust::bodies::make_body(
          rig.setup, spec,
          ModelLoader::make<dust::sdk::Motion>("motion", "belt", {{"speed", belt_speed}})));
    }
    dem = rig.make();
    // The overlap at rest, so that the grain neither falls nor bounces.
    const double mass = 2650 * 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    const double young = 50e6 / (1 - 0.09) / 2;
    const double overlap =
        std::pow(mass * k_g * std::cos(angle) / (4.0 / 3.0 * young * std::sqrt(radius)), 2.0 / 3.0);
    dem->insert(std::vector<NewGrain>{{.position = {0, 0, radius - overlap},
                                       .velocity = velocity,
                                       .rotation = spin,
                                       .diameter = 2 * radius}});
    stepper = std::make_unique<Stepper>(*dem);
  }
  void until(double time) {
    while (stepper->time() < time) stepper->step();
  }
  GrainState now() { return grain(*dem, 0); }
};

}  // namespace

TEST_CASE("a sliding sphere shall end rolling at 5/7 of its speed, whatever the friction") {
  // MFIX DEM04: t mu g / u0 = 2/7.
  constexpr double u0 = 0.1;
  for (const double mu : {0.2, 0.6, 1.0}) {
    Plane p(mu, -1.0, 0.0, {u0, 0, 0}, {}, 5e-4);
    const double end = 2.0 / 7.0 * u0 / (mu * k_g);
    p.until(0.98 * end);
    GrainState g = p.now();
    CHECK(g.velocity.x - 5e-4 * g.rotation.y > 0.005 * u0);  // still slides
    p.until(1.05 * end);
    g = p.now();
    CHECK(g.velocity.x == approx(5.0 / 7.0 * u0).epsilon(0.002));
    CHECK(5e-4 * g.rotation.y == approx(5.0 / 7.0 * u0).epsilon(0.002));
  }
}

TEST_CASE("a sphere on an incline shall stay below tan = mu_r and roll above it") {
  constexpr double mu_r = 0.3;
  constexpr double time = 0.05;
  {
    Plane p(2.0, mu_r, std::atan(0.9 * mu_r), {}, {});
    p.until(time);
    CHECK(std::abs(p.now().position.x) < 0.01 * k_radius);
  }
  {
    const double angle = std::atan(1.5 * mu_r);
    Plane p(2.0, mu_r, angle, {}, {});
    p.until(time);
    const double a = 5.0 / 7.0 * k_g * (std::sin(angle) - mu_r * std::cos(angle));
    CHECK(p.now().velocity.x == approx(a * time).epsilon(0.01));
  }
}

TEST_CASE("rolling on a plane shall decay with 5/7 mu_r g") {
  constexpr double v0 = 0.2;
  Plane p(2.0, 0.3, 0.0, {v0, 0, 0}, {0, v0 / k_radius, 0});
  p.until(0.05);
  CHECK(p.now().velocity.x == approx(v0 - 5.0 / 7.0 * 0.3 * k_g * 0.05).epsilon(0.01));
  p.until(0.12);
  // Stop distance 7 v0^2 / (10 mu_r g).
  CHECK(p.now().position.x == approx(0.7 * v0 * v0 / (0.3 * k_g)).epsilon(0.01));
  CHECK(std::abs(p.now().velocity.x) < 1e-3);
}

TEST_CASE("without rolling resistance a sphere shall roll or slide down an incline") {
  constexpr double mu = 0.3;
  constexpr double time = 0.03;
  {
    const double angle = std::atan(2.0 * mu);  // below 3.5 mu: rolls
    Plane p(mu, -1.0, angle, {}, {});
    p.until(time);
    CHECK(p.now().velocity.x == approx(5.0 / 7.0 * k_g * std::sin(angle) * time).epsilon(0.005));
  }
  {
    const double angle = std::atan(5.0 * mu);
    Plane p(mu, -1.0, angle, {}, {});
    p.until(time);
    CHECK(p.now().velocity.x ==
          approx(k_g * (std::sin(angle) - mu * std::cos(angle)) * time).epsilon(0.005));
    CHECK(p.now().rotation.y * k_radius ==
          approx(2.5 * mu * k_g * std::cos(angle) * time).epsilon(0.005));
  }
}

TEST_CASE("the saturated couple shall slow a spin by 5/2 mu_r g / R") {
  constexpr double mu_r = 0.3;
  constexpr double spin = 2000.0;
  Plane p(0.0, mu_r, 0.0, {}, {0, spin, 0});
  p.until(0.04);
  CHECK(spin - p.now().rotation.y == approx(2.5 * mu_r * k_g / k_radius * 0.04).epsilon(0.005));
}

TEST_CASE("a belt shall pick up a resting grain as the table says") {
  struct Row {
    double belt, mu_r, end, speed, distance;
  };
  // belt_pickup: end of slip, speed and place then; mu_s 0.55. R 0.3 mm.
  const Row rows[] = {{0.2, 0.0, 0.01059, 0.0571, 0.00030},
                      {0.4, 0.3, 0.03470, 0.1872, 0.00325},
                      {0.8, 0.0, 0.04236, 0.2286, 0.00484},
                      {0.8, 0.3, 0.06940, 0.3745, 0.01299}};
  for (const Row& r : rows) {
    Plane p(0.55, r.mu_r, 0.0, {}, {}, k_radius, r.belt);
    p.until(r.end);
    CHECK(p.now().velocity.x == approx(r.speed).epsilon(0.02));
    CHECK(p.now().position.x == approx(r.distance).epsilon(0.02));
    if (r.mu_r == 0.0) {
      p.until(2.0 * r.end);
      CHECK(p.now().velocity.x == approx(2.0 / 7.0 * r.belt).epsilon(0.02));
    }
  }
}

TEST_CASE("a grain glued by friction shall leave the head pulley where u^2 / (g R) = cos") {
  constexpr double pulley = 0.1;
  constexpr double k_degrees = 2.0;
  for (const double speed : {0.5, 0.7}) {
    Plane p(20.0, 20.0, 0.0, {speed, 0, 0}, {}, k_radius, speed);
    double angle = -1.0;
    // The grain starts on the run at x = 0, one metre before the pulley: put the start nearer.
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.5, 20.0, 20.0);
    rig.diameters = {2 * k_radius};
    rig.setup.gravity = {0, 0, -k_g};
    dust::scenario::BodySpec spec;
    spec.material = sand;
    spec.shape = {.kind = "shape",
                  .name = "conveyor",
                  .values = {Vec3{0, 0, -pulley}, Vec3{-0.5, 0, -pulley}, pulley, 0.0},
                  .path = {},
                  .where = {}};
    rig.bodies.push_back(dust::bodies::make_body(
        rig.setup, spec,
        ModelLoader::make<dust::sdk::Motion>("motion", "belt", {{"speed", speed}})));
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{{.position = {-0.002, 0, k_radius - 2e-8},
                                       .velocity = {speed, 0, 0},
                                       .diameter = 2 * k_radius}});
    Stepper stepper(*dem);
    int apart = 0;
    while (stepper.time() < 0.4 && apart < 200) {
      stepper.step();
      const GrainState g = grain(*dem, 0);
      if (g.position.x < 0.0) continue;
      if (dem->report().contacts > 0) {
        apart = 0;
        angle = std::atan2(g.position.x, g.position.z + pulley) * 180.0 / std::numbers::pi;
      } else {
        ++apart;
      }
    }
    // The grain's centre runs at R + r.
    const double expected =
        std::acos(speed * speed / (k_g * (pulley + k_radius))) * 180.0 / std::numbers::pi;
    CAPTURE(speed);
    CHECK(std::abs(angle - expected) < k_degrees);
  }
}
