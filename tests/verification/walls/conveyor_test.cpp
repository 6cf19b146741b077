// SPDX-License-Identifier: Apache-2.0
// Lumps on belts of finite width: no energy from the surface, and where a belt throws them.
#include "support/approx.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using dust::particles::NewGrain;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_lump = 0.03;  // [m] radius
constexpr double k_pulley = 0.3;
constexpr double k_thickness = 0.02;

/// One lump on a belt whose top is z = 0 over the head pulley, which is at x = 0.
struct LumpOnBelt {
  WallRig rig;
  std::unique_ptr<dust::particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;

  struct Belt {
    double speed = 0.0;
    double trough_angle = 0.0;
    double direction = 0.0;  ///< [rad] in plan
    double friction = 0.0;
    double rolling = -1.0;
    double restitution = 1.0;
    double young_modulus = 50e6;
    DemRig::Choice cohesion;  ///< none without a name
  };
  LumpOnBelt(const Belt& belt, Vec3 position, Vec3 velocity)
      : rig(belt.restitution, belt.friction, 2 * k_lump, belt.rolling) {
    rig.setup.gravity = {0, 0, -k_g};
    rig.setup.domain.min = {-10, -10, -10};
    rig.setup.domain.max = {10, 10, 10};
    rig.setup.time.expected_speed = 10.0;
    auto& sand = rig.setup.materials[static_cast<std::size_t>(rig.sand)].properties;
    auto& laws = rig.laws[0];
    sand.young_modulus = belt.young_modulus;
    laws.contact->prepare(sand, sand);
    if (laws.rolling) laws.rolling->prepare(sand, sand);
    if (!belt.cohesion.name.empty()) {
      laws.cohesion = ModelLoader::make<dust::sdk::CohesionLaw>("cohesion", belt.cohesion.name,
                                                                belt.cohesion.values);
      laws.cohesion->prepare(sand, sand);
    }
    const Vec3 along{std::cos(belt.direction), std::sin(belt.direction), 0.0};
    const Vec3 head{0, 0, -k_pulley - k_thickness};
    rig.body("belt_conveyor",
             {{"head", head},
              {"tail", head - 8.0 * along},
              {"radius", k_pulley},
              {"thickness", k_thickness},
              {"width", 1.0},
              {"trough_angle", belt.trough_angle},
              {"centre_roll", 0.38},
              {"transition", 1.6}},
             WallRig::motion("belt", {{"speed", belt.speed}}));
    dem = rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = position, .velocity = velocity, .diameter = 2 * k_lump}});
    stepper = std::make_unique<Stepper>(*dem);
  }
  GrainState now() { return grain(*dem, 0); }
  [[nodiscard]] double at_rest() const { return k_lump - rig.resting_overlap(); }
  /// Kinetic energy and that of place, per mass [m2/s2].
  double energy() {
    const GrainState g = now();
    return 0.5 * dot(g.velocity, g.velocity) + k_g * g.position.z;
  }
};

/// Where a lump that touches the belt over (x, y) of a troughed belt rests on it, without overlap.
Vec3 on_trough(LumpOnBelt& l, double x, double y) {
  Vec3 p{x, y, 0.6};
  for (int n = 0; n < 100; ++n) p.z -= l.rig.bodies[0].nearest(p).distance - k_lump;
  return p;
}

}  // namespace

TEST_CASE("a lump that swings in a trough shall neither gain nor lose energy at its bends") {
  // Elastic, without friction: what it has is kept, whatever part of the belt it is on. The belt
  // runs below it and must not matter.
  constexpr double k_angle = 35.0 * k_pi / 180.0;
  LumpOnBelt probe({.trough_angle = k_angle}, {}, {});
  LumpOnBelt l({.speed = 2.5, .trough_angle = k_angle}, on_trough(probe, -4.0, 0.3), {});
  const double start = l.energy();
  const double fall = k_g * (l.now().position.z - on_trough(probe, -4.0, 0.0).z);
  double farthest = 0.0;
  double largest_error = 0.0;
  int turns = 0;
  double last = 0.0;
  while (l.stepper->time() < 2.0) {
    l.stepper->step(20);
    const GrainState g = l.now();
    if (last != 0.0 && last * g.velocity.y < 0.0) {
      ++turns;
      farthest = std::max(farthest, std::abs(std::abs(g.position.y) - 0.3));
    }
    last = g.velocity.y;
    largest_error = std::max(largest_error, std::abs(l.energy() - start));
  }
  CHECK(turns >= 2);
  // The spring's own energy, at most m g times an overlap of some tenths of a millimetre, comes and
  // goes: below one per cent of the fall.
  CHECK(largest_error < 0.01 * fall);
  CHECK(farthest < 0.01);
  CHECK(l.now().position.x == approx(-4.0).epsilon(1e-9));
}

TEST_CASE("a lump shall go through transition and over the pulley without energy from the belt") {
  constexpr double k_angle = 35.0 * k_pi / 180.0;
  LumpOnBelt probe({.trough_angle = k_angle}, {}, {});
  for (const double y : {0.0, 0.22, 0.4}) {
    CAPTURE(y);
    LumpOnBelt l({.speed = 2.5, .trough_angle = k_angle}, on_trough(probe, -1.8, y), {3, 0, 0});
    const double start = l.energy();
    while (l.now().position.x < 0.3) l.stepper->step(20);
    CHECK(l.energy() == approx(start).epsilon(0.01));
  }
}

TEST_CASE("a belt in any direction in plan shall carry a lump at its speed") {
  constexpr double k_turn = 2.2;
  const Vec3 along{std::cos(k_turn), std::sin(k_turn), 0.0};
  LumpOnBelt::Belt belt{.speed = 1.2, .direction = k_turn, .friction = 0.6, .restitution = 0.5};
  belt.rolling = 1.0;
  LumpOnBelt l(belt, {}, {});
  const Vec3 start = -3.0 * along + Vec3{0, 0, l.at_rest()};
  LumpOnBelt carried(belt, start, {});
  while (carried.stepper->time() < 1.0) carried.stepper->step(20);
  const GrainState g = carried.now();
  CHECK(norm(g.velocity - belt.speed * along) < 1e-3 * belt.speed);
  // It slides up to speed: u^2 / (2 mu g) behind the belt.
  const double behind = belt.speed * belt.speed / (2 * 0.6 * k_g);
  const Vec3 gone = g.position - start;
  CHECK(dot(gone, along) == approx(belt.speed * carried.stepper->time() - behind).epsilon(0.01));
  CHECK(norm(gone - dot(gone, along) * along) < 1e-4);
}

namespace {

/// Angle [deg] from the top of the pulley at which a lump that does not turn leaves it, and its
/// speed then.
struct Discharge {
  double angle = 0.0;
  double speed = 0.0;
};
Discharge discharge(double speed, double friction,
                    double young_modulus = LumpOnBelt::Belt{}.young_modulus) {
  LumpOnBelt::Belt belt{.speed = speed, .friction = friction, .rolling = 20.0, .restitution = 0.5};
  belt.young_modulus = young_modulus;
  LumpOnBelt l(belt, {-0.01, 0, k_lump - 1e-5}, {speed, 0, 0});
  Discharge d;
  int apart = 0;
  while (l.stepper->time() < 2.0 && apart < 100) {
    l.stepper->step();
    const GrainState g = l.now();
    if (l.dem->report().contacts > 0) {
      apart = 0;
      d.angle = std::atan2(g.position.x, g.position.z + k_pulley + k_thickness) * 180.0 / k_pi;
      d.speed = norm(g.velocity);
    } else if (g.position.x > 0.0) {
      ++apart;
    }
  }
  return d;
}

/// Speed at which a lump that turns with the pulley has its centre go round.
double speed_at_centre(double speed) {
  return speed * (k_pulley + k_thickness + k_lump) / (k_pulley + k_thickness);
}

/// Booth (1934) for a block that turns with the pulley, with an adhesion of `pull` times its
/// weight: the pulley presses with N = m (g cos(a) - v^2 / r) + F. Until its centre goes round at
/// the pulley's rate friction drives it: d(v^2)/da = 2 r (g sin(a) + mu N / m). It slips once g
/// sin(a) > mu N / m, gathers speed by d(v^2)/da = 2 r (g sin(a) - mu N / m), and leaves where N =
/// 0: v^2 / (g r) = cos(a) + F / (m g).
Discharge booth(double speed, double friction, double pull = 0.0) {
  const double radius = k_pulley + k_thickness + k_lump;
  const double round = speed_at_centre(speed) * speed_at_centre(speed);
  constexpr double k_step = 1e-5;
  double square = speed * speed;
  bool slips = false;
  for (double a = 0.0;; a += k_step) {
    const double pressed = k_g * (std::cos(a) + pull) - square / radius;
    if (pressed <= 0.0) return {a * 180.0 / k_pi, std::sqrt(square)};
    if (square < round) {
      square += k_step * 2 * radius * (k_g * std::sin(a) + friction * pressed);
      square = std::min(square, round);
      continue;
    }
    const double driven = k_g * std::sin(a) - friction * pressed;
    slips = slips || driven > 0.0;
    if (slips) square = std::max(round, square + k_step * 2 * radius * driven);
  }
}

}  // namespace

TEST_CASE("a lump shall slip on the head pulley and leave it as Booth's equations say") {
  constexpr double k_degrees = 1.0;
  for (const double speed : {0.8, 1.2, 1.6}) {
    CAPTURE(speed);
    // As the pulley presses less the lump has to come out of it: stiff, that takes no time.
    const Discharge found = discharge(speed, 0.6, 2e9);
    const Discharge expected = booth(speed, 0.6);
    CHECK(std::abs(found.angle - expected.angle) < k_degrees);
    // A degree further it is 3 % faster.
    CHECK(found.speed == approx(expected.speed).epsilon(0.03));
  }
}

TEST_CASE("the stiffer a lump, the nearer to Booth's angle shall it leave the head pulley") {
  // Booth's block is rigid. A lump comes out of the pulley while that presses less and less, and
  // touches it for a while longer, the less the stiffer it is.
  for (const double speed : {0.8, 1.6}) {
    CAPTURE(speed);
    const double expected = booth(speed, 0.6).angle;
    const double soft = discharge(speed, 0.6, 200e6).angle - expected;
    const double stiff = discharge(speed, 0.6, 8e9).angle - expected;
    CHECK(stiff > 0.0);
    CHECK(stiff < 0.25);
    CHECK(stiff < 0.5 * soft);
  }
}

TEST_CASE("without slip a lump shall leave a slow belt's pulley where CEMA says") {
  for (const double speed : {0.8, 1.4}) {
    CAPTURE(speed);
    const Discharge found = discharge(speed, 20.0);
    // v^2 / (g r) = cos(a) at the radius and with the speed of the centre of mass, which turns with
    // the pulley.
    const double square = std::pow(speed_at_centre(speed), 2);
    const double expected =
        std::acos(square / (k_g * (k_pulley + k_thickness + k_lump))) * 180.0 / k_pi;
    CHECK(std::abs(found.angle - expected) < 1.0);
  }
}

namespace {

/// A lump that sticks: the bridge's force at touch is 4 pi R gamma, here `pull` times its weight.
/// Its liquid is so little that it gives way within some hundredths of a millimetre.
Discharge sticky_discharge(double speed, double friction, double pull) {
  LumpOnBelt::Belt belt{.speed = speed, .friction = friction, .rolling = 20.0, .restitution = 0.5};
  // As the pulley presses less the lump has to come out of it: stiff, that takes no time.
  belt.young_modulus = 2e9;
  const double weight = 2650 * 4.0 / 3.0 * k_pi * k_lump * k_lump * k_lump * k_g;
  if (pull > 0.0) {
    belt.cohesion = {"liquid_bridge",
                     {{"surface_tension", pull * weight / (4 * k_pi * k_lump)},
                      {"contact_angle", 0.0},
                      {"relative_volume", 1e-6}}};
  }
  LumpOnBelt l(belt, {-0.01, 0, k_lump - 1e-5}, {speed, 0, 0});
  Discharge d;
  for (int apart = 0; l.stepper->time() < 2.0 && apart < 100; ++apart) {
    l.stepper->step();
    const GrainState g = l.now();
    // A bridge that is drawn out is no touch any more.
    if (l.rig.bodies[0].nearest(g.position).distance >= k_lump && g.position.x > 0.0) continue;
    apart = 0;
    const double angle = std::atan2(g.position.x, g.position.z + k_pulley + k_thickness);
    d = {angle * 180.0 / k_pi, norm(g.velocity)};
  }
  return d;
}

}  // namespace

TEST_CASE("a lump that sticks shall leave the head pulley later, where the balance says") {
  for (const double speed : {0.8, 1.6}) {
    for (const double friction : {0.6, 200.0}) {
      double last = 0.0;
      for (const double pull : {0.0, 0.2, 0.5}) {
        CAPTURE(speed);
        CAPTURE(friction);
        CAPTURE(pull);
        const Discharge found = sticky_discharge(speed, friction, pull);
        const Discharge expected = booth(speed, friction, pull);
        CHECK(std::abs(found.angle - expected.angle) < 1.0);
        // The gap opens with the third power of the time: 0.1 um after 0.7 degrees, in which a lump
        // that no friction holds any more has become faster by 5 %.
        CHECK(found.speed == approx(expected.speed).epsilon(0.06));
        CHECK(found.angle > last + (pull > 0.0 ? 5.0 : 0.0));
        last = found.angle;
        // Without slip in closed form.
        if (friction < 1.0) continue;
        const double r = k_pulley + k_thickness + k_lump;
        const double square = std::pow(speed_at_centre(speed), 2);
        const double held = std::acos(std::min(square / (k_g * r) - pull, 1.0)) * 180.0 / k_pi;
        CHECK(std::abs(found.angle - held) < 1.0);
      }
    }
  }
}

TEST_CASE("a fast belt shall throw a lump from the tangent line along a parabola") {
  // CEMA, high speed: v^2 / (g r) above 1, here 2.4 m/s and 1.66.
  constexpr double speed = 2.4;
  for (const double y : {0.0, 0.3}) {
    LumpOnBelt l({.speed = speed, .friction = 0.6, .rolling = 1.0, .restitution = 0.5},
                 {-0.5, y, k_lump - 1e-5}, {speed, 0, 0});
    while (l.now().position.z > k_lump - 1.0) l.stepper->step(5);
    const GrainState g = l.now();
    const double fall = std::sqrt(2.0 * (k_lump - g.position.z) / k_g);
    CHECK(g.position.x == approx(speed * fall).epsilon(0.01));
    CHECK(g.position.y == approx(y).epsilon(1e-6).scale(1.0));
  }
}

TEST_CASE("a sphere that a smooth steep belt lets slide down shall ride up on a cleat") {
  constexpr double k_angle = k_pi / 6;
  constexpr double k_speed = 1.0;
  const Vec3 e{std::cos(k_angle), 0, std::sin(k_angle)};
  const Vec3 n{-std::sin(k_angle), 0, std::cos(k_angle)};
  const auto ride = [&](bool with_cleat) {
    WallRig rig(0.3, 0.0, 2 * k_lump);
    rig.setup.gravity = {0, 0, -k_g};
    rig.setup.domain.min = {-10, -10, -10};
    rig.setup.domain.max = {10, 10, 10};
    const std::map<std::string, Value> pulleys = {{"head", Vec3{5, 0, 0}}, {"tail", Vec3{}}};
    // Both are drawn level and turned up in their frame about the tail.
    const auto turn_up = [&](dust::bodies::Body& body) {
      body.frame_axis = {0, 1, 0};
      body.frame_angle = -k_angle;
    };
    auto belt = pulleys;
    belt.insert({{"radius", k_pulley}, {"thickness", k_thickness}, {"width", 1.0}});
    turn_up(rig.body("belt_conveyor", belt, WallRig::motion("belt", {{"speed", k_speed}})));
    if (with_cleat) {
      auto path = pulleys;
      path.insert({{"radius", k_pulley + 0.5 * k_thickness}, {"speed", k_speed}, {"ahead", 1.0}});
      turn_up(rig.body("box",
                       {{"min", Vec3{-0.01, -0.4, k_pulley + 0.5 * k_thickness}},
                        {"max", Vec3{0.0, 0.4, k_pulley + k_thickness + 0.08}}},
                       WallRig::motion("circulate", path)));
    }
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = (1.0 + 2 * k_lump) * e + (k_pulley + k_thickness + k_lump) * n,
         .velocity = k_speed * e,
         .diameter = 2 * k_lump}});
    Stepper stepper(*dem);
    while (stepper.time() < 1.5) stepper.step();
    return grain(*dem, 0);
  };
  // Without friction: s = s_0 + U t - g sin(a) t^2 / 2, less what the start on the belt takes.
  const double slid = 1.0 + 2 * k_lump + 1.5 * k_speed - 0.5 * k_g * std::sin(k_angle) * 2.25;
  CHECK(dot(ride(false).position, e) == approx(slid).epsilon(1e-3));
  const GrainState g = ride(true);
  CHECK(norm(g.velocity - k_speed * e) < 1e-3 * k_speed);
  // It lies in the corner: overlaps of a resting lump are some 10 um.
  CHECK(dot(g.position, e) == approx(1.0 + 1.5 * k_speed + k_lump).epsilon(1e-4));
  CHECK(dot(g.position, n) == approx(k_pulley + k_thickness + k_lump).epsilon(1e-3));
}

TEST_CASE("cleats shall carry a lump up an incline that it slides down without them") {
  constexpr double k_incline = 35.0 * k_pi / 180.0;
  constexpr double k_friction = 0.4;  // below tan(35 degrees)
  constexpr double speed = 1.0;
  const Vec3 along{std::cos(k_incline), 0.0, std::sin(k_incline)};
  const Vec3 up{-std::sin(k_incline), 0.0, std::cos(k_incline)};
  struct Case {
    double height, trough_angle;
    bool is_wave = false;
  };
  for (const auto& [height, trough_angle, is_wave] :
       {Case{0.0, 0.0}, Case{0.08, 0.0}, Case{0.08, 0.6}, Case{0.03, 0.0, true}}) {
    CAPTURE(height);
    CAPTURE(trough_angle);
    CAPTURE(is_wave);
    WallRig rig(0.3, k_friction, 2 * k_lump, 20.0);
    rig.setup.gravity = {0, 0, -k_g};
    rig.setup.domain.min = {-10, -10, -10};
    rig.setup.domain.max = {10, 10, 10};
    rig.setup.time.expected_speed = 5.0;
    std::map<std::string, Value> belt{{"head", Vec3{}},
                                      {"tail", -8.0 * along},
                                      {"radius", k_pulley},
                                      {"thickness", k_thickness},
                                      {"width", 1.0},
                                      {"cleat_height", height},
                                      {"trough_angle", trough_angle}};
    if (is_wave) {
      belt.insert({{"cleat_profile", std::string("round")},
                   {"cleat_thickness", 0.1},
                   {"cleat_spacing", 0.1}});
    } else if (height > 0.0) {
      belt.insert({{"cleat_thickness", 0.03}, {"cleat_spacing", 0.5}});
    }
    rig.body("belt_conveyor", belt, WallRig::motion("belt", {{"speed", speed}}));
    const auto dem = rig.make();
    const double over = k_pulley + k_thickness + k_lump + (is_wave ? height : 0.0);
    const Vec3 start = -4.2 * along + over * up;
    dem->insert(std::vector<NewGrain>{{.position = start, .velocity = {}, .diameter = 2 * k_lump}});
    Stepper stepper(*dem);
    while (stepper.time() < 1.0) stepper.step(20);
    const GrainState before = grain(*dem, 0);
    if (height == 0.0) {
      // Friction drives it up, its weight down: g (sin - mu cos), as long as it slips.
      const double pull = k_g * (std::sin(k_incline) - k_friction * std::cos(k_incline));
      CHECK(dot(before.velocity, along) == approx(-pull).epsilon(0.01));
      continue;
    }
    while (stepper.time() < 3.0) stepper.step(20);
    const GrainState after = grain(*dem, 0);
    const double gone = dot(after.position - before.position, along);
    // It lies in the corner of belt and cleat, or in a valley: as fast as the belt.
    CHECK(gone == approx(2.0 * speed).epsilon(1e-3));
    CHECK(norm(after.velocity - speed * along) < 2e-3 * speed);
    CHECK(norm(after.position - before.position - gone * along) < 1e-4);
  }
}

namespace {

constexpr double k_even_speed = 1.0;  // [m/s] of the level belt below

/// Elastic, without friction: seen from the belt, nothing does work on a lump on it. `more` are
/// keys of its trough and cleats.
struct EvenBelt : WallRig {
  explicit EvenBelt(const std::map<std::string, Value>& more) : WallRig(1.0, 0.0, 2 * k_lump) {
    setup.gravity = {0, 0, -k_g};
    setup.domain.min = {-10, -10, -10};
    setup.domain.max = {10, 10, 10};
    setup.time.expected_speed = 5.0;
    std::map<std::string, Value> belt{{"head", Vec3{0, 0, -k_pulley - k_thickness}},
                                      {"tail", Vec3{-8, 0, -k_pulley - k_thickness}},
                                      {"radius", k_pulley},
                                      {"thickness", k_thickness},
                                      {"width", 1.0}};
    belt.insert(more.begin(), more.end());
    body("belt_conveyor", belt, motion("belt", {{"speed", k_even_speed}}));
  }
  /// [J/kg] of a lump as the belt sees it.
  static double energy(const GrainState& lump) {
    const Vec3 v = lump.velocity - Vec3{k_even_speed, 0, 0};
    return 0.5 * dot(v, v) + k_g * lump.position.z;
  }
};

}  // namespace

TEST_CASE("a lump between the cleats of a trough shall keep its energy as the belt has it") {
  // It swings across the bends and rebounds from cleat to cleat.
  EvenBelt rig({{"trough_angle", 0.6},
                {"cleat_height", 0.15},
                {"cleat_thickness", 0.03},
                {"cleat_spacing", 0.5}});
  Vec3 start{-5.2, 0.3, 0.6};
  for (int n = 0; n < 100; ++n) {
    start.z -= rig.bodies[0].contact(0, start, 1.0, rig.bodies[0].placement(0.0)).distance - k_lump;
  }
  const auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{
      {.position = start, .velocity = {k_even_speed + 0.8, 0, 0}, .diameter = 2 * k_lump}});
  Stepper stepper(*dem);
  const auto energy = [&] { return EvenBelt::energy(grain(*dem, 0)); };
  const double fall = k_g * (start.z - k_lump);
  REQUIRE(fall > 0.3);
  const double first = energy();
  int rebounds = 0;
  double last = 0.8;
  double largest_error = 0.0;
  while (stepper.time() < 2.0) {
    stepper.step(5);
    const double ahead = grain(*dem, 0).velocity.x - k_even_speed;
    if (std::abs(ahead) < 0.799) continue;  // a rebound is on: the spring has a part of it
    if (last * ahead < 0.0) ++rebounds;
    last = ahead;
    largest_error = std::max(largest_error, std::abs(energy() - first));
  }
  CHECK(rebounds >= 3);
  CHECK(largest_error < 0.01 * fall);
}

TEST_CASE("a lump on a belt of waves shall keep its energy as the belt has it") {
  // It bounces off crests and in valleys, where it touches two waves.
  constexpr double k_fall = 0.1;
  int in_valleys = 0;
  // On a flank, and over the middle of a valley.
  for (const bool is_over_valley : {false, true}) {
    CAPTURE(is_over_valley);
    EvenBelt rig({{"cleat_profile", std::string("round")},
                  {"cleat_height", 0.03},
                  {"cleat_thickness", 0.1},
                  {"cleat_spacing", 0.1}});
    Vec3 start{-5.0, 0, 0.03 + k_lump + k_fall};
    const auto nearer_to_one = [&](double x) {
      const auto at = rig.bodies[0].placement(0.0);
      const auto to = [&](int row) { return rig.bodies[0].contact(row, {x, 0, start.z}, 1.0, at); };
      return to(1).distance - to(2).distance;
    };
    while (is_over_valley && nearer_to_one(start.x) * nearer_to_one(start.x + 1e-4) > 0.0) {
      start.x += 1e-4;
    }
    const auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = start, .velocity = {k_even_speed, 0, 0}, .diameter = 2 * k_lump}});
    Stepper stepper(*dem);
    const auto energy = [&] { return EvenBelt::energy(grain(*dem, 0)); };
    const double first = energy();
    int bounces = 0;
    bool was_apart = true;
    while (stepper.time() < 2.0) {
      stepper.step();
      const Vec3 place = grain(*dem, 0).position;
      const auto at = rig.bodies[0].placement(stepper.time());
      const bool is_apart = rig.bodies[0].nearest(place, at).distance > k_lump + 1e-6;
      if (is_apart) CHECK(std::abs(energy() - first) < 0.01 * k_g * k_fall);
      if (was_apart && !is_apart) ++bounces;
      was_apart = is_apart;
      if (is_apart) continue;
      const double one = rig.bodies[0].contact(1, place, 1.0, at).distance;
      const double other = rig.bodies[0].contact(2, place, 1.0, at).distance;
      if (std::max(one, other) < k_lump) ++in_valleys;
    }
    CHECK(bounces >= 3);
  }
  CHECK(in_valleys > 10);
}
