// SPDX-License-Identifier: Apache-2.0
#include "particles/work/contact_work.hpp"

#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::DemRig;
using dust::test::grain;
using dust::test::GrainState;
using dust::test::Stepper;
namespace particles = dust::particles;

namespace {

constexpr double k_diameter = 4e-3;  // m

/// A rig without gravity whose grains carry dust, so that the work of contacts is kept.
DemRig dusty_rig() {
  DemRig rig;
  rig.setup.time.fluid_step = 1e-3;
  rig.setup.time.expected_speed = 3.0;
  rig.material(2500, 2e7, 0.3);
  rig.material(7800, 2e7, 0.3);
  rig.diameters = {k_diameter};
  rig.options.dust_shares = {{0.01}, {}};
  return rig;
}

double energy(const GrainState& g) {
  const double inertia = 0.4 * g.mass * g.radius * g.radius;
  return 0.5 * g.mass * dot(g.velocity, g.velocity) + 0.5 * inertia * dot(g.rotation, g.rotation);
}

std::size_t row_of(particles::Dem& dem, std::int64_t id) {
  const auto rows = dem.rows();
  for (std::size_t n = 0; n < rows.count; ++n) {
    if (rows.id[n] == id) return n;
  }
  return rows.count;
}

/// Until the grain is done with what it meets.
void run(particles::Dem& dem, double duration) {
  Stepper stepper(dem);
  stepper.step(std::lround(duration / dem.coarse_step()));
  dem.synchronise();
}

}  // namespace

TEST_CASE("a head-on bounce on a wall shall leave its lost energy with the grain") {
  for (const std::string law : {"hertz_mindlin", "hooke"}) {
    for (const double restitution : {0.3, 0.5, 0.7, 0.9}) {
      CAPTURE(law);
      CAPTURE(restitution);
      DemRig rig = dusty_rig();
      DemRig::Choice contact{law, {{"restitution", restitution}, {"friction", 0.4}}};
      if (law == "hooke") contact.values["normal_stiffness"] = 2e5;
      rig.laws_of(0, 1, contact);
      rig.wall(4, 1);
      const auto dem = rig.make();
      dem->insert({{{.position = {0, 0, -1 + 0.6 * k_diameter},
                     .velocity = {0, 0, -2},
                     .diameter = k_diameter}}});
      const double before = energy(grain(*dem, 0));
      run(*dem, 2e-3);
      CHECK(grain(*dem, 0).velocity.z > 0.0);
      const auto& work = dem->contact_work();
      const std::size_t row = row_of(*dem, 0);
      const double lost = (1.0 - restitution * restitution) * before;
      // To the error of the time steps, of the energy before: what is left of it by e^2, and what
      // the grain lost in truth.
      CHECK(std::abs(work.with_wall(row, 0).normal - lost) < 0.012 * before);
      CHECK(std::abs(work.sum(row).sum() - (before - energy(grain(*dem, 0)))) < 0.01 * before);
      CHECK(work.with_wall(row, 0).tangential == 0.0);
      CHECK(work.with_particles(row).sum() == 0.0);
      CHECK(work.acceleration(row) > 0.0);
    }
  }
}

TEST_CASE("a bounce that costs next to nothing shall hand out next to nothing") {
  const auto handed_out = [](double restitution, double speed) {
    DemRig rig = dusty_rig();
    rig.law(0, 1, restitution, 0.0);
    rig.wall(4, 1);
    const auto dem = rig.make();
    dem->insert({{{.position = {0, 0, -1 + 0.6 * k_diameter},
                   .velocity = {0, 0, -speed},
                   .diameter = k_diameter}}});
    const double before = energy(grain(*dem, 0));
    run(*dem, 2e-3 + k_diameter / speed);
    CHECK(grain(*dem, 0).velocity.z > 0.0);
    return dem->contact_work().with_wall(row_of(*dem, 0), 0).sum() / before;
  };
  // To second order in the steps of a collision: some 15 at the expected speed, more of slower
  // ones.
  for (const double speed : {0.1, 1.0, 3.0}) {
    CAPTURE(speed);
    const double least = speed < 0.5 ? 0.01 : 0.02;
    CHECK(handed_out(1.0, speed) < least);
    CHECK(handed_out(0.99, speed) == approx(1.0 - 0.99 * 0.99).scale(1.0).epsilon(least));
    CHECK(handed_out(0.95, speed) == approx(1.0 - 0.95 * 0.95).scale(1.0).epsilon(least));
  }
}

TEST_CASE("two grains shall share what their collision dissipates") {
  DemRig rig = dusty_rig();
  rig.law(0, 0, 0.5, 0.4);
  const auto dem = rig.make();
  const double apart = 0.52 * k_diameter;
  dem->insert({{{.position = {-apart, 0, 0}, .velocity = {1, 0, 0}, .diameter = k_diameter},
                {.position = {apart, 0, 0}, .velocity = {-2, 0, 0}, .diameter = k_diameter}}});
  const double before = energy(grain(*dem, 0)) + energy(grain(*dem, 1));
  run(*dem, 2e-3);
  const double lost = before - energy(grain(*dem, 0)) - energy(grain(*dem, 1));
  const double mass = grain(*dem, 0).mass;
  // (1 - e^2) m* v^2 / 2 of the relative motion.
  CHECK(lost == approx(0.75 * 0.5 * (0.5 * mass) * 9.0).epsilon(0.01));
  for (const std::int64_t id : {0, 1}) {
    CHECK(dem->contact_work().with_particles(row_of(*dem, id)).normal ==
          approx(0.5 * lost).epsilon(0.01));
  }
}

TEST_CASE("an oblique impact shall hand out all energy that it costs, sliding apart") {
  DemRig rig = dusty_rig();
  rig.law(0, 1, 0.6, 0.3, 0.1);
  rig.wall(4, 1);
  const auto dem = rig.make();
  dem->insert({{{.position = {0, 0, -1 + 0.55 * k_diameter},
                 .velocity = {2, 0.5, -1.5},
                 .rotation = {0, 0, 100},
                 .diameter = k_diameter}}});
  const double before = energy(grain(*dem, 0));
  run(*dem, 2e-3);
  const double lost = before - energy(grain(*dem, 0));
  const auto work = dem->contact_work().with_wall(row_of(*dem, 0), 0);
  CHECK(work.sum() == approx(lost).epsilon(0.01));
  CHECK(work.tangential > 0.3 * lost);
  CHECK(work.normal == approx((1.0 - 0.36) * 0.5 * grain(*dem, 0).mass * 1.5 * 1.5).epsilon(0.02));
}

TEST_CASE("a grain that slides on a wall shall hand out friction times its way while it slides") {
  DemRig rig = dusty_rig();
  rig.setup.gravity = {0, 0, -9.81};
  rig.law(0, 1, 0.3, 0.2);
  rig.wall(4, 1);
  const auto dem = rig.make();
  dem->insert({{{.position = {0, 0, -1 + 0.5 * k_diameter},
                 .velocity = {1, 0, 0},
                 .diameter = k_diameter}}});
  run(*dem, 10e-3);
  dem->clear_contact_work();
  const GrainState at_start = grain(*dem, 0);
  const double before = energy(at_start);
  Stepper stepper(*dem);
  stepper.step(std::lround(20e-3 / dem->coarse_step()));
  dem->synchronise();
  const GrainState now = grain(*dem, 0);
  const auto work = dem->contact_work().with_wall(row_of(*dem, 0), 0);
  // It still slides: its spin has not caught up.
  REQUIRE(now.velocity.x > now.radius * std::abs(now.rotation.y) * 1.05);
  CHECK(work.tangential == approx(before - energy(now)).epsilon(0.02));
}

TEST_CASE("what a contact hands out shall not depend on how often it is asked") {
  DemRig rig = dusty_rig();
  rig.law(0, 1, 0.6, 0.3);
  rig.wall(4, 1);
  const auto bounce = [&](bool is_asked) {
    DemRig again = dusty_rig();
    again.law(0, 1, 0.6, 0.3);
    again.wall(4, 1);
    const auto dem = again.make();
    dem->insert({{{.position = {0, 0, -1 + 0.55 * k_diameter},
                   .velocity = {1, 0, -2},
                   .diameter = k_diameter}}});
    Stepper stepper(*dem);
    double sum = 0.0;
    const auto steps = std::lround(2e-3 / dem->coarse_step());
    for (long n = 0; n < steps; ++n) {
      stepper.step();
      if (!is_asked) continue;
      // Nothing is handed out that would have to be taken back.
      const double given = dem->contact_work().sum(0).sum();
      CHECK(given >= 0.0);
      sum += given;
      dem->clear_contact_work();
    }
    return is_asked ? sum : dem->contact_work().sum(0).sum();
  };
  CHECK(bounce(true) == approx(bounce(false)).epsilon(1e-12));
}

TEST_CASE("a small grain on finer steps shall share its losses with the large one that it hits") {
  DemRig rig = dusty_rig();
  constexpr double k_small = 0.2e-3;
  rig.diameters = {k_small, k_diameter};
  rig.law(0, 0, 0.5, 0.4);
  const auto dem = rig.make();
  dem->insert({{{.position = {0, 0, 0}, .diameter = k_diameter},
                {.position = {0, 0, 0.5 * k_diameter + 0.8 * k_small},
                 .velocity = {0, 0, -2},
                 .diameter = k_small}}});
  REQUIRE(dem->class_steps()[0].level > 0);
  const double before = energy(grain(*dem, 0)) + energy(grain(*dem, 1));
  run(*dem, 1e-3);
  const double lost = before - energy(grain(*dem, 0)) - energy(grain(*dem, 1));
  CHECK(lost == approx(0.75 * before).epsilon(0.01));
  for (const std::int64_t id : {0, 1}) {
    CHECK(dem->contact_work().with_particles(row_of(*dem, id)).normal ==
          approx(0.5 * lost).epsilon(0.01));
  }
}

TEST_CASE("dust on grains shall be booked from its coming to its leaving") {
  DemRig rig = dusty_rig();
  rig.law(0, 0, 0.5, 0.4);
  rig.options.dust_shares = {{0.01, 0.002}, {}};
  const auto dem = rig.make();
  dem->insert({{{.position = {0, 0, 0}, .diameter = k_diameter},
                {.position = {0.999, 0, 0}, .velocity = {1, 0, 0}, .diameter = k_diameter},
                {.position = {0, 0.5, 0}, .diameter = k_diameter, .weight = 0.25}}});
  const double mass = 2500 * std::numbers::pi / 6.0 * std::pow(k_diameter, 3);
  CHECK(dem->dust_load(0)[0] == approx(0.01 * mass).epsilon(1e-14));
  dem->set_dust_free(2, 1, 0.5 * dem->dust_load(2)[1]);
  run(*dem, 2e-3);
  dem->remove_escaped();
  const auto coarse = dem->dust_balance(0);
  const auto fine = dem->dust_balance(1);
  CHECK(coarse.entered == approx(0.01 * 2.25 * mass).epsilon(1e-14));
  CHECK(coarse.left == approx(0.01 * mass).epsilon(1e-14));
  CHECK(fine.set_free == approx(0.002 * 0.125 * mass).epsilon(1e-14));
  CHECK(fine.on_grains == approx(0.002 * 1.125 * mass).epsilon(1e-14));
  CHECK(std::abs(coarse.error()) < 1e-15);
  CHECK(std::abs(fine.error()) < 1e-15);
}

TEST_CASE("grains of different weights shall have their losses by what each real grain costs") {
  // One stands for itself, the other is one of many copies of a rare grain, on the same steps and
  // on finer ones: what it meets loses as much less to it.
  for (const double diameter : {3e-3, 0.2e-3}) {
    for (const double weight : {1.0, 0.05}) {
      CAPTURE(diameter);
      CAPTURE(weight);
      DemRig rig = dusty_rig();
      rig.diameters = {diameter, k_diameter};
      rig.law(0, 0, 0.5, 0.4);
      const auto dem = rig.make();
      dem->insert({{{.position = {0, 0, 0}, .diameter = k_diameter},
                    {.position = {0, 0, 0.5 * k_diameter + 0.8 * diameter},
                     .velocity = {0, 0, -2},
                     .diameter = diameter,
                     .weight = weight}}});
      CHECK((dem->class_steps()[0].level > 0) == (diameter < 1e-3));
      const auto all = [&] { return energy(grain(*dem, 0)) + weight * energy(grain(*dem, 1)); };
      const double before = all();
      run(*dem, 2e-3);
      const double lost = before - all();
      CHECK(lost > 0.1 * before);
      const auto work = [&](std::int64_t id) {
        return dem->contact_work().with_particles(row_of(*dem, id)).sum();
      };
      CHECK(work(0) + weight * work(1) == approx(lost).epsilon(0.015));
      CHECK(work(0) == approx(weight * work(1)).epsilon(1e-9));
    }
  }
}
