// SPDX-License-Identifier: Apache-2.0
// The rolling laws beside epsd2 on a plane: closed forms of rolling with a couple mu_r R N.
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_g = 9.81;
constexpr double k_radius = 3e-4;
constexpr double k_density = 2650;
constexpr double k_step = 4e-6;
constexpr double k_mu_r = 0.3;

/// A grain at rest overlap on the plane z = 0 under gravity tilted by `angle` towards +x.
struct Ground {
  DemRig rig;
  std::unique_ptr<dust::particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;
  double stiffness = 0.0;  ///< [N/m] secant, of the normal contact

  Ground(const DemRig::Choice& rolling, double friction, double angle, double speed, double spin,
         double time_step = k_step) {
    const int sand = rig.material(k_density, 50e6, 0.3);
    rig.laws_of(sand, sand, {"hertz_mindlin", {{"restitution", 0.5}, {"friction", friction}}},
                rolling);
    rig.diameters = {2 * k_radius};
    rig.setup.domain.min = {-2, -2, 0};
    rig.setup.domain.max = {2, 2, 2};
    rig.setup.gravity = {k_g * std::sin(angle), 0, -k_g * std::cos(angle)};
    rig.setup.time.dem_step = time_step;
    rig.wall(4, sand);
    dem = rig.make();
    const double load = mass() * k_g * std::cos(angle);
    const double young = 50e6 / (1 - 0.09) / 2;
    const double overlap = std::pow(load / (4.0 / 3.0 * young * std::sqrt(k_radius)), 2.0 / 3.0);
    stiffness = load / overlap;
    dem->insert(std::vector<NewGrain>{{.position = {0, 0, k_radius - overlap},
                                       .velocity = {speed, 0, 0},
                                       .rotation = {0, spin, 0},
                                       .diameter = 2 * k_radius}});
    stepper = std::make_unique<Stepper>(*dem);
  }
  static double mass() {
    return k_density * 4.0 / 3.0 * std::numbers::pi * k_radius * k_radius * k_radius;
  }
  void until(double time) {
    while (stepper->time() < time) stepper->step();
  }
  GrainState now() { return grain(*dem, 0); }
};

DemRig::Choice epsd(double damping_ratio = 0.3) {
  return {"epsd", {{"friction", k_mu_r}, {"damping_ratio", damping_ratio}}};
}
const DemRig::Choice k_cdt{"cdt", {{"friction", k_mu_r}}};

}  // namespace

TEST_CASE("rolling shall decay with 5/7 mu_r g to rest, with epsd as with cdt") {
  constexpr double v0 = 0.2;
  for (const auto& law : {epsd(), k_cdt}) {
    CAPTURE(law.name);
    Ground p(law, 2.0, 0.0, v0, v0 / k_radius);
    p.until(0.05);
    CHECK(p.now().velocity.x == approx(v0 - 5.0 / 7.0 * k_mu_r * k_g * 0.05).epsilon(0.01));
    p.until(0.12);
    // Stop distance 7 v0^2 / (10 mu_r g).
    CHECK(p.now().position.x == approx(0.7 * v0 * v0 / (k_mu_r * k_g)).epsilon(0.01));
    CHECK(std::abs(p.now().velocity.x) < 1e-6);
    CHECK(std::abs(p.now().rotation.y) * k_radius < 1e-6);
  }
}

TEST_CASE("the saturated couple shall slow a spin by 5/2 mu_r g / R, with epsd as with cdt") {
  constexpr double spin = 2000.0;
  for (const auto& law : {epsd(), k_cdt}) {
    CAPTURE(law.name);
    Ground p(law, 0.0, 0.0, 0.0, spin);
    p.until(0.04);
    CHECK(spin - p.now().rotation.y == approx(2.5 * k_mu_r * k_g / k_radius * 0.04).epsilon(0.005));
  }
}

TEST_CASE("epsd shall hold a sphere below tan = mu_r and let it roll above") {
  constexpr double time = 0.05;
  {
    Ground p(epsd(), 2.0, std::atan(0.9 * k_mu_r), 0.0, 0.0);
    p.until(time);
    CHECK(std::abs(p.now().position.x) < 0.01 * k_radius);
    CHECK(std::abs(p.now().velocity.x) < 1e-6);
  }
  const double angle = std::atan(1.5 * k_mu_r);
  Ground p(epsd(), 2.0, angle, 0.0, 0.0);
  p.until(time);
  const double a = 5.0 / 7.0 * k_g * (std::sin(angle) - k_mu_r * std::cos(angle));
  CHECK(p.now().velocity.x == approx(a * time).epsilon(0.01));
}

TEST_CASE("a grain on epsd shall rock with its own period and the declared damping") {
  // I theta'' = -k_r theta - 2 eta sqrt(I k_r) theta', I = 7/5 m R^2 about the contact. The
  // tangential spring of the contact, 1/(2.25 mu_r^2) times as stiff, makes the period longer by
  // less than mu_r^2.
  for (const double eta : {0.05, 0.3}) {
    Ground p(epsd(eta), 2.0, 0.0, 0.0, 0.0);
    const double k_r = 2.25 * p.stiffness * std::pow(k_mu_r * k_radius, 2);
    const double frequency = std::sqrt(k_r / (1.4 * p.mass() * k_radius * k_radius));
    const double period = 2.0 * std::numbers::pi / (frequency * std::sqrt(1.0 - eta * eta));
    // A push far below full mobilisation.
    const double push = 0.2 * frequency * k_mu_r * k_radius * p.mass() * k_g / k_r;
    Ground q(epsd(eta), 2.0, 0.0, push * k_radius, push);
    double last = 1.0;
    std::vector<double> zeros;  // of the rotation's rate
    std::vector<double> peaks;
    double peak = 0.0;
    while (zeros.size() < 4 && q.stepper->time() < 5.0 * period) {
      q.stepper->step();
      const double rate = q.now().rotation.y;
      peak = std::max(peak, std::abs(rate));
      if (rate * last < 0.0) {
        zeros.push_back(q.stepper->time());
        peaks.push_back(peak);
        peak = 0.0;
      }
      last = rate;
    }
    REQUIRE(zeros.size() == 4);
    CAPTURE(eta);
    CHECK(zeros[3] - zeros[1] == approx(period).epsilon(k_mu_r * k_mu_r));
    // Of the logarithm of two peaks a period apart. The tangential spring gives way too, undamped:
    // in row with the rolling one, which it makes softer by up to mu_r^2, it damps by up to the
    // power of 3/2 of that less.
    const double decrement = std::log(peaks[1] / peaks[3]);
    const double damping = decrement / std::hypot(2.0 * std::numbers::pi, decrement);
    CHECK(damping < 1.01 * eta);
    CHECK(damping > eta * std::pow(1.0 + k_mu_r * k_mu_r, -1.5));
  }
}

TEST_CASE("cdt shall creep below its threshold no faster than 20 g sin(theta) dt") {
  const double angle = std::atan(0.5 * k_mu_r);
  // As fast as the step is long: halving it halves the creep. epsd2 stands.
  for (const double time_step : {k_step, 0.5 * k_step}) {
    CAPTURE(time_step);
    Ground p(k_cdt, 2.0, angle, 0.0, 0.0, time_step);
    p.until(0.05);
    CHECK(p.now().velocity.x == approx(20.0 * k_g * std::sin(angle) * time_step).epsilon(0.02));
  }
  const double creep = 20.0 * k_g * std::sin(angle) * k_step;
  Ground q({"epsd2", {{"friction", k_mu_r}}}, 2.0, angle, 0.0, 0.0);
  const double from = q.now().position.x;
  q.until(0.5);
  // The spring sets and swings; what creeps would be 200 times as far.
  CHECK(std::abs(q.now().position.x - from) < 0.005 * creep * 0.5);
}

TEST_CASE("a grain in a corner of three walls shall cease to spin, with epsd as with cdt") {
  // Two of its contacts brake each axis, and their friction does: more than a step of the whole
  // spin between them would turn it about from step to step.
  struct Row {
    DemRig::Choice law;
    double friction;
  };
  for (const double rolling : {0.1, 0.3, 1.0, 3.0}) {
    const Row rows[] = {{{"cdt", {{"friction", rolling}}}, 0.0},
                        {{"cdt", {{"friction", rolling}}}, 0.5},
                        {{"epsd", {{"friction", rolling}, {"damping_ratio", 0.3}}}, 0.5},
                        {{"epsd", {{"friction", rolling}, {"damping_ratio", 1.0}}}, 0.5}};
    for (const auto& [law, friction] : rows) {
      DemRig rig;
      const int stone = rig.material(k_density, 20e6, 0.3);
      rig.laws_of(stone, stone, {"hertz_mindlin", {{"restitution", 0.5}, {"friction", friction}}},
                  law);
      constexpr double radius = 5e-3;
      rig.diameters = {2 * radius};
      rig.setup.domain.min = {0, 0, 0};
      rig.setup.gravity = {-5.66, -5.66, -5.66};
      rig.setup.time.expected_speed = 0.1;
      for (const int side : {0, 2, 4}) rig.wall(side, stone);
      auto dem = rig.make();
      dem->insert(std::vector<NewGrain>{
          {.position = {radius, radius, radius}, .rotation = {10, 7, -3}, .diameter = 2 * radius}});
      Stepper stepper(*dem);
      while (stepper.time() < 0.4) stepper.step();
      CAPTURE(law.name);
      CAPTURE(rolling);
      CAPTURE(friction);
      CHECK(norm(grain(*dem, 0).rotation) < 1e-6);
    }
  }
}
