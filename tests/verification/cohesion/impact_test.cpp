// SPDX-License-Identifier: Apache-2.0
// What cohesion takes from an impact.
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"
#include "verification/cohesion/sticky.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_gamma = 0.05;
const double k_r = Sticky::radius;
const double k_e = Sticky::young;

/// Speed after an impact on the plane z = 0 over the speed before; 0 where the grain sticks.
double rebound(const DemRig::Choice& law, double restitution, double speed) {
  Sticky s(law, restitution, 0.0);
  s.floor();
  const double hertz_time = s.rig.laws[0].contact->collision_time(k_r, Sticky::mass(), speed);
  s.rig.setup.time.dem_step = hertz_time / 2000.0;
  const double range = s.rig.laws[0].cohesion->range(k_r);
  auto dem = s.rig.make();
  dem->insert(std::vector<NewGrain>{
      {.position = {0, 0, k_r * (1.0 + 1e-6)}, .velocity = {0, 0, -speed}, .diameter = 2 * k_r}});
  Stepper stepper(*dem);
  for (int n = 0; n < 40000; ++n) {
    stepper.step();
    if (grain(*dem, 0).position.z > k_r + 1.01 * range + 1e-9 && n > 100) {
      return grain(*dem, 0).velocity.z / speed;
    }
  }
  return 0.0;
}

double closed_form(double work, double speed) {
  return std::sqrt(1.0 - 2.0 * work / (Sticky::mass() * speed * speed));
}

}  // namespace

TEST_CASE("an elastic impact of jkr spheres shall lose the work of their neck, or stick") {
  // W = 7.09 (gamma^5 R^4 / E^2)^(1/3): the curve from touch to tear (Thornton and Ning 1998). The
  // exact number is pi (2 pi)^(2/3) (0.6 + b^4 - 8/3 b^7 + 16/15 b^10), b^3 = 1/4.
  const double b = std::cbrt(0.25);
  const double number =
      k_pi * std::pow(2.0 * k_pi, 2.0 / 3.0) *
      (0.6 + std::pow(b, 4) - 8.0 / 3.0 * std::pow(b, 7) + 16.0 / 15.0 * std::pow(b, 10));
  CHECK(number == approx(7.09).epsilon(1e-3));
  const double work = number * std::cbrt(std::pow(k_gamma, 5) * std::pow(k_r, 4) / (k_e * k_e));
  const double sticking = std::sqrt(2.0 * work / Sticky::mass());
  const DemRig::Choice jkr{"jkr", {{"surface_energy", k_gamma}}};
  CHECK(rebound(jkr, 1.0, 0.9 * sticking) == 0.0);
  for (const double times : {1.2, 2.0, 10.0}) {
    CAPTURE(times);
    CHECK(rebound(jkr, 1.0, times * sticking) ==
          approx(closed_form(work, times * sticking)).epsilon(0.005));
  }
}

TEST_CASE("an elastic impact of wet spheres shall lose the work of their bridge, or stick") {
  const double volume = 1e-13;
  const DemRig::Choice wet{"liquid_bridge", {{"surface_tension", 0.072}, {"volume", volume}}};
  // Integral of 1 / (1 + 1.05 s + 2.5 s^2) from touch to rupture.
  const double unit = std::sqrt(volume / (2.0 * k_r));
  const double end = std::cbrt(volume) / unit;
  const double root = std::sqrt(10.0 - 1.05 * 1.05);
  const double integral =
      2.0 / root * (std::atan((5.0 * end + 1.05) / root) - std::atan(1.05 / root));
  const double work = 4.0 * k_pi * k_r * 0.072 * unit * integral;
  const double sticking = std::sqrt(2.0 * work / Sticky::mass());
  CHECK(rebound(wet, 1.0, 0.9 * sticking) == 0.0);
  for (const double times : {1.2, 2.0, 5.0}) {
    CAPTURE(times);
    CHECK(rebound(wet, 1.0, times * sticking) ==
          approx(closed_form(work, times * sticking)).epsilon(0.005));
  }
}

TEST_CASE("cohesion without range shall take nothing from an elastic impact") {
  // The force jumps at touch (dmt): an error of first order in the step, 1/2000 of the contact.
  for (const DemRig::Choice& law : {DemRig::Choice{"dmt", {{"surface_energy", k_gamma}}},
                                    DemRig::Choice{"sjkr", {{"energy_density", 1e5}}}}) {
    for (const double speed : {0.02, 0.5}) {
      CAPTURE(law.name);
      CHECK(rebound(law, 1.0, speed) == approx(1.0).epsilon(0.003));
    }
  }
}

TEST_CASE("damped sticky grains shall stick when slow and rebound when fast") {
  const DemRig::Choice dmt{"dmt", {{"surface_energy", k_gamma}}};
  CHECK(rebound(dmt, 0.5, 0.005) == 0.0);
  const double fast = rebound(dmt, 0.5, 1.0);
  CHECK(fast > 0.4);
  CHECK(fast < 0.5 + 1e-3);
}

namespace {

/// Some sticky grains of three sizes fly together; rows of all states after a while.
std::vector<GrainState> clump(const DemRig::Choice& law, std::size_t threads) {
  oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                      threads);
  Sticky s(law, 0.5, 0.5);
  s.rig.diameters = {10e-6, 400e-6, 600e-6};
  s.rig.setup.domain.min = {-1e-2, -1e-2, -1e-2};
  s.rig.setup.domain.max = {1e-2, 1e-2, 1e-2};
  for (int d = 0; d < 3; ++d) s.rig.periodic(d);
  const dust::sdk::Random random(3, 9);
  std::vector<NewGrain> grains;
  for (std::uint64_t n = 0; n < 216; ++n) {
    const auto at = [&](std::uint64_t k) { return 7e-4 * (static_cast<double>(k % 6) - 2.5); };
    const Vec3 place{at(n), at(n / 6), at(n / 36)};
    grains.push_back({.position = place + 1e-5 * Vec3{random.uniform(n, 0), random.uniform(n, 1),
                                                      random.uniform(n, 2)},
                      .velocity = -60.0 * place,
                      .diameter = n % 4 == 3   ? 10e-6
                                  : n % 2 == 0 ? 400e-6
                                               : 600e-6});
  }
  auto dem = s.rig.make();
  dem->insert(grains);
  Stepper stepper(*dem);
  while (stepper.time() < 8e-3) stepper.step();
  REQUIRE(dem->report().contacts > 30);
  std::vector<GrainState> out;
  for (std::int64_t n = 0; n < 216; ++n) out.push_back(grain(*dem, n));
  return out;
}

}  // namespace

TEST_CASE("a clump of sticky grains shall keep momentum and its bits on any number of threads") {
  for (const DemRig::Choice& law :
       {DemRig::Choice{"jkr", {{"surface_energy", 0.2}}},
        DemRig::Choice{"liquid_bridge", {{"surface_tension", 0.05}, {"relative_volume", 0.01}}},
        DemRig::Choice{"lubrication", {{"viscosity", 1e-3}}}}) {
    CAPTURE(law.name);
    const auto one = clump(law, 1);
    const auto two = clump(law, 2);
    Vec3 momentum;
    double scale = 0.0;
    Vec3 before;
    for (std::size_t n = 0; n < one.size(); ++n) {
      const GrainState& g = one[n];
      momentum += g.mass * g.velocity;
      const auto at = [&](std::size_t k) { return 7e-4 * (static_cast<double>(k % 6) - 2.5); };
      before += g.mass * (-60.0 * Vec3{at(n), at(n / 6), at(n / 36)});
      scale += g.mass * 0.2;
      CHECK(norm(g.position - two[n].position) == 0.0);
      CHECK(norm(g.velocity - two[n].velocity) == 0.0);
    }
    // All that fine grains give to coarse ones has arrived at the end of a coarse step.
    CHECK(norm(momentum - before) < 1e-13 * scale);
  }
}

TEST_CASE("dust shall stick to sand and rest on it, with several rates as with one") {
  // 10 um on 600 um, below the speed at which an elastic impact would free it (66 mm/s).
  constexpr double gamma = 0.01;
  constexpr double dust = 5e-6;
  const double reduced = dust * k_r / (dust + k_r);
  const double length = std::cbrt(2.0 * k_pi * gamma * reduced * reduced / k_e);
  const double b = std::cbrt(1.5);
  const double resting = (b * b * b * b - b) * length * length / reduced;
  for (const bool single : {true, false}) {
    Sticky s({"jkr", {{"surface_energy", gamma}}}, 0.5, 0.5);
    s.rig.diameters = {2 * dust, 2 * k_r};
    s.rig.setup.time.rates_single = single;
    auto dem = s.rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = {0, 0, 0}, .diameter = 2 * k_r},
        {.position = {0, 0, k_r + 1.1 * dust}, .velocity = {0, 0, -0.03}, .diameter = 2 * dust}});
    Stepper stepper(*dem);
    while (stepper.time() < 2e-3) stepper.step();
    const Vec3 apart = grain(*dem, 1).position - grain(*dem, 0).position;
    CAPTURE(single);
    CHECK(k_r + dust - norm(apart) == approx(resting).epsilon(0.02));
    CHECK(norm(grain(*dem, 1).velocity - grain(*dem, 0).velocity) < 1e-4);
  }
}
