// SPDX-License-Identifier: Apache-2.0
#include "support/dem_rig.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_rounding = 1e-12;

/// Two grains that meet, after the collision.
std::vector<GrainState> collide(std::vector<NewGrain> grains, Vec3 shift = {},
                                bool across = false) {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.7, 0.4, 0.2);
  rig.diameters = {600e-6};
  rig.setup.domain.min = {-5e-3, -5e-3, -5e-3};
  rig.setup.domain.max = {5e-3, 5e-3, 5e-3};
  rig.setup.time.dem_step = 1e-6;
  for (int d = 0; d < 3; ++d) rig.periodic(d);
  for (NewGrain& g : grains) {
    g.position += shift;
    if (!across) continue;
    for (int d = 0; d < 3; ++d) {
      if (g.position[d] > 5e-3) g.position[d] -= 1e-2;
    }
  }
  auto dem = rig.make();
  dem->insert(grains);
  Stepper stepper(*dem);
  stepper.step(400);
  REQUIRE(dem->report().largest_overlap > 1e-4);
  REQUIRE(dem->report().contacts == 0);
  std::vector<GrainState> out;
  for (std::size_t n = 0; n < grains.size(); ++n)
    out.push_back(grain(*dem, static_cast<std::int64_t>(n)));
  return out;
}

std::vector<NewGrain> pair() {
  return {{.position = {-2.1e-4, 3e-5, 1e-5},
           .velocity = {0.5, 0.1, -0.2},
           .rotation = {30, -400, 90},
           .diameter = 400e-6},
          {.position = {3.1e-4, -9e-5, 2e-5},
           .velocity = {-0.6, 0.0, 0.1},
           .rotation = {-50, 10, 700},
           .diameter = 600e-6}};
}

double inertia(const GrainState& g) { return 0.4 * g.mass * g.radius * g.radius; }

}  // namespace

TEST_CASE("an oblique collision shall keep linear and angular momentum") {
  const auto in = pair();
  const auto out = collide(in);
  Vec3 p0, p1, l0, l1;
  double scale_p = 0, scale_l = 0;
  for (std::size_t n = 0; n < 2; ++n) {
    const double m = out[n].mass;
    p0 += m * in[n].velocity;
    p1 += m * out[n].velocity;
    l0 += m * cross(in[n].position, in[n].velocity) + inertia(out[n]) * in[n].rotation;
    l1 += m * cross(out[n].position, out[n].velocity) + inertia(out[n]) * out[n].rotation;
    scale_p += m * norm(in[n].velocity);
    scale_l +=
        m * norm(in[n].position) * norm(in[n].velocity) + inertia(out[n]) * norm(in[n].rotation);
  }
  CHECK(norm(out[0].velocity - in[0].velocity) > 0.1);
  CHECK(norm(p1 - p0) < k_rounding * scale_p);
  CHECK(norm(l1 - l0) < k_rounding * scale_l);
}

TEST_CASE("a collision shall not depend on mirror, rotation, uniform velocity or periodic side") {
  constexpr double k_transformed = 1e-10;
  const auto plain = collide(pair());
  {
    auto in = pair();
    for (NewGrain& g : in) {
      g.position.y = -g.position.y, g.velocity.y = -g.velocity.y;
      g.rotation.x = -g.rotation.x, g.rotation.z = -g.rotation.z;
    }
    const auto out = collide(in);
    CHECK(std::abs(out[0].velocity.y + plain[0].velocity.y) < k_transformed);
    CHECK(std::abs(out[0].rotation.z + plain[0].rotation.z) < k_transformed * 700);
  }
  {
    const Vec3 axis = Vec3{1, 2, -0.5} / norm(Vec3{1, 2, -0.5});
    auto in = pair();
    for (NewGrain& g : in) {
      g.position = rotate(g.position, axis, 1.1);
      g.velocity = rotate(g.velocity, axis, 1.1);
      g.rotation = rotate(g.rotation, axis, 1.1);
    }
    const auto out = collide(in);
    CHECK(norm(rotate(out[1].velocity, axis, -1.1) - plain[1].velocity) < k_transformed);
    CHECK(norm(rotate(out[1].rotation, axis, -1.1) - plain[1].rotation) < k_transformed * 700);
  }
  {
    auto in = pair();
    for (NewGrain& g : in) g.velocity += Vec3{3, -2, 1};
    const auto out = collide(in);
    CHECK(norm(out[0].velocity - Vec3{3, -2, 1} - plain[0].velocity) < k_transformed);
  }
  {
    const auto out = collide(pair(), {5e-3, 5e-3, 5e-3}, true);
    CHECK(norm(out[0].velocity - plain[0].velocity) < k_transformed);
    CHECK(norm(out[1].rotation - plain[1].rotation) < k_transformed * 700);
  }
}

TEST_CASE("the bits shall not depend on the number of threads") {
  const auto run = [](std::size_t threads) {
    oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                        threads);
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.5, 0.5, 0.3);
    rig.diameters = {10e-6, 400e-6, 600e-6};
    rig.setup.gravity = {0, 0, -500};
    rig.setup.domain.min = {0, 0, 0};
    rig.setup.domain.max = {9e-3, 9e-3, 2e-2};
    for (int s = 0; s < 5; ++s) rig.wall(s, sand);
    std::vector<NewGrain> grains;
    const dust::sdk::Random random(11, 1);
    for (std::uint64_t n = 0; n < 1500; ++n) {
      const bool is_dust = n % 5 == 4;
      grains.push_back(
          {.position = {7e-4 * (static_cast<double>(n % 12) + 0.7 + 0.1 * random.uniform(n, 0)),
                        7e-4 * (static_cast<double>(n / 12 % 12) + 0.7),
                        7e-4 * (static_cast<double>(n / 144) + 0.6)},
           .velocity = {0, 0.1 * random.uniform(n, 1), -0.3},
           .diameter = is_dust      ? 10e-6
                       : n % 2 == 0 ? 400e-6
                                    : 600e-6,
           .weight = is_dust ? 0.05 : 1.0});
    }
    auto dem = rig.make();
    dem->insert(grains);
    Stepper stepper(*dem);
    stepper.step(1200);
    REQUIRE(dem->report().contacts > 100);
    std::vector<double> out;
    for (std::int64_t n = 0; n < 1500; ++n) {
      const GrainState g = grain(*dem, n);
      out.insert(out.end(), {g.position.x, g.position.y, g.position.z, g.velocity.x, g.rotation.y});
    }
    return out;
  };
  CHECK(run(1) == run(2));
}

TEST_CASE("a free grain shall fly the exact parabola and an open side shall book it") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5);
  rig.diameters = {600e-6};
  rig.setup.gravity = {0, 0, -9.81};
  rig.setup.domain.min = {-1, -1, -0.01};
  auto dem = rig.make();
  dem->insert(std::vector<NewGrain>{{.velocity = {0.8, 0, 0}, .diameter = 600e-6},
                                    {.position = {0, 0, 0.5}, .diameter = 600e-6, .weight = 0.5}});
  Stepper stepper(*dem);
  stepper.step(2000);
  const double t = stepper.time();
  CHECK(grain(*dem, 0).position.z == approx(-0.5 * 9.81 * t * t).epsilon(1e-9));
  CHECK(grain(*dem, 0).velocity.z == approx(-9.81 * t).epsilon(1e-9));
  while (grain(*dem, 0).position.z > -0.01) stepper.step(500);
  dem->remove_escaped();
  const auto& b = dem->balance();
  CHECK(b.emitted == 2);
  CHECK(b.left == 1);
  CHECK(b.in_domain == 1);
  CHECK(b.real_emitted == approx(1.5));
  CHECK(b.mass_emitted == b.mass_in_domain + b.mass_left + b.mass_removed);
  stepper.step(10);
}

TEST_CASE("buoyancy shall reduce the weight and drag shall be integrated exactly") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5);
  rig.diameters = {10e-6, 600e-6};
  rig.setup.gravity = {0, 0, -9.81};
  rig.options.fluid_density = 1000.0;
  rig.has_fluid = true;
  auto dem = rig.make();
  for (const double d : {10e-6, 600e-6})
    dem->insert(std::vector<NewGrain>{{.position = {d, 0, 0}, .diameter = d}});
  dem->neighbours();
  auto rows = dem->rows();
  const double rate = 1.0 / 0.82e-3;
  for (std::size_t n = 0; n < 2; ++n) {
    rows.drag_relaxation[4 * n] = 0.3;
    rows.drag_relaxation[4 * n + 3] = rate;
  }
  dem->drag_relaxation_changed();
  Stepper stepper(*dem);
  stepper.step(1000);
  const double t = stepper.time();
  const double g = 9.81 * (1.0 - 1000.0 / 2650.0);
  for (std::int64_t n = 0; n < 2; ++n) {
    const GrainState s = grain(*dem, n);
    CHECK(s.velocity.x == approx(0.3 * (1 - std::exp(-rate * t))).epsilon(1e-5));
    CHECK(s.velocity.z == approx(-g / rate * (1 - std::exp(-rate * t))).epsilon(1e-5));
  }
  // Momentum = impulse of the fluid + weight, each taken at the kick half a step after t.
  rows = dem->rows();
  for (std::size_t n = 0; n < 2; ++n) {
    const double mass = rows.mass(n);
    const double half = stepper.time() - 0.5 * dem->coarse_step();
    const double expected = 0.3 * (1 - std::exp(-rate * half));
    CHECK(rows.fluid_impulse[4 * n] / mass == approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("dust pressed into a wall shall come back out, and be lost only when wholly beyond") {
  for (const double depth : {0.3e-6, 5.1e-6}) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.9, 0.0);
    rig.diameters = {10e-6, 600e-6};
    rig.wall(2, sand);
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{{.position = {0, -1.0 - depth, 0}, .diameter = 10e-6}});
    CAPTURE(depth);
    if (depth > 5e-6) {
      CHECK_THROWS_WITH_AS(dem->remove_escaped(), doctest::Contains("through the wall 'front'"),
                           dust::sdk::ModelError);
      continue;
    }
    dem->remove_escaped();
    Stepper stepper(*dem);
    stepper.step(200);
    dem->remove_escaped();
    CHECK(grain(*dem, 0).position.y > -1.0 + 5e-6);
    CHECK(dem->report().largest_overlap > 1.0);
    CHECK(dem->balance().in_domain == 1);
  }
}

TEST_CASE("a grain that goes astray shall be named") {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.5);
  rig.diameters = {600e-6};
  rig.setup.time.dem_step = 1e-4;  // far too long
  auto dem = rig.make();
  dem->insert(
      std::vector<NewGrain>{{.diameter = 600e-6}, {.position = {3e-4, 0, 0}, .diameter = 600e-6}});
  Stepper stepper(*dem);
  try {
    stepper.step(100);
    FAIL("no error");
  } catch (const dust::sdk::ModelError& e) {
    const std::string text = e.what();
    CHECK(text.find("grain ") != std::string::npos);
    CHECK(text.find("time.dem_step") != std::string::npos);
  }
}

TEST_CASE("a small sphere resting on a large one shall stay at rest under static friction") {
  // Vyas et al., Comput. Phys. Commun. 310 (2025) 109524: with half-step-old velocities in the
  // forces a pair beyond a size ratio of 3 starts to move by itself.
  for (const double ratio : {6.0, 60.0}) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 0.5, 0.5);
    const double small = 600e-6 / ratio;
    rig.diameters = {small, 600e-6};
    rig.setup.time.rates_single = true;
    rig.setup.gravity = {0, 0, -9.81};
    rig.setup.domain.min = {-1, -1, 0};
    rig.wall(4, sand);
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = {0, 0, 3e-4}, .diameter = 600e-6},
        // A push along the surface: it may roll, but the spin follows the speed and nothing grows.
        {.position = {0, 0, 6e-4 + 0.5 * small}, .velocity = {1e-4, 0, 0}, .diameter = small}});
    Stepper stepper(*dem);
    stepper.step(20000);
    const GrainState s = grain(*dem, 1);
    const GrainState l = grain(*dem, 0);
    const double slip =
        s.velocity.x - s.radius * s.rotation.y - (l.velocity.x + l.radius * l.rotation.y);
    CAPTURE(ratio);
    CHECK(std::abs(slip) < 2e-6);
    CHECK(std::abs(s.velocity.y) < 1e-9);
    CHECK(std::abs(s.velocity.x) < 3e-4);
    CHECK(s.position.z > 6e-4);
  }
}
