// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/bodies/meshes.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

using dust::test::approx;
using namespace dust::test;
using dust::particles::NewGrain;
using dust::sdk::Vec3;

namespace {

constexpr double k_diameter = 1e-3;

/// Grains that lie on a belt of this speed, which slide for 2 U / (7 mu g).
struct OnBelt : WallRig {
  OnBelt(double friction, double speed) : WallRig(0.3, friction, k_diameter) {
    setup.gravity = {0, 0, -k_g};
    body("conveyor",
         {{"head", Vec3{0.2, 0, -0.01}}, {"tail", Vec3{-0.2, 0, -0.01}}, {"radius", 0.01}},
         motion("belt", {{"speed", speed}}));
    options.records_wall_loads = true;
  }
  [[nodiscard]] NewGrain at(double x) const {
    return {.position = {x, 0, 0.5 * k_diameter - resting_overlap()}, .diameter = k_diameter};
  }
};

}  // namespace

TEST_CASE("a wall shall carry the weight of what rests on it, at its place") {
  WallRig rig(0.3, 0.4, k_diameter);
  rig.setup.gravity = {0, 0, -k_g};
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}}).group = "floor";
  rig.options.records_wall_loads = true;
  auto dem = rig.make();
  const double rest = 0.5 * k_diameter - rig.resting_overlap();
  // Of weight 0.5 the second: half a real grain.
  dem->insert(std::vector<NewGrain>{
      {.position = {0.01, 0, rest}, .diameter = k_diameter},
      {.position = {0.03, 0.02, rest}, .diameter = k_diameter, .weight = 0.5}});
  Stepper stepper(*dem);
  while (stepper.time() < 0.02) stepper.step();
  dem->close_wall_loads(stepper.time(), stepper.time());
  const double before = stepper.time();
  while (stepper.time() < before + 0.01) stepper.step();
  const auto walls = dem->close_wall_loads(stepper.time() - before, stepper.time());
  REQUIRE(walls.name.size() == 1);
  CHECK(walls.name[0] == "plane");
  CHECK(walls.group[0] == "floor");
  const double weight = 1.5 * rig.mass() * k_g;
  CHECK(norm(walls.force[0] - Vec3{0, 0, -weight}) < 1e-6 * weight);
  // x cross F about the origin, the second with half the weight.
  const double mg = rig.mass() * k_g;
  CHECK(norm(walls.torque[0] - Vec3{-0.5 * 0.02 * mg, (0.01 + 0.5 * 0.03) * mg, 0}) <
        1e-6 * 0.04 * mg);
  CHECK(walls.mass[0] == approx(1.5 * rig.mass()).epsilon(1e-12));
  CHECK(walls.contacts[0] == 2);
  CHECK(walls.power[0] == 0.0);
  CHECK(walls.impacts.empty());
}

TEST_CASE("an impact shall give a wall the momentum it takes from the grain, and be seen once") {
  WallRig rig(0.5, 0.3, k_diameter);
  rig.body("box", {{"min", Vec3{-0.05, -0.05, -0.05}}, {"max", Vec3{0.05, 0.05, 0}}});
  rig.options.records_wall_loads = true;
  auto dem = rig.make();
  const Vec3 before{0.8, 0, -1.0};
  dem->insert(std::vector<NewGrain>{{.position = {0.002, 0.001, 5.1e-4},
                                     .velocity = before,
                                     .rotation = {0, 100, 0},
                                     .diameter = k_diameter}});
  const GrainState start = grain(*dem, 0);
  Stepper stepper(*dem);
  while (stepper.time() < 2e-3) stepper.step();
  const double time = stepper.time();
  const auto walls = dem->close_wall_loads(time, stepper.time());
  const GrainState g = grain(*dem, 0);
  CHECK(g.velocity.z > 0.3);
  const double m = rig.mass();
  const Vec3 momentum = m * (start.velocity - g.velocity);
  CHECK(norm(time * walls.force[0] - momentum) < 1e-9 * m);
  // Angular momentum about the origin: m x cross v + I omega. The wall acts at the grain's place of
  // each step; the integrator keeps it to second order in the step.
  const double inertia = 0.4 * m * g.radius * g.radius;
  const auto angular = [&](const GrainState& s) {
    return m * cross(s.position, s.velocity) + inertia * s.rotation;
  };
  CHECK(norm(time * walls.torque[0] - (angular(start) - angular(g))) < 2e-3 * norm(angular(start)));
  REQUIRE(walls.impacts.size() == 1);
  CHECK(walls.impacts[0].normal_energy == approx(0.5 * m).epsilon(1e-9));
  // The grain's surface: v_x - omega_y r = 0.8 - 100 * 0.5e-3, the lever shorter by half the first
  // overlap.
  CHECK(walls.impacts[0].tangential_energy ==
        approx(0.5 * m * std::pow(0.8 - 100 * 5e-4, 2)).epsilon(1e-3));
  CHECK(walls.mass[0] == 0.0);
  const auto after = dem->close_wall_loads(1.0, stepper.time());
  CHECK(after.impacts.empty());
  CHECK(after.force[0] == Vec3{});
}

TEST_CASE("a floor that lifts a grain shall spend its weight times the speed") {
  WallRig rig(0.3, 0.4, k_diameter);
  rig.setup.gravity = {0, 0, -k_g};
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}},
           rig.motion("translate", {{"velocity", Vec3{0, 0, 0.2}}}));
  rig.options.records_wall_loads = true;
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.position = {0, 0, 0.5 * k_diameter - rig.resting_overlap()},
                                     .velocity = {0, 0, 0.2},
                                     .diameter = k_diameter}});
  Stepper stepper(*dem);
  while (stepper.time() < 0.05) stepper.step();
  const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
  // The time mean over the small oscillation of the start.
  CHECK(walls.power[0] == approx(rig.mass() * k_g * 0.2).epsilon(1e-3));
}

TEST_CASE("a belt that takes a grain along shall spend what the grain gains and friction eats") {
  // Sliding all the time: power = mu m g U, half of it lost while the speeds differ.
  constexpr double mu = 0.3;
  constexpr double speed = 1.0;
  OnBelt rig(mu, speed);
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{rig.at(0)});
  Stepper stepper(*dem);
  // Slip ends at t = 2 U / (7 mu g) = 97 ms.
  while (stepper.time() < 0.06) stepper.step();
  const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
  CHECK(walls.power[0] == approx(mu * rig.mass() * k_g * speed).epsilon(2e-3));
  CHECK(walls.force[0].x == approx(-mu * rig.mass() * k_g).epsilon(2e-3));
}

TEST_CASE("an impact that slides shall tell its whole work, however seldom it is looked at") {
  // J = m (1 + e) v_n; the slip falls by 7/2 mu J(t) / m, so that the sum of F_n v_t dt is
  // J v_t - 7/4 mu J^2 / m.
  // So elastic that the damper hardly pulls as the two part: pulls wear nothing.
  constexpr double e = 0.95;
  constexpr double mu = 0.05;
  constexpr double weight = 3.0;
  const auto slide = [&](const std::vector<double>& diameters) {
    WallRig rig(e, mu, k_diameter);
    rig.diameters = diameters;
    rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
    rig.options.records_wall_loads = rig.options.records_wall_sliding = true;
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{{.position = {0.002, 0.001, 5.1e-4},
                                       .velocity = {0.8, 0, -1.0},
                                       .diameter = k_diameter,
                                       .weight = weight}});
    Stepper stepper(*dem);
    while (stepper.time() < 2e-3) stepper.step();
    // Looked at once, long after the impact of some 10 us.
    const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
    REQUIRE(walls.slidings.size() == 1);
    const auto s = walls.slidings[0];
    const double m = weight * rig.mass();
    const double impulse = m * (1.0 + e);
    CHECK(s.wall == 0);
    CHECK(s.impulse == approx(impulse).epsilon(0.01));
    CHECK(s.sliding == approx(impulse * 0.8 - 1.75 * mu * impulse * impulse / m).epsilon(0.02));
    CHECK(s.friction == approx(mu * s.sliding).epsilon(0.02));
    CHECK(norm(s.place - Vec3{0.002, 0.001, 0.0}) < 5e-5);
    CHECK(dem->close_wall_loads(1.0, stepper.time()).slidings.empty());
  };
  slide({k_diameter});
  slide({k_diameter, 8.0 * k_diameter});  // sub-cycled
}

TEST_CASE("grains that slide on a belt shall tell their weight times the way they slide") {
  constexpr double mu = 0.3;
  constexpr double speed = 1.0;
  OnBelt rig(mu, speed);
  rig.options.records_wall_sliding = true;
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{rig.at(0), rig.at(-0.1)});
  Stepper stepper(*dem);
  while (stepper.time() < 0.06) stepper.step();
  const double time = stepper.time();
  const auto walls = dem->close_wall_loads(time, time);
  // One per grain and list of neighbours, not per step.
  REQUIRE(walls.slidings.size() >= 2);
  CHECK(walls.slidings.size() < 100);
  double impulse = 0.0, way = 0.0, friction = 0.0, moment = 0.0;
  for (const auto& s : walls.slidings) {
    impulse += s.impulse;
    way += s.sliding;
    friction += s.friction;
    moment += s.impulse * s.place.x;
  }
  // Slip U - 7/2 mu g t.
  const double mg = rig.mass() * k_g;
  const double sliding = 2.0 * mg * (speed * time - 1.75 * mu * k_g * time * time);
  CHECK(impulse == approx(2.0 * mg * time).epsilon(1e-3));
  CHECK(way == approx(sliding).epsilon(3e-3));
  CHECK(friction == approx(mu * sliding).epsilon(3e-3));
  // The mean over the way of mu g t^2 / 2, one grain 100 mm behind the other.
  CHECK(moment / impulse == approx(mu * k_g * time * time / 6 - 0.05).epsilon(0.01));
}

TEST_CASE("slidings shall be kept only where they are asked for") {
  WallRig rig(0.5, 0.3, k_diameter);
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
  rig.options.records_wall_loads = true;
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{
      {.position = {0, 0, 5.1e-4}, .velocity = {0.8, 0, -1.0}, .diameter = k_diameter}});
  Stepper stepper(*dem);
  while (stepper.time() < 1e-3) stepper.step();
  const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
  CHECK(walls.impacts.size() == 1);
  CHECK(walls.slidings.empty());
}

TEST_CASE("a grain in a corner of a vessel shall count once for the vessel") {
  WallRig rig(0.3, 0.4, k_diameter);
  rig.setup.gravity = {-4, -3, -8};
  rig.body("container", {{"min", Vec3{}}, {"max", Vec3{0.02, 0.02, 0.02}}, {"thickness", 1e-3}});
  rig.options.records_wall_loads = true;
  auto dem = rig.make();
  dem->insert(
      std::vector<NewGrain>{{.position = {5.1e-4, 5.1e-4, 5.1e-4}, .diameter = k_diameter}});
  Stepper stepper(*dem);
  while (stepper.time() < 0.1) stepper.step();
  dem->close_wall_loads(1.0, stepper.time());
  const double before = stepper.time();
  while (stepper.time() < before + 0.01) stepper.step();
  const auto walls = dem->close_wall_loads(stepper.time() - before, stepper.time());
  REQUIRE(walls.name.size() == 1);
  CHECK(walls.contacts[0] == 1);
  CHECK(walls.mass[0] == approx(rig.mass()).epsilon(1e-12));
  CHECK(norm(walls.force[0] - rig.mass() * Vec3{-4, -3, -8}) < 1e-4 * rig.mass() * k_g);
}

TEST_CASE("a turning drum shall spend its torque times its spin, rolling couples among it") {
  constexpr double k_spin = 8.0;
  WallRig rig(0.5, 0.5, 4e-3, 0.3);
  rig.setup.gravity = {0, 0, -k_g};
  rig.body("cylinder",
           {{"base", Vec3{0, -0.05, 0}},
            {"axis", Vec3{0, 1, 0}},
            {"length", 0.1},
            {"radius", 0.05},
            {"thickness", 5e-3}},
           rig.motion("rotate", {{"spin_axis", Vec3{0, 1, 0}}, {"spin", k_spin}}));
  rig.options.records_wall_loads = true;
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.position = {0, 0, -0.048}, .diameter = 4e-3}});
  Stepper stepper(*dem);
  while (stepper.time() < 0.3) stepper.step();
  const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
  CHECK(walls.power[0] > 0.0);
  // The contact point is half an overlap within the drum's face.
  CHECK(walls.power[0] == approx(-k_spin * walls.torque[0].y).epsilon(1e-3));
}

TEST_CASE("a law that reaches farther than the touch shall make no impacts, nor hide any") {
  // Between an oily film, too thin to be felt, and the wall: it is looked at from 0.5 mm on.
  const auto impacts_of = [](Vec3 position, Vec3 velocity, double gravity, double duration) {
    WallRig rig(0.6, 0.3, k_diameter);
    rig.laws.clear();
    rig.laws_of(rig.sand, rig.sand, {"hertz_mindlin", {{"restitution", 0.6}, {"friction", 0.3}}},
                {}, {"lubrication", {{"viscosity", 1e-12}}});
    rig.setup.gravity = {0, 0, -gravity};
    rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
    rig.options.records_wall_loads = true;
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = position, .velocity = velocity, .diameter = k_diameter}});
    Stepper stepper(*dem);
    while (stepper.time() < duration) stepper.step();
    const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
    return std::vector(walls.impacts.begin(), walls.impacts.end());
  };
  // By 0.1 mm over it.
  CHECK(impacts_of({0, 0, 6e-4}, {2, 0, 0}, 0.0, 2e-3).empty());
  // From 0.2 mm: after 6.4 ms at 63 mm/s, then 0.6 times as fast each time, after 7.7 and 4.6 ms.
  const auto impacts = impacts_of({0, 0, 7e-4}, {}, k_g, 20e-3);
  REQUIRE(impacts.size() == 3);
  const double fall = 2650 * std::numbers::pi / 6 * std::pow(k_diameter, 3) * k_g * 2e-4;
  CHECK(impacts[0].normal_energy == approx(fall).epsilon(0.01));
  CHECK(impacts[1].normal_energy == approx(0.36 * fall).epsilon(0.05));
}
