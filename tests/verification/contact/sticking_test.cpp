// SPDX-License-Identifier: Apache-2.0
// Impacts that stick: what the tangential and the rolling spring keep, against the laws' own
// equations, at the default step and by the order of convergence.
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "verification/contact/stick_reference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_radius = 3e-4;
constexpr double k_density = 2650.0;
constexpr double k_young = 50e6;
constexpr double k_poisson = 0.3;
constexpr double k_speed = 0.5;
constexpr double k_tangential = 0.1;
/// Where in a step the contact begins decides on a part of the error: so many starts are tried.
constexpr int k_starts = 16;

StickCase base(double restitution = 1.0) {
  StickCase c;
  c.effective_young = k_young / (1.0 - k_poisson * k_poisson) / 2.0;
  c.effective_shear = k_young / (2.0 * (1.0 + k_poisson)) / (2.0 - k_poisson) / 2.0;
  c.normal_stiffness = 300.0;
  c.stiffness_ratio = 2.0 / 7.0;
  c.radius = k_radius;
  c.density = k_density;
  c.speed = k_speed;
  c.tangential = k_tangential;
  c.restitution = restitution;
  return c;
}

/// How the engine is to run a case.
struct Setting {
  double steps_per_contact = 0.0;  ///< 0: the default step
  /// The plane swings along itself, as a body; else it is a side of the domain.
  double amplitude = 0.0, frequency = 0.0;  ///< [m], [1/s]
  double largest_diameter = 0.0;  ///< of a grain far away, beside which this one is sub-stepped
  DemRig::Choice cohesion;
};

struct Answer {
  StickResult result;
  double touch = 0.0;  ///< [s] when the two began to touch
};

/// The engine's answer for one start: the grain begins `start` steps above the plane.
Answer run(const StickCase& c, const Setting& s, double start) {
  DemRig rig;
  const int sand = rig.material(k_density, k_young, k_poisson);
  DemRig::Choice contact{"hertz_mindlin",
                         {{"restitution", c.restitution}, {"friction", c.friction}}};
  if (c.normal == StickCase::Normal::hooke) {
    contact = {"hooke",
               {{"restitution", c.restitution},
                {"friction", c.friction},
                {"normal_stiffness", c.normal_stiffness},
                {"tangential_stiffness_ratio", c.stiffness_ratio}}};
  }
  DemRig::Choice rolling;
  if (c.rolling == StickCase::Rolling::epsd2)
    rolling = {"epsd2", {{"friction", c.rolling_friction}}};
  if (c.rolling == StickCase::Rolling::epsd) {
    rolling = {"epsd", {{"friction", c.rolling_friction}, {"damping_ratio", c.rolling_damping}}};
  }
  rig.laws_of(sand, sand, contact, rolling, s.cohesion);
  rig.diameters = {2.0 * c.radius};
  rig.setup.time.expected_speed = c.speed;
  const double hertz = rig.laws[0].contact->collision_time(c.radius, c.mass(), c.speed);
  if (s.steps_per_contact > 0.0) rig.setup.time.dem_step = hertz / s.steps_per_contact;
  if (s.amplitude == 0.0) {
    rig.setup.domain.min.x = 0.0;
    rig.wall(0, sand);
  } else {
    dust::scenario::BodySpec spec;
    spec.material = sand;
    spec.shape = {.kind = "shape",
                  .name = "box",
                  .values = {Vec3{-0.05, -0.5, -0.5}, Vec3{0.0, 0.5, 0.5}},
                  .path = {},
                  .where = {}};
    rig.bodies.push_back(dust::bodies::make_body(
        rig.setup, spec,
        ModelLoader::make<dust::sdk::Motion>("motion", "oscillate",
                                             {{"amplitude", std::vector<double>{s.amplitude}},
                                              {"frequency", std::vector<double>{s.frequency}},
                                              {"along", std::vector<Vec3>{{0, 1, 0}}}})));
  }
  if (s.largest_diameter > 0.0) rig.diameters.push_back(s.largest_diameter);
  auto dem = rig.make();
  const double x = c.radius + start * c.speed * dem->coarse_step();
  std::vector<NewGrain> grains{
      {.position = {x, 0, 0}, .velocity = {-c.speed, c.tangential, 0}, .diameter = 2.0 * c.radius}};
  if (s.largest_diameter > 0.0) {
    grains.push_back({.position = {0.5, 0.3, 0.3}, .diameter = s.largest_diameter});
  }
  dem->insert(grains);
  Stepper stepper(*dem);
  while (stepper.time() < 4.0 * hertz) stepper.step();
  const GrainState g = grain(*dem, 0);
  REQUIRE(g.velocity.x > 0.0);
  return {{g.velocity.x, g.velocity.y, -c.radius * g.rotation.z}, start * dem->coarse_step()};
}

/// Largest errors over the starts.
struct Errors {
  double patch = 0.0;      ///< [-] of the patch speed, in tangential speeds before the impact
  double energy = 0.0;     ///< [-] of the tangential energy, in its value before
  double mean = 0.0;       ///< [-] mean of the patch speed's
  double root_mean = 0.0;  ///< [-] root mean square of it
};

Errors errors(const StickCase& c, const Setting& s, int starts = k_starts) {
  StickResult exact = integrate(c);
  Errors e;
  for (int n = 0; n < starts; ++n) {
    const auto [r, touch] = run(c, s, 1.0 + (n + 0.5) / starts);
    if (s.amplitude > 0.0) {
      StickCase swinging = c;
      const double rate = 2.0 * std::numbers::pi * s.frequency;
      swinging.wall = [&](double t) { return s.amplitude * rate * std::cos(rate * (t + touch)); };
      exact = integrate(swinging);
    }
    const double patch = (r.patch() - exact.patch()) / c.tangential;
    e.patch = std::max(e.patch, std::abs(patch));
    e.energy =
        std::max(e.energy, std::abs(r.energy() - exact.energy()) / c.tangential / c.tangential);
    e.mean += patch / starts;
    e.root_mean += patch * patch / starts;
  }
  e.root_mean = std::sqrt(e.root_mean);
  return e;
}

struct Named {
  std::string name;
  StickCase c;
  Setting s;
  /// Largest errors at the default step, and the least order of convergence.
  double patch = 0.01, energy = 0.005, order = 1.7;
};

/// Johnson, Kendall, Roberts (1971): with L^3 = 2 pi gamma R^2 / E*, a = L b^2 and d = D L^2 / R,
/// D = b^4 - b, attraction 4 pi gamma R b^3; the neck tears where dD/db = 0, at b^3 = 1/4.
void make_jkr(StickCase& c, double surface_energy) {
  const double r = c.radius;
  const double length =
      std::cbrt(2.0 * std::numbers::pi * surface_energy * r * r / c.effective_young);
  const double unit = length * length / r;
  const double smallest = std::cbrt(0.25);
  c.tear = unit * (std::pow(smallest, 4) - smallest);
  c.adhesion = [=](double d) {
    double low = smallest;
    double high = 10.0;
    for (int n = 0; n < 60; ++n) {
      const double b = 0.5 * (low + high);
      (b * (b * b * b - 1.0) * unit < d ? low : high) = b;
    }
    return StickCase::Adhesion{unit * std::pow(low, 4),
                               4.0 * std::numbers::pi * surface_energy * r * low * low * low};
  };
}

std::vector<Named> cases() {
  std::vector<Named> all;
  const auto add = [&](const std::string& name, auto&& change,
                       const Setting& setting = {}) -> Named& {
    StickCase c = base();
    change(c);
    return all.emplace_back(Named{name, c, setting});
  };
  // Tangential and rolling spring swing together, up to 2.4 times as fast as sqrt(k_t / m), with
  // 0.46 rad per default step; docs/theory/grains.md, eq. (18).
  const auto rolls = [](Named& n) { n.patch = 0.02, n.energy = 0.012; };
  add("hertz_mindlin", [](StickCase&) {});
  // Half a swing per contact, at most as fast as the grain.
  add("hertz_mindlin, on a wall that swings", [](StickCase&) {},
      {.amplitude = 4e-6, .frequency = 4000.0});
  // Sub-steps follow the collision, not the step: their order is not asked for.
  add("hertz_mindlin, sub-stepped", [](StickCase&) {}, {.largest_diameter = 5e-3}).order = 0.0;
  add("hertz_mindlin, epsd2, sub-stepped on a wall that swings",
      [](StickCase& c) { c.rolling = StickCase::Rolling::epsd2; },
      {.amplitude = 4e-6, .frequency = 4000.0, .largest_diameter = 5e-3});
  rolls(all.back());
  all.back().patch = 0.025, all.back().order = 0.0;
  // 2 pi gamma R*: some fifth of the largest force of the impact.
  add("hertz_mindlin, dmt",
      [](StickCase& c) {
        const double pull = 2.0 * std::numbers::pi * 0.2 * c.radius;
        c.adhesion = [pull](double d) { return StickCase::Adhesion{d, pull}; };
      },
      {.cohesion = {"dmt", {{"surface_energy", 0.2}}}});
  // In touch a bridge attracts with 4 pi R* gamma; what it does beyond touch turns nothing.
  add("hertz_mindlin, liquid_bridge",
      [](StickCase& c) {
        const double pull = 4.0 * std::numbers::pi * 0.07 * c.radius;
        c.adhesion = [pull](double d) { return StickCase::Adhesion{d, pull}; };
      },
      {.cohesion = {"liquid_bridge", {{"surface_tension", 0.07}, {"relative_volume", 1e-3}}}});
  add("hertz_mindlin, sjkr",
      [](StickCase& c) {
        const double slope = 1e5 * 2.0 * std::numbers::pi * c.radius;
        c.adhesion = [slope](double d) { return StickCase::Adhesion{d, slope * std::max(d, 0.0)}; };
      },
      {.cohesion = {"sjkr", {{"energy_density", 1e5}}}});
  // JKR's contact begins and ends with a jump of its radius.
  Named& jkr = add("hertz_mindlin, jkr", [](StickCase& c) { make_jkr(c, 0.2); },
                   {.cohesion = {"jkr", {{"surface_energy", 0.2}}}});
  jkr.patch = 0.02, jkr.energy = 0.01, jkr.order = 0.8;
  // A damped contact begins to pull before it ends; then friction has no limit left to hold by.
  for (const double restitution : {0.9, 0.8, 0.5, 0.3}) {
    add("hertz_mindlin, restitution " + std::to_string(restitution).substr(0, 3),
        [&](StickCase& c) { c.restitution = restitution; });
    // The tangential damper is at its bound, 0.04 m* / dt, for most of the contact: less than that
    // lets the densest packing spin (spinning_test.cpp).
    if (restitution < 0.6) all.back().patch = 0.13, all.back().energy = 0.007;
  }
  // The slower the grain rolls, the later does the limit cut its couple off.
  for (const double tangential : {0.1, 0.05, 0.02}) {
    add("hertz_mindlin, epsd2, along " + std::to_string(tangential).substr(0, 4) + " m/s",
        [&](StickCase& c) {
          c.rolling = StickCase::Rolling::epsd2;
          c.tangential = tangential;
        });
    rolls(all.back());
  }
  // From step to step the limit cuts off now more, now less.
  all.back().order = 1.0;
  rolls(add("hertz_mindlin, epsd", [](StickCase& c) { c.rolling = StickCase::Rolling::epsd; }));
  // The dashpot is at its bound, 0.07 I / dt, for most of the contact.
  all.back().patch = 0.06;
  for (const auto rolling : {StickCase::Rolling::epsd2, StickCase::Rolling::epsd}) {
    for (const double restitution : {0.9, 0.6}) {
      const std::string name = rolling == StickCase::Rolling::epsd ? "epsd" : "epsd2";
      add("hertz_mindlin, " + name + ", mu_r 0.3, restitution " +
              std::to_string(restitution).substr(0, 3),
          [&](StickCase& c) {
            c.rolling = rolling;
            c.rolling_friction = 0.3;
            c.restitution = restitution;
          });
      // The couple falls to zero, and begins anew, within a step.
      rolls(all.back());
      if (restitution < 0.9) all.back().patch = 0.05, all.back().order = 1.3;
    }
  }
  add("hooke", [](StickCase& c) { c.normal = StickCase::Normal::hooke; });
  add("hooke, damped", [](StickCase& c) {
    c.normal = StickCase::Normal::hooke;
    c.restitution = 0.8;
  });
  add("hooke, epsd2", [](StickCase& c) {
    c.normal = StickCase::Normal::hooke;
    c.rolling = StickCase::Rolling::epsd2;
  });
  rolls(all.back());
  all.back().order = 1.6;
  return all;
}

}  // namespace

TEST_CASE("an impact that sticks shall end as the law says at the default step") {
  for (const Named& n : cases()) {
    CAPTURE(n.name);
    const Errors e = errors(n.c, n.s);
    MESSAGE(n.name << ": patch speed off by " << 100.0 * e.patch << " %, tangential energy by "
                   << 100.0 * e.energy << " %");
    CHECK(e.patch < n.patch);
    CHECK(e.energy < n.energy);
  }
}

TEST_CASE("no start within a step shall make an impact that sticks end otherwise") {
  // Sixteen starts miss the worst: that an evaluation comes a hair before the end, or does not.
  // With plain last evaluations it was 4 to 24 % of the patch speed.
  constexpr int k_many = 200;
  for (const Named& n : cases()) {
    if (n.s.largest_diameter > 0.0 || n.s.amplitude > 0.0) continue;
    CAPTURE(n.name);
    const Errors e = errors(n.c, n.s, k_many);
    MESSAGE(n.name << ": worst of " << k_many << " starts " << 100.0 * e.patch << " %, mean "
                   << 100.0 * e.mean << " % of the patch speed, energy " << 100.0 * e.energy
                   << " %");
    CHECK(e.patch < 1.1 * n.patch);
    CHECK(std::abs(e.mean) < 0.75 * n.patch);
  }
}

TEST_CASE("impacts that stick shall converge to second order in the step") {
  for (const Named& n : cases()) {
    if (n.order == 0.0) continue;
    CAPTURE(n.name);
    Setting s = n.s;
    s.steps_per_contact = 15.0;
    const double coarse = errors(n.c, s).root_mean;
    s.steps_per_contact = 60.0;
    const double fine = errors(n.c, s).root_mean;
    const double order = 0.5 * std::log2(coarse / fine);
    MESSAGE(n.name << ": order " << order << ", fine " << 100.0 * fine << " %");
    // What is left within a thousandth has no order to speak of: its parts are of either sign.
    CHECK((order > n.order || fine < 1e-3));
  }
}

TEST_CASE("a grain that rocks on its springs shall neither be braked nor driven by the step") {
  // Elastic, no limit reached: tangential and rolling spring exchange energy for ever. A spring
  // that follows the velocity at the end of the step loses a twentieth of its amplitude in each
  // period. What is left, a ten-thousandth, comes from the couple of the step before that the
  // contact law is shown: of third order in the step.
  constexpr double k_kept = 0.05;  // over 400 periods
  DemRig rig;
  const int sand = rig.material(k_density, k_young, k_poisson);
  rig.law(sand, sand, 1.0, base().friction, base().friction);
  rig.diameters = {2.0 * k_radius};
  rig.setup.time.expected_speed = k_speed;
  rig.setup.gravity = {-9.81, 0, 0};
  rig.setup.domain.min.x = 0.0;
  rig.wall(0, sand);
  const StickCase c = base();
  const double overlap =
      std::pow(c.mass() * 9.81 / (4.0 / 3.0 * c.effective_young * std::sqrt(k_radius)), 2.0 / 3.0);
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.position = {k_radius - overlap, 0, 0},
                                     .rotation = {0, 0, 0.1},
                                     .diameter = 2.0 * k_radius}});
  Stepper stepper(*dem);
  // Of the mode that makes 2.36 sqrt(k_t / m).
  const double kt = 8.0 * c.effective_shear * std::sqrt(k_radius * overlap);
  const double period = 2.0 * std::numbers::pi / (2.36 * std::sqrt(kt / c.mass()));
  REQUIRE(period > 30.0 * dem->coarse_step());
  const auto mean_square = [&](double until) {
    double sum = 0.0;
    int count = 0;
    for (; stepper.time() < until; ++count) {
      stepper.step();
      const double w = grain(*dem, 0).rotation.z;
      sum += w * w;
    }
    return sum / count;
  };
  const double early = mean_square(60.0 * period);
  mean_square(400.0 * period);
  const double late = mean_square(460.0 * period);
  CHECK(std::sqrt(late / early) == approx(1.0).epsilon(k_kept));
}
