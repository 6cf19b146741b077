// SPDX-License-Identifier: Apache-2.0
// Single contacts against closed forms: Chung and Ooi, Granular Matter 13 (2011) 643,
// doi:10.1007/s10035-011-0277-0, tests 1 to 5.
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "verification/contact/scalar_model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

struct Impact {
  double largest_force = 0.0;
  double largest_overlap = 0.0;
  double duration = 0.0;
  GrainState out;
};

/// Two equal spheres head on along x, or one sphere on a plane at x = 0.
struct ImpactCase {
  double young, poisson, radius, density, speed;  ///< speed of each sphere
  bool on_plane = false;
  double restitution = 1.0, friction = 0.0;
  double tangential = 0.0, spin = 0.0;  ///< velocity along y, spin about z
  double wall_young = 1e30;
  double steps_per_contact = 400.0;
};

Impact run(const ImpactCase& c) {
  DemRig rig;
  const int grain_material = rig.material(c.density, c.young, c.poisson);
  const int wall = rig.material(c.density, c.wall_young, c.poisson);
  rig.law(grain_material, grain_material, c.restitution, c.friction);
  rig.law(grain_material, wall, c.restitution, c.friction);
  rig.diameters = {2.0 * c.radius};
  const double relative = c.on_plane ? c.speed : 2.0 * c.speed;
  const double mass = c.density * 4.0 / 3.0 * std::numbers::pi * std::pow(c.radius, 3);
  const double hertz = c.on_plane
                           ? rig.laws[1].contact->collision_time(c.radius, mass, relative)
                           : rig.laws[0].contact->collision_time(c.radius / 2, mass / 2, relative);
  rig.setup.time.dem_step = hertz / c.steps_per_contact;
  rig.setup.time.expected_speed = relative;
  if (c.on_plane) {
    rig.setup.domain.min.x = 0.0;
    rig.wall(0, wall);
  }
  auto dem = rig.make();
  const double gap = 1.5 * c.speed * rig.setup.time.dem_step;
  using dust::particles::NewGrain;
  std::vector<NewGrain> grains;
  const double x = c.radius + gap;
  grains.push_back({.position = {x, 0, 0},
                    .velocity = {-c.speed, c.tangential, 0},
                    .rotation = {0, 0, c.spin},
                    .diameter = 2 * c.radius,
                    .material = grain_material});
  if (!c.on_plane) {
    grains.push_back({.position = {-x, 0, 0},
                      .velocity = {c.speed, -c.tangential, 0},
                      .rotation = {0, 0, c.spin},
                      .diameter = 2 * c.radius,
                      .material = grain_material});
  }
  dem->insert(grains);
  Stepper stepper(*dem);
  Impact out;
  double touch = -1.0;
  double before = 0.0;
  for (int n = 0; n < 4.0 * c.steps_per_contact; ++n) {
    const double at = grain(*dem, 0).position.x;
    const double overlap = c.radius - at;
    if (overlap > 0.0 && touch < 0.0) {
      touch = stepper.time() - rig.setup.time.dem_step * overlap / (overlap - before);
    }
    if (overlap < 0.0 && touch >= 0.0) {
      out.duration =
          stepper.time() - rig.setup.time.dem_step * overlap / (overlap - before) - touch;
      break;
    }
    stepper.step();
    out.largest_overlap = std::max(out.largest_overlap, c.on_plane ? overlap : 2.0 * overlap);
    out.largest_force = std::max(out.largest_force, std::abs(dem->last_force()[0]));
    before = overlap;
  }
  REQUIRE(out.duration > 0.0);
  stepper.step(4);
  out.out = grain(*dem, 0);
  return out;
}

}  // namespace

TEST_CASE("elastic impacts shall follow the Hertz closed form") {
  // CO1, CO2; force and overlap within 0.5 %, duration within 1 % at a 400th of the contact.
  constexpr double k_force = 0.005;
  constexpr double k_time = 0.01;
  struct Row {
    ImpactCase c;
    double overlap, force, duration;
  };
  const Row rows[] = {
      {{48e9, 0.20, 0.01, 2800, 10.0}, 274.11e-6, 10697.0, 40.34e-6},
      {{20e9, 0.25, 0.01, 2500, 10.0}, 368.30e-6, 7108.2, 54.20e-6},
      {{70e9, 0.30, 0.1, 2699, 0.2, true}, 49.717e-6, 11369.9, 731.66e-6},
      {{40e9, 0.35, 0.1, 1800, 0.2, true}, 52.123e-6, 7232.7, 767.07e-6},
  };
  for (const Row& r : rows) {
    const Impact i = run(r.c);
    CHECK(i.largest_overlap == approx(r.overlap).epsilon(k_force));
    CHECK(i.largest_force == approx(r.force).epsilon(k_force));
    CHECK(i.duration == approx(r.duration).epsilon(k_time));
    CHECK(i.out.velocity.x == approx(r.c.speed).epsilon(1e-3));
  }
}

TEST_CASE("the declared restitution shall be the realised one") {
  constexpr double k_realised = 0.005;
  for (const double e : {0.2, 0.4, 0.6, 0.8, 0.9, 1.0}) {
    for (const bool iron : {false, true}) {
      ImpactCase c{
          iron ? 100e9 : 380e9, iron ? 0.25 : 0.23, 0.0025, iron ? 7000.0 : 4000.0, 3.9, true};
      c.restitution = e;
      const Impact i = run(c);
      CHECK(std::abs(i.out.velocity.x / 3.9 - e) < k_realised);
    }
  }
}

TEST_CASE("a sliding oblique impact shall lose mu (1 + e) of the normal momentum") {
  // CO4, sliding branch: e_t = 1 - mu (1 + e) / tan(theta), omega = 2.5 mu (1 + e) V cos / R.
  constexpr double k_tolerance = 0.01;
  for (const double degrees : {40.0, 55.0, 70.0}) {
    const double a = degrees * std::numbers::pi / 180.0;
    ImpactCase c{380e9, 0.23, 0.0025, 4000, 3.9 * std::cos(a), true};
    c.restitution = 0.98;
    c.friction = 0.092;
    c.tangential = 3.9 * std::sin(a);
    const Impact i = run(c);
    CHECK(i.out.velocity.y / c.tangential ==
          approx(1.0 - 0.092 * 1.98 / std::tan(a)).epsilon(k_tolerance));
    CHECK(std::abs(i.out.rotation.z) ==
          approx(2.5 * 0.092 * 1.98 * 3.9 * std::cos(a) / 0.0025).epsilon(k_tolerance));
  }
}

namespace {

// CO5: R 10 um, 5 m/s, mu 0.3, on a plane of the same material, elastic.
constexpr double k_fifth_friction = 0.3;
constexpr double k_fifth_speed = 5.0;
constexpr double k_unit = k_fifth_friction * k_fifth_speed;
struct FifthRow {
  double v_t, slip, surface;  ///< slip and R omega over mu v_n, of the catalogue
};
struct Fifth {
  double young, poisson, density;
  std::vector<FifthRow> rows;
};
const Fifth k_steel{208e9,
                    0.3,
                    7850,
                    {{0.1, 0.06365, -0.00215},
                     {0.5, 0.31783, -0.01107},
                     {1.0, 0.62550, -0.02941},
                     {1.5, 0.66684, -0.23797},
                     {2.0, 0.36655, -0.69056},
                     {3.0, -0.27626, -1.62590},
                     {5.0, -1.17047, -3.21700},
                     {8.0, -1.35135, -4.77477},
                     {10.0, -0.33333, -5.0},
                     {12.0, 1.0, -5.0},
                     {20.0, 6.33333, -5.0}}};
const Fifth k_polyethylene{1e9,
                           0.4,
                           1400,
                           {{0.1, 0.05361, -0.00932},
                            {0.5, 0.26266, -0.05048},
                            {1.0, 0.47338, -0.13806},
                            {1.5, 0.47665, -0.37382},
                            {2.0, 0.17510, -0.82731},
                            {3.0, -0.46492, -1.76066},
                            {5.0, -1.32916, -3.33035},
                            {8.0, -1.41334, -4.81905},
                            {10.0, -0.33333, -5.0},
                            {12.0, 1.0, -5.0},
                            {20.0, 6.33333, -5.0}}};

ScalarCase scalar(const Fifth& m, double v_t) {
  return {.effective_young = m.young / (1 - m.poisson * m.poisson) / 2,
          .effective_shear = m.young / (2 * (1 + m.poisson)) / (2 - m.poisson) / 2,
          .density = m.density,
          .radius = 1e-5,
          .speed = k_fifth_speed,
          .tangential = v_t,
          .friction = k_fifth_friction};
}

}  // namespace

TEST_CASE("elastic oblique impacts shall follow the law's own equations and create no energy") {
  // The law keeps xi sqrt(k_t), so no published table of the micro-slip range fits it: the
  // reference is the law once more as scalars, in steps fifty times finer.
  constexpr double k_tolerance =
      0.01;  // some 1000 steps per contact; first order where slip begins
  for (const Fifth& m : {k_steel, k_polyethylene}) {
    for (const FifthRow& r : m.rows) {
      ImpactCase c{m.young, m.poisson, 1e-5, m.density, k_fifth_speed, true};
      c.wall_young = m.young;
      c.friction = k_fifth_friction;
      c.tangential = r.v_t;
      c.steps_per_contact = 1000;
      const Impact i = run(c);
      // Sphere above a plane with normal +x: the contact point moves with v_y - R omega_z.
      const double spin = -c.radius * i.out.rotation.z;
      const double slip = i.out.velocity.y + spin;
      const ScalarResult expected = impact(scalar(m, r.v_t), SpringForm::rescaled);
      CAPTURE(r.v_t);
      CHECK(std::abs(spin - expected.surface) < k_tolerance * k_unit);
      CHECK(std::abs(slip - expected.slip()) < k_tolerance * k_unit);
      const double energy = norm(i.out.velocity) * norm(i.out.velocity) + 0.4 * spin * spin;
      CHECK(energy < (25.0 + r.v_t * r.v_t) * (1.0 + 1e-4));
      // Sliding throughout, all forms agree with psi2 = psi1 - 7 and R omega = -5 mu v_n. The soft
      // sphere is 6 % flatter at its deepest, which shortens the lever of its friction: hard one.
      if (r.v_t >= 10.0 && m.young > 1e10) {
        CHECK(std::abs(slip / k_unit - r.slip) < 0.02);  // of 7 that it has lost
        CHECK(spin / k_unit == approx(r.surface).epsilon(0.01));
      }
    }
  }
}

TEST_CASE("the catalogue's micro-slip table shall be that of the total spring") {
  // Why the engine cannot meet it within 2 %: with the total spring F = k_t(d) xi and the contact
  // point at the full radius the scalar model gives the whole table to its digits. The engine's
  // spring keeps its energy as the stiffness changes; while a contact sticks the two differ, by up
  // to a fortieth of full sliding, which is 5 mu v_n.
  constexpr double k_table = 0.002;  // the table's own steps and digits
  constexpr double k_apart = 0.125;
  double farthest = 0.0;
  for (const Fifth& m : {k_steel, k_polyethylene}) {
    for (const FifthRow& r : m.rows) {
      const ScalarResult total = impact(scalar(m, r.v_t), SpringForm::total);
      const ScalarResult rescaled = impact(scalar(m, r.v_t), SpringForm::rescaled);
      CAPTURE(r.v_t);
      CHECK(std::abs(total.slip() / k_unit - r.slip) < k_table);
      CHECK(std::abs(total.surface / k_unit - r.surface) < k_table);
      farthest = std::max(farthest, std::abs(rescaled.surface / k_unit - r.surface));
    }
  }
  CHECK(farthest < k_apart);
}
