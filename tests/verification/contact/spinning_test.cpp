// SPDX-License-Identifier: Apache-2.0
// Spinning impacts: Chung and Ooi, Granular Matter 13 (2011) 643, tests 6 to 8, strict Coulomb.
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "verification/contact/densest_packing.hpp"
#include "verification/contact/scalar_model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_radius = 0.1;
constexpr double k_speed = 0.2;

struct Material {
  double young, poisson, density;
};
constexpr Material k_aluminium{70e9, 0.33, 2700};
constexpr Material k_nylon{2.5e9, 0.4, 1000};

/// Spheres along x with spins about z, after their collision. One grain: on a plane at x = 0.
std::vector<GrainState> collide(const Material& m, std::vector<NewGrain> grains, bool on_plane) {
  DemRig rig;
  const int material = rig.material(m.density, m.young, m.poisson);
  const int wall = rig.material(m.density, 1e30, m.poisson);
  rig.law(material, material, 0.5, 0.4);
  rig.law(material, wall, 0.5, 0.4);
  double largest = 0.0;
  for (const NewGrain& g : grains) largest = std::max(largest, g.diameter);
  rig.diameters = {largest};
  rig.setup.domain.min = {on_plane ? 0.0 : -5.0, -5, -5};
  rig.setup.domain.max = {5, 5, 5};
  if (on_plane) rig.wall(0, wall);
  rig.setup.time.dem_step = m.young > 1e10 ? 1e-6 : 3e-6;
  auto dem = rig.make();
  dem->insert(grains);
  Stepper stepper(*dem);
  bool has_touched = false;
  for (int n = 0; n < 40000; ++n) {
    stepper.step();
    const bool is_touching = dem->report().contacts > 0;
    if (has_touched && !is_touching) break;
    has_touched = has_touched || is_touching;
  }
  REQUIRE(has_touched);
  stepper.step(3);
  std::vector<GrainState> out;
  for (std::size_t n = 0; n < grains.size(); ++n)
    out.push_back(grain(*dem, static_cast<std::int64_t>(n)));
  return out;
}

NewGrain sphere(double x, double vx, double spin, double radius = k_radius) {
  return {.position = {x, 0, 0},
          .velocity = {vx, 0, 0},
          .rotation = {0, 0, spin},
          .diameter = 2 * radius};
}

}  // namespace

TEST_CASE("a spinning sphere shall rebound from a plane as strict Coulomb friction says") {
  // From 4 rad/s on the contact slides throughout and the answer is one: 2 % of the catalogue.
  // Below, it sticks while the damper takes its share of the limit, and the outcome depends on how
  // a law sets its spring back when the limit bites: at 2 rad/s total and rescaled springs, set
  // back to what the damper leaves, to the limit, or held, give -0.0626 to -0.0698 m/s, all within
  // strict Coulomb. So the catalogue is met there within 2.5 % of the full sliding impulse, and the
  // law's own equations, as scalars in finer steps, within 0.5 %.
  constexpr double k_sliding = 0.02;
  constexpr double k_sticking = 0.025;
  constexpr double k_own = 0.005;
  struct Row {
    Material m;
    double spin, v_t, spin_out;
  };
  const Row rows[] = {
      {k_aluminium, 0.175, -0.004583, 0.06043}, {k_aluminium, 1.0, -0.026868, 0.32831},
      {k_aluminium, 2.0, -0.065034, 0.37415},   {k_aluminium, 3.0, -0.098712, 0.53221},
      {k_aluminium, 4.0, -0.124023, 0.89944},   {k_aluminium, 10.0, -0.124023, 6.89944},
      {k_nylon, 2.0, -0.066495, 0.33763},       {k_nylon, 4.0, -0.124023, 0.89944},
      {k_nylon, 6.0, -0.124023, 2.89944},       {k_nylon, 21.0, -0.124023, 17.89944},
  };
  for (const Row& r : rows) {
    const auto out = collide(r.m, {sphere(k_radius + 1e-7, -k_speed, r.spin)}, true);
    CAPTURE(r.spin);
    const double shear = r.m.young / (2.0 * (1.0 + r.m.poisson));
    const ScalarResult own = impact({.effective_young = r.m.young / (1 - r.m.poisson * r.m.poisson),
                                     .effective_shear = shear / (2.0 - r.m.poisson),
                                     .density = r.m.density,
                                     .radius = k_radius,
                                     .speed = k_speed,
                                     .spin = r.spin,
                                     .restitution = 0.5,
                                     .friction = 0.4},
                                    SpringForm::rescaled);
    CHECK(std::abs(std::abs(out[0].velocity.y) - std::abs(own.tangential)) < k_own * 0.124);
    CHECK(std::abs(out[0].rotation.z - own.surface / k_radius) < k_own * 3.1006);
    if (r.spin >= 4.0) {
      CHECK(-std::abs(out[0].velocity.y) == approx(r.v_t).epsilon(k_sliding));
      CHECK(std::abs(r.spin - out[0].rotation.z - 3.1006) < k_sliding * 3.1006);
    } else {
      CHECK(std::abs(std::abs(out[0].velocity.y) + r.v_t) < k_sticking * 0.124);
      CHECK(std::abs(out[0].rotation.z - r.spin_out) < k_sticking * 3.1006);
    }
    CHECK(out[0].velocity.x == approx(0.5 * k_speed).epsilon(0.01));
  }
}

TEST_CASE("two equal spheres spinning alike shall each repeat the impact on a rigid plane") {
  // Equal spheres spinning the same way: the contact point stands still by symmetry.
  const auto plane = collide(k_aluminium, {sphere(k_radius + 1e-7, -k_speed, 5.0)}, true);
  const auto pair = collide(
      k_aluminium, {sphere(k_radius + 1e-7, -k_speed, 5.0), sphere(-k_radius - 1e-7, k_speed, 5.0)},
      false);
  for (const GrainState& g : pair) {
    // The pair is twice as soft (two elastic bodies): same impulses, another duration.
    CHECK(std::abs(g.velocity.y) == approx(std::abs(plane[0].velocity.y)).epsilon(0.002));
    CHECK(g.rotation.z == approx(plane[0].rotation.z).epsilon(0.002));
  }
}

TEST_CASE("two equal spheres spinning against each other shall keep their spins") {
  const auto pair = collide(
      k_aluminium,
      {sphere(k_radius + 1e-7, -k_speed, 5.0), sphere(-k_radius - 1e-7, k_speed, -5.0)}, false);
  CHECK(pair[0].rotation.z == approx(5.0).epsilon(1e-10));
  CHECK(pair[1].rotation.z == approx(-5.0).epsilon(1e-10));
}

TEST_CASE("unequal spheres shall keep momentum and slide with the impulse ratio mu") {
  const std::vector<NewGrain> in{sphere(k_radius + 1e-7, -k_speed, 20.0),
                                 sphere(-0.5 - 1e-7, k_speed, 20.0, 0.5)};
  const auto out = collide(k_aluminium, in, false);
  Vec3 before;
  Vec3 after;
  double scale = 0.0;
  for (std::size_t n = 0; n < 2; ++n) {
    before += out[n].mass * in[n].velocity;
    after += out[n].mass * out[n].velocity;
    scale += out[n].mass * norm(in[n].velocity);
  }
  CHECK(norm(after - before) < 1e-12 * scale);
  // Strict Coulomb takes the pushing part of the normal impulse: 1.5503 of (1 + e) = 1.5.
  const double normal = out[0].mass * (out[0].velocity.x + k_speed);
  const double tangential = out[0].mass * std::abs(out[0].velocity.y);
  CHECK(tangential / (normal * 1.5503 / 1.5) == approx(0.4).epsilon(0.01));
}

TEST_CASE("the densest packing shall stop spinning at the default step") {
  // All spin the same way: each contact slips twice as fast as one grain's own spin makes it, and
  // twelve dampers act on each grain. Friction holds: the overlaps are those of a deep bed.
  constexpr double diameter = 0.01;
  const DemRig::Choice laws[] = {
      {"hertz_mindlin", {{"restitution", 0.5}, {"friction", 0.5}}},
      {"hertz_mindlin", {{"restitution", 0.3}, {"friction", 0.5}}},
      {"hertz_mindlin", {{"restitution", 0.2}, {"friction", 0.5}}},
      {"hertz_mindlin", {{"restitution", 0.1}, {"friction", 0.5}}},
      {"hertz_mindlin", {{"restitution", 0.01}, {"friction", 0.5}}},
      {"hooke", {{"normal_stiffness", 1e4}, {"restitution", 0.1}, {"friction", 0.5}}},
  };
  for (const DemRig::Choice& law : laws) {
    DemRig rig;
    const int m = rig.material(2650, 20e6, 0.3);
    rig.laws_of(m, m, law);
    std::vector<NewGrain> grains = densest_packing(rig, diameter, 0.995);
    for (std::size_t n = 0; n < grains.size(); ++n) {
      const auto k = static_cast<int>(n);
      grains[n].velocity = 1e-6 * Vec3{1.0 * (k % 7), 1.0 * (k % 5), 1.0 * (k % 3)};
      grains[n].rotation = {1e-4, 2e-4, -1e-4};
    }
    auto dem = rig.make();
    dem->insert(grains);
    Stepper stepper(*dem);
    while (stepper.time() < 0.1) stepper.step();
    Vec3 drift;
    for (std::int64_t id = 0; id < 256; ++id) drift += grain(*dem, id).velocity / 256.0;
    double fastest = 0.0;
    double spin = 0.0;
    for (std::int64_t id = 0; id < 256; ++id) {
      fastest = std::max(fastest, norm(grain(*dem, id).velocity - drift));
      spin = std::max(spin, norm(grain(*dem, id).rotation));
    }
    CAPTURE(law.name);
    CAPTURE(dem->coarse_step());
    CHECK(fastest < 1e-10);  // of 6e-6 m/s
    CHECK(spin < 1e-8);      // of 2e-4 rad/s
  }
}
