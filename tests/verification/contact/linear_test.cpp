// SPDX-License-Identifier: Apache-2.0
// The linear spring-dashpot against closed forms: the damped oscillator, the rebound of a hard
// sphere, two compressed spheres between planes (set-ups of the MFiX cases DEM01 to DEM04).
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "verification/contact/densest_packing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

DemRig::Choice hooke(double stiffness, double restitution, double friction = 0.0) {
  return {"hooke",
          {{"normal_stiffness", stiffness}, {"restitution", restitution}, {"friction", friction}}};
}
double mass_of(double radius, double density) {
  return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// Kinetic energy over weight times diameter that three in four spheres of 1 cm are below, which
/// have fallen into a box and lain there for a while at the default step. The others may spin in
/// their place: nothing here stops that.
double motion_left(const DemRig::Choice& law, double time) {
  constexpr double diameter = 0.01;
  DemRig rig;
  const int m = rig.material(2650, 20e6, 0.3);
  rig.laws_of(m, m, law, {"epsd2", {{"friction", 0.2}}});
  rig.diameters = {diameter};
  rig.setup.gravity = {0, 0, -9.81};
  rig.setup.time.expected_speed = 1.0;
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {0.05, 0.05, 0.2};
  for (int side = 0; side < 5; ++side) rig.wall(side, m);
  auto dem = rig.make();
  const dust::sdk::Random random(3, dust::sdk::stream_of("bed"));
  std::vector<NewGrain> grains;
  for (std::uint32_t n = 0; n < 96; ++n) {
    Vec3 at{n % 4 * 1.0, n / 4 % 4 * 1.0, n / 16 * 1.0};
    for (std::uint32_t d = 0; d < 3; ++d) at[d] += 0.55 + 0.08 * random.uniform(n, 0, d);
    grains.push_back({.position = 0.012 * at, .diameter = diameter});
  }
  dem->insert(grains);
  Stepper stepper(*dem);
  while (stepper.time() < time) stepper.step();
  std::vector<double> energies;
  for (std::int64_t id = 0; id < 96; ++id) {
    const GrainState g = grain(*dem, id);
    energies.push_back(0.5 * dot(g.velocity, g.velocity) +
                       0.05 * diameter * diameter * dot(g.rotation, g.rotation));
  }
  std::ranges::sort(energies);
  return energies[72] / (9.81 * diameter);
}

}  // namespace

TEST_CASE("a bed of low restitution on linear springs shall come to rest at the default step") {
  struct Row {
    double restitution, ratio, friction;
  };
  // The tangential dampers of a grain's contacts add up, and so do the normal ones: without a bound
  // up to a fifth of weight times diameter is left for ever. Springs swing out slowly.
  constexpr double k_swings = 1e-7;
  for (const Row& r : {Row{0.3, 1.0, 0.5},
                       {0.1, 2.0 / 7.0, 0.5},
                       {0.1, 1.0, 0.5},
                       {0.01, 2.0 / 7.0, 0.5},
                       {0.01, 1.0, 0.5},
                       {0.01, 2.0 / 7.0, 0.0}}) {
    CAPTURE(r.restitution);
    CAPTURE(r.ratio);
    CAPTURE(r.friction);
    CHECK(motion_left({"hooke",
                       {{"normal_stiffness", 1e4},
                        {"tangential_stiffness_ratio", r.ratio},
                        {"restitution", r.restitution},
                        {"friction", r.friction}}},
                      1.5) < k_swings);
  }
}

TEST_CASE("the densest packing of low restitution shall come to rest on linear springs") {
  // Twelve neighbours each, without friction: the normal dampers alone.
  constexpr double diameter = 0.01;
  for (const double restitution : {0.3, 0.2, 0.1, 0.03, 0.01}) {
    DemRig rig;
    const int m = rig.material(2650, 20e6, 0.3);
    rig.laws_of(m, m, hooke(1e4, restitution));
    std::vector<NewGrain> grains = densest_packing(rig, diameter, 0.999);
    auto dem = rig.make();
    const dust::sdk::Random random(5, dust::sdk::stream_of("dense"));
    Vec3 sum;
    for (std::uint32_t n = 0; n < 256; ++n) {
      for (std::uint32_t d = 0; d < 3; ++d) {
        grains[n].velocity[static_cast<int>(d)] = 1e-6 * random.uniform(n, 0, d);
      }
      sum = sum + grains[n].velocity;
    }
    for (NewGrain& g : grains) g.velocity = g.velocity - sum / 256.0;
    dem->insert(grains);
    Stepper stepper(*dem);
    while (stepper.time() < 0.1) stepper.step();
    double fastest = 0.0;
    for (std::int64_t id = 0; id < 256; ++id) {
      fastest = std::max(fastest, norm(grain(*dem, id).velocity));
    }
    CAPTURE(restitution);
    CHECK(fastest < 1e-12);  // of 1e-6
  }
}

TEST_CASE("a hooke impact shall return the declared restitution in the oscillator's time") {
  // A contact begins and ends within a step: an error of first order in the step, 1/400 of the
  // contact here.
  constexpr double k_realised = 0.004;
  constexpr double k_time = 0.01;
  constexpr double radius = 1e-3;
  constexpr double stiffness = 2e4;
  for (const double speed : {0.05, 2.0}) {
    for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      DemRig rig;
      const int m = rig.material(2650, 50e6, 0.3);
      rig.laws_of(m, m, hooke(stiffness, e));
      rig.diameters = {2 * radius};
      const double l = std::log(e) / std::numbers::pi;
      const double duration = std::numbers::pi *
                              std::sqrt(0.5 * mass_of(radius, 2650) / stiffness) *
                              std::sqrt(1.0 + l * l);
      const double step = duration / 400.0;
      rig.setup.time.dem_step = step;
      auto dem = rig.make();
      dem->insert(std::vector<NewGrain>{{.position = {radius + speed * step, 0, 0},
                                         .velocity = {-speed, 0, 0},
                                         .diameter = 2 * radius},
                                        {.position = {-radius - speed * step, 0, 0},
                                         .velocity = {speed, 0, 0},
                                         .diameter = 2 * radius}});
      Stepper stepper(*dem);
      int in_touch = 0;
      for (int n = 0; n < 600; ++n) {
        stepper.step();
        in_touch += dem->report().contacts > 0 ? 1 : 0;
      }
      CAPTURE(e);
      CAPTURE(speed);
      CHECK(std::abs(grain(*dem, 0).velocity.x / speed - e) < k_realised);
      CHECK(in_touch * step == approx(duration).epsilon(k_time));
    }
  }
}

TEST_CASE("a stiff hooke sphere shall rebound as high as a hard one") {
  // Hard-sphere limit: the k-th rebound reaches R + (h0 - R) e^(2k).
  constexpr double k_hard = 0.01;
  constexpr double radius = 0.1;
  constexpr double start = 0.5;
  for (const double e : {0.5, 0.8, 1.0}) {
    DemRig rig;
    const int m = rig.material(2600, 50e6, 0.3);
    rig.laws_of(m, m, hooke(5e6, e));
    rig.diameters = {2 * radius};
    rig.setup.gravity = {0, 0, -9.80665};
    rig.setup.domain.min = {-1, -1, 0};
    rig.wall(4, m);
    rig.setup.time.dem_step = 5e-6;
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{{.position = {0, 0, start}, .diameter = 2 * radius}});
    Stepper stepper(*dem);
    for (int bounce = 1; bounce <= 3; ++bounce) {
      while (dem->report().contacts == 0) stepper.step();
      while (dem->report().contacts > 0) stepper.step();
      double top = 0.0;
      while (grain(*dem, 0).velocity.z > 0.0) {
        stepper.step(20);
        top = std::max(top, grain(*dem, 0).position.z);
      }
      CAPTURE(e);
      CAPTURE(bounce);
      CHECK(top == approx(radius + (start - radius) * std::pow(e, 2.0 * bounce)).epsilon(k_hard));
    }
  }
}

TEST_CASE("two compressed spheres between planes shall swing as their equations of motion") {
  // D 1 mm, densities 20000 (below) and 10000, planes 1.8 mm apart, 1000 N/m, elastic. Reference:
  // the same case integrated independently, to 1 ms.
  constexpr double k_tolerance = 5e-4;
  constexpr double radius = 5e-4;
  DemRig rig;
  const int heavy = rig.material(20000, 50e6, 0.3);
  const int light = rig.material(10000, 50e6, 0.3);
  for (const auto& [i, j] : {std::pair{heavy, heavy}, {heavy, light}, {light, light}}) {
    rig.laws_of(i, j, hooke(1000.0, 1.0));
  }
  rig.diameters = {2 * radius};
  rig.setup.gravity = {0, 0, -9.80665};
  rig.setup.domain.min = {-1, -1, 0};
  rig.setup.domain.max = {1, 1, 1.8e-3};
  rig.wall(4, heavy);
  rig.wall(5, heavy);
  rig.setup.time.dem_step = 1e-7;
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{
      {.position = {0, 0, 0.45e-3}, .diameter = 2 * radius, .material = heavy},
      {.position = {0, 0, 1.35e-3}, .diameter = 2 * radius, .material = light}});
  Stepper stepper(*dem);
  struct Row {
    double time, lower, upper;
  };
  const Row rows[] = {{2e-4, 4.24581628e-4, 1.37309069e-3},
                      {4e-4, 4.25636024e-4, 1.37846936e-3},
                      {6e-4, 4.49428246e-4, 1.35009040e-3},
                      {8e-4, 4.24158451e-4, 1.36772138e-3},
                      {1e-3, 4.27127963e-4, 1.38355313e-3}};
  for (const Row& r : rows) {
    stepper.step(std::llround((r.time - stepper.time()) / 1e-7));
    CAPTURE(r.time);
    CHECK(grain(*dem, 0).position.z == approx(r.lower).epsilon(k_tolerance));
    CHECK(grain(*dem, 1).position.z == approx(r.upper).epsilon(k_tolerance));
  }
}

TEST_CASE("a sphere on linear springs shall end its slip at 5/7 of its speed after 2 u0/(7 mu g)") {
  constexpr double k_speed = 5e-4;
  constexpr double k_time = 0.006;
  constexpr double g = 9.81;
  constexpr double u0 = 0.1;
  constexpr double radius = 5e-4;
  constexpr double stiffness = 1e4;
  for (const double mu : {0.2, 0.6, 1.0}) {
    DemRig rig;
    const int m = rig.material(10000, 50e6, 0.3);
    rig.laws_of(m, m, hooke(stiffness, 0.5, mu));
    rig.diameters = {2 * radius};
    rig.setup.gravity = {0, 0, -g};
    rig.setup.domain.min = {-1, -1, 0};
    rig.wall(4, m);
    rig.setup.time.dem_step = 2e-6;
    auto dem = rig.make();
    const double overlap = mass_of(radius, 10000) * g / stiffness;
    dem->insert(std::vector<NewGrain>{
        {.position = {0, 0, radius - overlap}, .velocity = {u0, 0, 0}, .diameter = 2 * radius}});
    Stepper stepper(*dem);
    const auto slip = [&] {
      const GrainState s = grain(*dem, 0);
      return s.velocity.x - radius * s.rotation.y;
    };
    // The slip falls on a straight line to the end; extrapolated from its last tenth.
    const double end = 2.0 / 7.0 * u0 / (mu * g);
    while (stepper.time() < 0.85 * end) stepper.step();
    const double t1 = stepper.time();
    const double s1 = slip();
    while (stepper.time() < 0.95 * end) stepper.step();
    const double t2 = stepper.time();
    const double s2 = slip();
    CAPTURE(mu);
    CHECK(t2 + s2 * (t2 - t1) / (s1 - s2) == approx(end).epsilon(k_time));
    while (stepper.time() < 1.2 * end) stepper.step();
    CHECK(grain(*dem, 0).velocity.x == approx(5.0 / 7.0 * u0).epsilon(k_speed));
    CHECK(radius * grain(*dem, 0).rotation.y == approx(5.0 / 7.0 * u0).epsilon(k_speed));
  }
}
