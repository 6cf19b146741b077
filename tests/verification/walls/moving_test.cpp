// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <random>

using dust::test::approx;
using namespace dust::test;
using dust::particles::NewGrain;
using dust::sdk::Value;
using dust::sdk::Vec3;

namespace {

constexpr double k_diameter = 1e-3;

}  // namespace

TEST_CASE("a moving wall shall drive off a resting grain at (1 + e) times its speed") {
  for (const double e : {0.3, 0.9}) {
    WallRig rig(e, 0.2, k_diameter);
    rig.body("plane", {{"point", Vec3{-0.002, 0, 0}}, {"normal", Vec3{1, 0, 0}}},
             rig.motion("translate", {{"velocity", Vec3{0.5, 0, 0}}}));
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{{.position = {}, .diameter = k_diameter}});
    Stepper stepper(*dem);
    while (stepper.time() < 0.01) stepper.step();
    // Declared = realised restitution within the law's 0.01.
    CHECK(grain(*dem, 0).velocity.x == approx(0.5 * (1 + e)).epsilon(0.01));
  }
}

TEST_CASE("sensors shall see how fast a wall moves where a grain touches it") {
  // A plate that turns about z and rises: at the contact point w x r and the velocity.
  WallRig rig(0.5, 0.3, k_diameter);
  const Vec3 rise{0.05, 0.02, 0.1};
  auto motions =
      rig.motion("rotate", {{"pivot", Vec3{}}, {"spin_axis", Vec3{0, 0, 1}}, {"spin", 3.0}});
  motions.push_back(std::move(rig.motion("translate", {{"velocity", rise}}).front()));
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}}, std::move(motions));
  auto dem = rig.make();
  const double overlap = 2e-6;
  const Vec3 place{0.04, 0.03, 0.5 * k_diameter - overlap};
  const Vec3 beside = place + Vec3{k_diameter - overlap, 0, 0};
  dem->insert(std::vector<NewGrain>{{.position = place, .diameter = k_diameter},
                                    {.position = beside, .diameter = k_diameter}});
  dem->neighbours();
  const auto contacts = dem->contacts(0.0);
  REQUIRE(contacts.size() == 3);
  int walls = 0;
  for (const auto& c : contacts) {
    if (c.row_j >= 0) {
      CHECK(norm(c.wall_velocity) == 0.0);
      continue;
    }
    ++walls;
    const double* at = dem->rows().position_of(static_cast<std::size_t>(c.row_i));
    const Vec3 wanted = rise + Vec3{-3.0 * at[1], 3.0 * at[0], 0.0};
    CHECK(norm(c.wall_velocity - wanted) < 1e-12);
  }
  CHECK(walls == 2);
}

TEST_CASE("sensors shall see contacts with a wall that moves where it stands then") {
  // A step late, the plate that rises would be off by speed x step: more than the overlap at rest.
  for (const double speed : {0.5, 0.05, -0.3}) {
    WallRig rig(0.5, 0.3, k_diameter);
    rig.setup.gravity = {0, 0, -9.81};
    rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}},
             rig.motion("translate", {{"velocity", Vec3{0, 0, speed}}}));
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{{.position = {0, 0, 0.5 * k_diameter - rig.resting_overlap()},
                                       .velocity = {0, 0, speed},
                                       .diameter = k_diameter}});
    Stepper stepper(*dem);
    while (stepper.time() < 0.05) stepper.step();
    const auto contacts = dem->contacts(stepper.time());
    CAPTURE(speed);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].force.z == approx(rig.mass() * 9.81).epsilon(1e-3));
    CHECK(contacts[0].overlap == approx(rig.resting_overlap()).epsilon(1e-3));
    CHECK(contacts[0].wall_velocity.z == approx(speed).epsilon(1e-9));
  }
}

TEST_CASE("a wall that sweeps through resting grains shall do what grains do that fly at a wall") {
  // The same in two frames of reference. The grains rest far from the wall, so that only the wall's
  // speed can tell that they will meet.
  const auto run = [](bool wall_moves) {
    WallRig rig(0.6, 0.4, k_diameter);
    const Vec3 u{1.0, 0, 0};
    rig.body("box", {{"min", Vec3{-0.3, -0.1, -0.1}}, {"max", Vec3{-0.05, 0.1, 0.1}}},
             wall_moves ? rig.motion("translate", {{"velocity", u}})
                        : std::vector<std::unique_ptr<dust::sdk::Motion>>{});
    auto dem = rig.make();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.03, 0.03);
    std::vector<NewGrain> grains;
    for (int n = 0; n < 200; ++n) {
      grains.push_back(
          {.position = {place(random), 0.006 * (n % 20) - 0.06, 0.006 * (n / 20) - 0.03},
           .velocity = wall_moves ? Vec3{} : -1.0 * u,
           .diameter = k_diameter});
    }
    dem->insert(grains);
    Stepper stepper(*dem);
    while (stepper.time() < 0.15) stepper.step();
    std::vector<GrainState> states;
    for (int n = 0; n < 200; ++n) {
      states.push_back(grain(*dem, n));
      if (!wall_moves) continue;
      states.back().position -= stepper.time() * u;
      states.back().velocity -= u;
    }
    return states;
  };
  const auto moving = run(true);
  const auto static_pile = run(false);
  for (std::size_t n = 0; n < moving.size(); ++n) {
    CHECK(static_pile[n].velocity.x > 0.5);  // all were met
    CHECK(norm(moving[n].position - static_pile[n].position) < 1e-9);
    CHECK(norm(moving[n].velocity - static_pile[n].velocity) < 1e-7);
  }
}

TEST_CASE("a lifted tube shall let grains go that it held, and stop where it is told") {
  WallRig rig(0.3, 0.5, k_diameter, 0.1);
  rig.setup.gravity = {0, 0, -k_g};
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
  rig.body(
      "cylinder",
      {{"base", Vec3{0, 0, 1e-4}},
       {"axis", Vec3{0, 0, 1}},
       {"length", 0.02},
       {"radius", 3e-3},
       {"thickness", 1e-3}},
      rig.motion("translate", {{"velocity", Vec3{0, 0, 0.05}}, {"start", 0.1}, {"travel", 0.005}}));
  auto dem = rig.make();
  std::vector<NewGrain> grains;
  for (int layer = 0; layer < 6; ++layer) {
    for (int n = 0; n < 7; ++n) {
      const double a = 2 * std::numbers::pi * n / 6 + 0.2 * layer;
      const double r = n == 6 ? 0.0 : 1.5e-3;
      grains.push_back({.position = {r * std::cos(a), r * std::sin(a), 6e-4 + 1.2e-3 * layer},
                        .diameter = k_diameter});
    }
  }
  dem->insert(grains);
  Stepper stepper(*dem);
  const auto farthest = [&] {
    double r = 0.0;
    for (std::size_t n = 0; n < grains.size(); ++n) {
      const GrainState g = grain(*dem, static_cast<std::int64_t>(n));
      r = std::max(r, std::hypot(g.position.x, g.position.y));
      CHECK(g.position.z > 0.0);
    }
    return r;
  };
  while (stepper.time() < 0.1) stepper.step();
  CHECK(farthest() < 2.51e-3);  // held: the tube's radius less the grain's
  while (stepper.time() < 0.3) stepper.step();
  CHECK(farthest() > 3e-3);  // let go
  CHECK(rig.bodies[1].nearest({0, 0, 0.03}, rig.bodies[1].placement(1.0)).distance ==
        approx(std::hypot(3e-3, 0.03 - 0.0251)).epsilon(1e-9));
}

TEST_CASE("a sphere in a turning drum shall end at the bottom with the drum's surface speed") {
  // Without rolling resistance friction spins it up until nothing slips: spin r = omega R.
  WallRig rig(0.3, 0.4, 2e-3);
  rig.setup.gravity = {0, 0, -k_g};
  rig.body("cylinder",
           {{"base", Vec3{0, -0.01, 0}},
            {"axis", Vec3{0, 1, 0}},
            {"length", 0.02},
            {"radius", 0.02},
            {"thickness", 1e-3}},
           rig.motion("rotate", {{"pivot", Vec3{}}, {"spin_axis", Vec3{0, 1, 0}}, {"spin", 3.0}}));
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.position = {0, 0, -0.019}, .diameter = 2e-3}});
  Stepper stepper(*dem);
  // It swings about the bottom while it slips; the rest of the swing is small by then.
  while (stepper.time() < 0.5) stepper.step();
  const GrainState g = grain(*dem, 0);
  // Surface speed at the bottom: omega x r = 3 * 0.02 towards -x; the grain's top turns with it.
  const Vec3 wall = rig.bodies[0].surface_velocity({0, 0, -0.02}, {0, 0, 1}, 0.5);
  CHECK(norm(wall - Vec3{-0.06, 0, 0}) < 1e-12);
  const Vec3 normal =
      -1.0 * Vec3{g.position.x, 0, g.position.z} / std::hypot(g.position.x, g.position.z);
  const Vec3 drum = rig.bodies[0].surface_velocity(g.position - 1e-3 * normal, normal, 0.5);
  const Vec3 grain_surface = g.velocity + cross(g.rotation, -1e-3 * normal);
  CHECK(norm(grain_surface - drum) < 0.01 * 0.06);
}

TEST_CASE("a grain shall ride on a floor that shakes gently and leave one that shakes hard") {
  // The floor falls away from the grain when A (2 pi f)^2 > g.
  for (const double gamma : {0.7, 2.5}) {
    constexpr double f = 30.0;
    const double rate = 2 * std::numbers::pi * f;
    const double amplitude = gamma * k_g / (rate * rate);
    WallRig rig(0.3, 0.4, k_diameter);
    rig.setup.gravity = {0, 0, -k_g};
    rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}},
             rig.motion("oscillate", {{"amplitude", std::vector<double>{amplitude}},
                                      {"frequency", std::vector<double>{f}},
                                      {"along", std::vector<Vec3>{{0, 0, 1}}}}));
    auto dem = rig.make();
    const double rest = 0.5 * k_diameter - rig.resting_overlap();
    // With the floor's speed at the start, so that it is not struck.
    dem->insert(std::vector<NewGrain>{
        {.position = {0, 0, rest}, .velocity = {0, 0, amplitude * rate}, .diameter = k_diameter}});
    Stepper stepper(*dem);
    double highest = -1.0;
    while (stepper.time() < 0.1) {
      stepper.step();
      const double floor = amplitude * std::sin(rate * stepper.time());
      highest = std::max(highest, grain(*dem, 0).position.z - floor - 0.5 * k_diameter);
    }
    if (gamma < 1.0) {
      CHECK(highest < 0.0);
    } else {
      // Thrown at the phase where A w^2 sin = g, with the floor's speed: it flies while the floor
      // falls; the gap exceeds what a free fall from the floor's top would leave at first.
      CHECK(highest > 0.5 * amplitude);
    }
  }
}

TEST_CASE("a body taken away shall let go of what lay on it") {
  WallRig rig(0.3, 0.4, k_diameter);
  rig.setup.gravity = {0, 0, -k_g};
  rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}});
  auto dem = rig.make();
  const double rest = 0.5 * k_diameter - rig.resting_overlap();
  dem->insert(std::vector<NewGrain>{{.position = {0, 0, rest}, .diameter = k_diameter}});
  Stepper stepper(*dem);
  while (stepper.time() < 0.01) stepper.step();
  CHECK(grain(*dem, 0).position.z == approx(rest).epsilon(1e-6));
  const double gone = stepper.time();
  rig.bodies[0].removed_at = gone;
  dem->bodies_changed();
  while (stepper.time() < gone + 0.02) stepper.step();
  const double fallen = stepper.time() - gone;
  // The grain leaves from rest; its first kick still knows the contact of the step before.
  CHECK(rest - grain(*dem, 0).position.z == approx(0.5 * k_g * fallen * fallen).epsilon(0.01));
  CHECK(dem->report().contacts == 0);
}

TEST_CASE("a run with moving walls shall resume with the same bits") {
  const auto make = [](WallRig& rig) {
    rig.setup.gravity = {0, 0, -k_g};
    rig.body("plane", {{"point", Vec3{}}, {"normal", Vec3{0, 0, 1}}},
             rig.motion("oscillate", {{"amplitude", std::vector<double>{3e-4}},
                                      {"frequency", std::vector<double>{40.0}},
                                      {"along", std::vector<Vec3>{{0, 0.2, 1}}}}));
    rig.body(
        "box", {{"min", Vec3{-0.01, -0.005, 0.001}}, {"max", Vec3{-0.006, 0.005, 0.01}}},
        rig.motion("rotate", {{"pivot", Vec3{}}, {"spin_axis", Vec3{0, 0, 1}}, {"spin", 8.0}}));
    return rig.make();
  };
  std::vector<NewGrain> grains;
  for (int n = 0; n < 60; ++n) {
    grains.push_back({.position = {1.3e-3 * (n % 6) - 4e-3, 1.3e-3 * (n / 6 % 5) - 3e-3,
                                   1e-3 + 1.3e-3 * (n / 30)},
                      .diameter = k_diameter});
  }
  WallRig rig(0.4, 0.3, k_diameter, 0.1);
  auto dem = make(rig);
  dem->insert(grains);
  double time = 0.0;
  const auto run = [&](dust::particles::Dem& d, int steps) {
    for (int n = 0; n < steps; ++n) {
      d.neighbours();
      d.step_tiles(time);
      d.advance_fine();
      time += d.coarse_step();
    }
  };
  run(*dem, 1777);
  MemoryArchive archive;
  dem->synchronise();
  dem->save(archive);
  WallRig other(0.4, 0.3, k_diameter, 0.1);
  auto resumed = make(other);
  resumed->load(archive);
  const double half = time;
  run(*dem, 3000);
  time = half;
  run(*resumed, 3000);
  for (int n = 0; n < 60; ++n) {
    const GrainState a = grain(*dem, n);
    const GrainState b = grain(*resumed, n);
    CHECK(a.position == b.position);
    CHECK(a.velocity == b.velocity);
    CHECK(a.rotation == b.rotation);
  }
}

TEST_CASE("a grain at rest on a turning drum shall go on turning with it") {
  constexpr double k_spin = 10.0;
  constexpr double k_drum = 0.05;
  for (const double diameter : {4e-3, 0.4e-3}) {
    CAPTURE(diameter);
    WallRig rig(0.6, 0.5, diameter, 0.4);
    // The smaller one beside coarse ones: it steps at a rate of its own.
    rig.diameters = {diameter, 4e-3};
    if (diameter == 4e-3) rig.diameters = {diameter};
    rig.body("cylinder",
             {{"base", Vec3{0, -0.05, 0}},
              {"axis", Vec3{0, 1, 0}},
              {"length", 0.1},
              {"radius", k_drum},
              {"thickness", 5e-3}},
             rig.motion("rotate", {{"spin_axis", Vec3{0, 1, 0}}, {"spin", k_spin}}));
    rig.options.records_wall_loads = true;
    auto dem = rig.make();
    const double arm = k_drum - 0.5 * diameter;
    dem->insert(std::vector<NewGrain>{{.position = {0, 0, -arm},
                                       .velocity = {-k_spin * arm, 0, 0},
                                       .rotation = {0, k_spin, 0},
                                       .diameter = diameter}});
    Stepper stepper(*dem);
    while (stepper.time() < 0.15) stepper.step();
    const auto walls = dem->close_wall_loads(stepper.time(), stepper.time());
    const GrainState g = grain(*dem, 0);
    CHECK(g.rotation.y == approx(k_spin).epsilon(1e-3));
    CHECK(norm(g.velocity) == approx(k_spin * arm).epsilon(1e-3));
    const double energy = 0.5 * rig.mass() * std::pow(k_spin * arm, 2);
    CHECK(std::abs(walls.power[0] * stepper.time()) < 2e-3 * energy);
  }
}

TEST_CASE("a grain stuck to a belt shall turn with it round the pulley") {
  constexpr double k_speed = 0.2;
  constexpr double k_face = 0.02;
  constexpr double k_size = 4e-3;
  WallRig rig(0.5, 2.0, k_size);
  rig.laws.clear();
  rig.laws_of(rig.sand, rig.sand, {"hertz_mindlin", {{"restitution", 0.5}, {"friction", 2.0}}},
              {"epsd2", {{"friction", 1.0}}}, {"jkr", {{"surface_energy", 5.0}}});
  rig.body("conveyor", {{"head", Vec3{0, 0, 0}}, {"tail", Vec3{-0.2, 0, 0}}, {"radius", k_face}},
           rig.motion("belt", {{"speed", k_speed}}));
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.position = {-0.005, 0, k_face + 0.5 * k_size},
                                     .velocity = {k_speed, 0, 0},
                                     .diameter = k_size}});
  Stepper stepper(*dem);
  // Half way round: pi k_face / 2 after the head's axis.
  const double time = (0.005 + 0.5 * std::numbers::pi * k_face) / k_speed;
  while (stepper.time() < time) stepper.step();
  const GrainState g = grain(*dem, 0);
  CHECK(norm(g.position) == approx(k_face + 0.5 * k_size).epsilon(0.01));
  CHECK(g.rotation.y == approx(k_speed / k_face).epsilon(0.03));
  // Its centre goes round at the belt's rate, not at the belt's speed.
  CHECK(norm(g.velocity) == approx(k_speed * (1 + 0.5 * k_size / k_face)).epsilon(0.03));
  CHECK(std::abs(std::atan2(g.position.z, g.position.x)) < 0.1);
}
