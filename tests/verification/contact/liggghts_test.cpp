// SPDX-License-Identifier: Apache-2.0
// The conventions of LIGGGHTS as options of laws: closed forms of each, and where they differ.
#include "contact/hertz_mindlin/liggghts.hpp"
#include "rolling/cdt/cdt.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;
namespace law = dust::model::hertz_mindlin;

namespace {

constexpr double k_friction = 0.4;
constexpr double k_restitution = 0.5;
constexpr double k_overlap = 1e-6;
constexpr double k_radius = 1e-3;
constexpr double k_mass = 1e-5;

law::Constants constants() {
  law::Constants k;
  k.young = 5e7;
  k.shear = 1e7;
  k.normal_root = std::sqrt(2.0 * k.young);
  k.tangential_root = std::sqrt(8.0 * k.shear);
  k.damping = law::damping(k_restitution);
  k.friction = k_friction;
  return k;
}

/// A contact along z that has touched for a while.
law::Contact contact() {
  law::Contact c{};
  c.overlap = k_overlap;
  c.nz = 1.0;
  c.radius = k_radius;
  c.mass = k_mass;
  return c;
}

double contact_radius() { return std::sqrt(k_radius * k_overlap); }
double normal_stiffness() { return 4.0 / 3.0 * constants().young * contact_radius(); }
double tangential_stiffness() { return 8.0 * constants().shear * contact_radius(); }

/// \f$ -2 \beta \sqrt{5/6} \sqrt{S m^*} \f$ [N s/m]
double damper(double stiffness) {
  const double l = std::log(k_restitution);
  const double beta = l / std::sqrt(l * l + std::numbers::pi * std::numbers::pi);
  return -2.0 * beta * std::sqrt(5.0 / 6.0) * std::sqrt(stiffness * k_mass);
}

}  // namespace

TEST_CASE(
    "by LIGGGHTS' convention a contact that holds shall have its whole damper, past the limit") {
  law::Contact c = contact();
  c.sx = 1e-8;
  c.ux = 2e-8;
  c.vx = 0.5;
  law::evaluate_liggghts(constants(), c);
  const double expected = -tangential_stiffness() * 3e-8 - damper(tangential_stiffness()) * 0.5;
  CHECK(c.fx == approx(expected).epsilon(1e-12));
  CHECK(c.sx == approx(3e-8).epsilon(1e-12));
  const double normal = normal_stiffness() * k_overlap;
  CHECK(c.fz == approx(normal).epsilon(1e-12));
  // Strict Coulomb would have stopped it here.
  CHECK(std::abs(c.fx) > 2.0 * k_friction * normal);
}

TEST_CASE("by LIGGGHTS' convention a contact that slides shall have the limit and no damper") {
  law::Contact c = contact();
  c.sx = 3e-5;
  c.sy = 4e-5;
  c.vx = 0.1;
  c.vz = -0.02;
  law::evaluate_liggghts(constants(), c);
  const double normal =
      normal_stiffness() * k_overlap + damper(2.0 * constants().young * contact_radius()) * 0.02;
  CHECK(c.normal_force == approx(normal).epsilon(1e-12));
  CHECK(c.fx == approx(-0.6 * k_friction * normal).epsilon(1e-12));
  CHECK(c.fy == approx(-0.8 * k_friction * normal).epsilon(1e-12));
  CHECK(std::hypot(c.sx, c.sy) ==
        approx(k_friction * normal / tangential_stiffness()).epsilon(1e-12));
}

TEST_CASE("by LIGGGHTS' convention an attracting normal force shall hold like a repelling one") {
  law::Contact c = contact();
  c.sx = 1e-3;
  c.vz = 5.0;
  law::evaluate_liggghts(constants(), c);
  REQUIRE(c.normal_force < 0.0);
  CHECK(c.fx == approx(k_friction * c.normal_force).epsilon(1e-12));
}

TEST_CASE(
    "by LIGGGHTS' convention a spring shall be shortened by a turn and keep its length else") {
  law::Contact c = contact();
  constexpr double k_turn = 0.3;
  c.nx = std::sin(k_turn);
  c.nz = std::cos(k_turn);
  c.sx = 1e-8;
  law::evaluate_liggghts(constants(), c);
  const double length = std::sqrt(c.sx * c.sx + c.sy * c.sy + c.sz * c.sz);
  CHECK(length == approx(1e-8 * std::cos(k_turn)).epsilon(1e-12));
  // A quarter of the overlap, half the force: the displacement stays.
  law::Contact before = contact();
  before.sx = 1e-9;
  law::evaluate_liggghts(constants(), before);
  law::Contact after = contact();
  after.sx = before.sx;
  after.overlap = 0.25 * k_overlap;
  law::evaluate_liggghts(constants(), after);
  CHECK(after.fx == approx(0.5 * before.fx).epsilon(1e-12));
}

namespace {

/// Chung and Ooi's test 6: a sphere that spins meets a plane along x.
GrainState spinning_impact(const char* tangential, double spin) {
  constexpr double k_size = 0.1;
  DemRig rig;
  const int alloy = rig.material(2700, 70e9, 0.33);
  const int wall = rig.material(2700, 1e30, 0.33);
  rig.laws_of(alloy, wall,
              {"hertz_mindlin",
               {{"restitution", 0.5}, {"friction", 0.4}, {"tangential", std::string(tangential)}}});
  rig.laws_of(alloy, alloy, {"hertz_mindlin", {{"restitution", 0.5}, {"friction", 0.4}}});
  rig.diameters = {2 * k_size};
  rig.setup.domain.min = {0, -5, -5};
  rig.setup.domain.max = {5, 5, 5};
  rig.wall(0, wall);
  rig.setup.time.dem_step = 5e-7;
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.position = {k_size + 1e-7, 0, 0},
                                     .velocity = {-0.2, 0, 0},
                                     .rotation = {0, 0, spin},
                                     .diameter = 2 * k_size}});
  Stepper stepper(*dem);
  stepper.step(10);
  REQUIRE(dem->report().contacts > 0);
  while (dem->report().contacts > 0) stepper.step();
  stepper.step(3);
  return grain(*dem, 0);
}

}  // namespace

TEST_CASE("a spinning sphere shall rebound as LIGGGHTS' damper beyond the limit says") {
  struct Row {
    double spin, v_t, spin_out;
  };
  // An integration of the same convention that is none of ours: damper not capped, |F_n|.
  for (const Row r :
       {Row{0.5, -0.013870, 0.15324}, Row{2.0, -0.058331, 0.54173}, Row{4.0, -0.118516, 1.03711},
        Row{8.0, -0.140695, 4.48262}, Row{21.0, -0.140547, 17.48631}}) {
    CAPTURE(r.spin);
    const GrainState out = spinning_impact("liggghts", r.spin);
    MESSAGE(r.spin << " rad/s: " << out.velocity.y << " m/s, " << out.rotation.z << " rad/s");
    CHECK(-std::abs(out.velocity.y) == approx(r.v_t).epsilon(0.02));
    CHECK(std::abs(out.rotation.z - r.spin_out) < 0.02 * 3.5);
    CHECK(out.velocity.x == approx(0.1).epsilon(0.01));
  }
  // Strict Coulomb is another law: the comparison can fail.
  CHECK(std::abs(spinning_impact("rescaled", 8.0).velocity.y) < 0.127);
}

namespace {

/// A sphere on the floor, without friction, that rolls about x and turns about the vertical.
GrainState spun_down(const char* kind, double rolling, double about_normal, double time) {
  constexpr double k_size = 3e-4;
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.laws_of(sand, sand, {"hertz_mindlin", {{"restitution", 0.5}, {"friction", 0.0}}},
              {"cdt", {{"friction", 0.3}, {"twist", std::string(kind)}}});
  rig.diameters = {2 * k_size};
  rig.setup.domain.min = {-2, -2, 0};
  rig.setup.domain.max = {2, 2, 2};
  rig.setup.gravity = {0, 0, -9.81};
  rig.setup.time.dem_step = 4e-6;
  rig.wall(4, sand);
  auto dem = rig.make();
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(k_size, 3);
  const double young = 50e6 / (1 - 0.09) / 2;
  const double overlap =
      std::pow(2650 * volume * 9.81 / (4.0 / 3.0 * young * std::sqrt(k_size)), 2.0 / 3.0);
  dem->insert(std::vector<NewGrain>{{.position = {0, 0, k_size - overlap},
                                     .velocity = {0, 0, 0},
                                     .rotation = {rolling, 0, about_normal},
                                     .diameter = 2 * k_size}});
  Stepper stepper(*dem);
  while (stepper.time() < time) stepper.step();
  return grain(*dem, 0);
}

}  // namespace

TEST_CASE(
    "a twist shall make cdt's couple smaller by its sine with twist: liggghts, and only then") {
  // I dw/dt = -mu_r R N sin(alpha), sin(alpha) = w / sqrt(w^2 + c^2), c the twist, which stays:
  // sqrt(w^2 + c^2) - c asinh(c / w) falls at the constant rate 5/2 mu_r g / R.
  constexpr double k_rolling = 1500.0;
  constexpr double k_about_normal = 2000.0;
  constexpr double k_time = 0.04;
  constexpr double k_rate = 2.5 * 0.3 * 9.81 / 3e-4;
  const auto level = [](double w) {
    return std::sqrt(w * w + k_about_normal * k_about_normal) -
           k_about_normal * std::asinh(k_about_normal / w);
  };
  const GrainState slow = spun_down("liggghts", k_rolling, k_about_normal, k_time);
  CHECK(slow.rotation.z == approx(k_about_normal).epsilon(1e-6));
  CHECK(level(k_rolling) - level(slow.rotation.x) == approx(k_rate * k_time).epsilon(0.005));
  const GrainState fast = spun_down("apart", k_rolling, k_about_normal, k_time);
  CHECK(k_rolling - fast.rotation.x == approx(k_rate * k_time).epsilon(0.005));
  CHECK(fast.rotation.x < slow.rotation.x - 100.0);
  // Without a twist both are one.
  CHECK(spun_down("liggghts", k_rolling, 0.0, k_time).rotation.x ==
        spun_down("apart", k_rolling, 0.0, k_time).rotation.x);
}
