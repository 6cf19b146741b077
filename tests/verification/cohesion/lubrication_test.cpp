// SPDX-License-Identifier: Apache-2.0
// The film between two grains: what it takes from their approach.
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"
#include "verification/cohesion/sticky.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

const double k_r = Sticky::radius;
constexpr double k_viscosity = 0.05;
constexpr double k_smallest = 1e-3;
constexpr double k_reach = 1.0;
const DemRig::Choice k_film{
    "lubrication", {{"viscosity", k_viscosity}, {"smallest_gap", k_smallest}, {"reach", k_reach}}};

/// Loss of speed [m/s] of a pair of effective radius and mass from the gap `from` to `to`: the
/// integral of 6 pi mu R*^2 / m* (1/h - 1/h_r) over h.
double loss(double radius, double mass, double from, double to) {
  return 6.0 * k_pi * k_viscosity * radius * radius / mass *
         (std::log(from / to) - (from - to) / (k_reach * radius));
}

/// Two grains 0.8 R* apart that approach, or a grain and the floor (`other` 0).
struct Approach {
  double radius, mass;  ///< effective
  double speed = 0.0;   ///< when the gap has become `gap` [m/s], or when it stopped
  double gap = 0.0;
};
Approach approach(double other, double speed, double until, double step) {
  Sticky s(k_film, 1.0, 0.0);
  if (other == 0.0) s.floor();
  s.rig.diameters = {2 * k_r, 2 * (other > 0.0 ? other : k_r)};
  s.rig.setup.time.dem_step = step;
  const double mass = Sticky::mass();
  const double partner = mass * std::pow(other / k_r, 3);
  Approach out{k_r, mass};
  if (other > 0.0) out = {k_r * other / (k_r + other), mass * partner / (mass + partner)};
  const double start = 0.8 * out.radius;
  auto dem = s.rig.make();
  const double below = other > 0.0 ? -other : 0.0;
  std::vector<NewGrain> grains{
      {.position = {0, 0, k_r + start}, .velocity = {0, 0, -speed}, .diameter = 2 * k_r}};
  if (other > 0.0) grains.push_back({.position = {0, 0, below}, .diameter = 2 * other});
  dem->insert(grains);
  Stepper stepper(*dem);
  const auto look = [&] {
    const double bottom = other > 0.0 ? grain(*dem, 1).position.z + other : 0.0;
    const double bottom_speed = other > 0.0 ? grain(*dem, 1).velocity.z : 0.0;
    out.gap = grain(*dem, 0).position.z - k_r - bottom;
    out.speed = bottom_speed - grain(*dem, 0).velocity.z;
  };
  for (look(); out.gap > until && out.speed > 1e-4 * speed && stepper.time() < 0.1; look()) {
    stepper.step();
  }
  return out;
}

/// Grains of 20 um in water as dense as they can lie, almost in touch, in random motion.
std::vector<NewGrain> dense_grains(double diameter, double gap) {
  const double side = diameter * (1.0 + gap) * std::sqrt(2.0);
  const Vec3 corners[] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  const dust::sdk::Random random(1, dust::sdk::stream_of("film"));
  std::vector<NewGrain> grains;
  for (std::uint32_t cell = 0; cell < 27; ++cell) {
    const Vec3 at{cell % 3 * 1.0, cell / 3 % 3 * 1.0, cell / 9 * 1.0};
    for (const Vec3& corner : corners) {
      Vec3 velocity;
      const auto n = static_cast<std::uint32_t>(grains.size());
      for (std::uint32_t d = 0; d < 3; ++d) velocity[d] = 2e-3 * random.uniform(n, 0, d) - 1e-3;
      grains.push_back(
          {.position = side * (at + corner), .velocity = velocity, .diameter = diameter});
    }
  }
  return grains;
}

}  // namespace

TEST_CASE("a film shall take from two grains that approach the speed of its closed form") {
  for (const double other : {0.0, k_r, 0.4 * k_r}) {
    const double start = 0.8 * (other > 0.0 ? k_r * other / (k_r + other) : k_r);
    const double until = 0.02 * start;
    double share[2];
    for (const int half : {0, 1}) {
      const Approach a = approach(other, 2.0, until, half == 0 ? 2e-7 : 1e-7);
      REQUIRE(a.gap <= until);
      const double expected = loss(a.radius, a.mass, start, a.gap);
      CHECK(expected > 0.2);
      share[half] = (2.0 - a.speed) / expected;
    }
    CAPTURE(other);
    CHECK(share[0] == approx(1.0).epsilon(5e-3));
    // Second order in the step: a film that the step resolves is not slowed by its bound.
    CHECK((4.0 * share[1] - share[0]) / 3.0 == approx(1.0).epsilon(2e-4));
  }
}

TEST_CASE("a film shall stop slow grains short of touch and let fast ones touch") {
  const double radius = 0.5 * k_r;
  const double mass = 0.5 * Sticky::mass();
  // Down to the smallest gap, and through it against a constant resistance.
  const double to_touch =
      loss(radius, mass, 0.8 * radius, k_smallest * radius) +
      6.0 * k_pi * k_viscosity * radius * radius / mass * (1.0 - k_smallest / k_reach);
  const Approach slow = approach(k_r, 0.9 * to_touch, 0.0, 1e-7);
  CHECK(slow.gap > 0.0);
  CHECK(slow.speed < 1e-3 * to_touch);
  const Approach fast = approach(k_r, 1.1 * to_touch, 0.0, 1e-7);
  CHECK(fast.gap <= 0.0);
}

TEST_CASE("a film far stiffer than the step shall stop a pair and not throw it back") {
  // K dt / m* is some 200 at the smallest gap.
  const Approach stiff = approach(k_r, 0.05, 0.0, 1e-4);
  CHECK(stiff.gap > 0.0);
  CHECK(std::abs(stiff.speed) < 1e-3 * 0.05);
}

TEST_CASE("films of twelve neighbours shall give no grain energy, however long the step") {
  // K dt/m* is some 0.2, 2 and 20 in the first gaps: films that each took the speed of their pair
  // in a step would take twelve times what there is.
  constexpr double diameter = 20e-6;
  for (const double viscosity : {1e-3, 1e-2, 0.1}) {
    Sticky s({"lubrication", {{"viscosity", viscosity}, {"smallest_gap", k_smallest}}}, 0.5, 0.3);
    s.rig.diameters = {diameter};
    s.rig.setup.time.dem_step = 2e-8;
    auto dem = s.rig.make();
    dem->insert(dense_grains(diameter, 5e-4));
    const auto energy = [&] {
      double sum = 0.0;
      for (std::int64_t id = 0; id < 108; ++id) {
        const GrainState g = grain(*dem, id);
        sum +=
            dot(g.velocity, g.velocity) + 0.1 * diameter * diameter * dot(g.rotation, g.rotation);
      }
      return sum;
    };
    const double start = energy();
    double before = start;
    double growth = 0.0;
    Stepper stepper(*dem);
    while (stepper.time() < 2e-5) {
      stepper.step();
      const double now = energy();
      growth = std::max(growth, now - before);
      before = now;
    }
    CAPTURE(viscosity);
    CAPTURE(before / start);
    // What contacts give back of the little they took.
    CHECK(growth < 1e-3 * start);
    CHECK(before < 0.3 * start);
  }
}

TEST_CASE("grains in a film shall keep their momentum and lose energy in touch and parting") {
  Sticky s(k_film, 1.0, 0.0);
  s.rig.diameters = {k_r, 2 * k_r};
  s.rig.setup.time.dem_step = 2e-7;
  auto dem = s.rig.make();
  const double small = Sticky::mass() / 8.0;
  dem->insert(std::vector<NewGrain>{
      {.position = {0, 0, 0}, .velocity = {0, 0, 4.0}, .diameter = k_r},
      {.position = {0.2 * k_r, 0, 1.9 * k_r}, .velocity = {0.1, 0, -2.0}, .diameter = 2 * k_r}});
  const Vec3 before = small * Vec3{0, 0, 4.0} + Sticky::mass() * Vec3{0.1, 0, -2.0};
  Stepper stepper(*dem);
  bool touched = false;
  while (stepper.time() < 4e-4) {
    stepper.step();
    touched = touched || dem->report().contacts > 0;
  }
  REQUIRE(touched);
  const auto a = grain(*dem, 0);
  const auto b = grain(*dem, 1);
  CHECK(norm(small * a.velocity + Sticky::mass() * b.velocity - before) < 1e-12 * norm(before));
  const Vec3 normal = (b.position - a.position) / norm(b.position - a.position);
  const double parts = dot(b.velocity - a.velocity, normal);
  CHECK(parts > 0.5);
  CHECK(parts < 5.0);  // came together at 6
}

TEST_CASE("a film of air shall brake dust before sand, with several rates as with one") {
  constexpr double k_air = 1.8e-5;
  constexpr double dust = 5e-6;
  for (const bool single : {true, false}) {
    Sticky s({"lubrication", {{"viscosity", k_air}, {"smallest_gap", k_smallest}}}, 1.0, 0.0);
    s.rig.diameters = {2 * dust, 2 * k_r};
    s.rig.setup.time.rates_single = single;
    const double radius = dust * k_r / (dust + k_r);
    const double start = 0.8 * radius;
    auto dem = s.rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = {0, 0, 0}, .diameter = 2 * k_r},
        {.position = {0, 0, k_r + dust + start}, .velocity = {0, 0, -0.5}, .diameter = 2 * dust}});
    Stepper stepper(*dem);
    double gap = start;
    while (gap > 0.1 * radius && stepper.time() < 1e-3) {
      stepper.step();
      gap = grain(*dem, 1).position.z - grain(*dem, 0).position.z - k_r - dust;
    }
    CAPTURE(single);
    REQUIRE(gap > 0.0);
    const double mass = Sticky::mass() * std::pow(dust / k_r, 3);
    const double expected = loss(radius, mass, start, gap) * k_air / k_viscosity;
    const double slower = 0.5 + grain(*dem, 1).velocity.z - grain(*dem, 0).velocity.z;
    CHECK(expected > 2e-3);
    CHECK(slower == approx(expected).epsilon(0.02));
  }
}
