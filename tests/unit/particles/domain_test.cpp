// SPDX-License-Identifier: Apache-2.0
// What happens at the sides of the domain, and the contacts as sensors see them.
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace dust;
using namespace dust::test;
using particles::NewGrain;
using sdk::Vec3;

namespace {

constexpr double k_diameter = 1e-3;

NewGrain grain_at(Vec3 place, Vec3 velocity = {}) {
  NewGrain g;
  g.position = place;
  g.velocity = velocity;
  g.diameter = k_diameter;
  return g;
}

/// A cube of 8 mm with its lower corner in the origin.
DemRig cube() {
  DemRig rig;
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {8e-3, 8e-3, 8e-3};
  rig.material(2650.0, 5e7, 0.3);
  rig.law(0, 0, 0.7, 0.4, 0.1);
  rig.diameters = {k_diameter};
  return rig;
}

struct Pair {
  GrainState a, b;
};

/// Two spinning grains that meet obliquely at `middle`, after the collision.
Pair collide(Vec3 middle, const std::vector<int>& periodic) {
  DemRig rig = cube();
  for (const int axis : periodic) rig.periodic(axis);
  const auto dem = rig.make();
  const Vec3 line = Vec3{1, 0.8, 0.6} / std::sqrt(2.0);
  NewGrain a = grain_at(middle - 0.52e-3 * line, 0.3 * line + Vec3{0, 0, 0.05});
  NewGrain b = grain_at(middle + 0.52e-3 * line, -0.3 * line);
  a.rotation = {20, -30, 10};
  // The second one enters where its image lies in the domain.
  for (int d = 0; d < 3; ++d) {
    for (double* x : {&a.position[d], &b.position[d]}) {
      if (*x < 0.0) *x += 8e-3;
      if (*x >= 8e-3) *x -= 8e-3;
    }
  }
  dem->insert(std::vector{a, b});
  Stepper stepper(*dem);
  while (stepper.time() < 2e-3) stepper.step();
  return {grain(*dem, 0), grain(*dem, 1)};
}

}  // namespace

TEST_CASE("a collision across periodic sides shall be the same as one within the domain") {
  const Pair inside = collide({4e-3, 4e-3, 4e-3}, {});
  // They have collided: the speeds along the line are turned round.
  REQUIRE(dot(inside.a.velocity, Vec3{1, 0.8, 0.6}) < 0.0);
  struct Case {
    Vec3 middle;
    std::vector<int> periodic;
  };
  for (const Case& c :
       {Case{{0, 4e-3, 4e-3}, {0}}, Case{{4e-3, 8e-3, 4e-3}, {1}}, Case{{4e-3, 4e-3, 0}, {2}},
        Case{{0, 8e-3, 4e-3}, {0, 1}}, Case{{8e-3, 4e-3, 0}, {0, 2}}, Case{{0, 0, 0}, {0, 1, 2}}}) {
    CAPTURE(c.middle.x);
    CAPTURE(c.middle.y);
    CAPTURE(c.middle.z);
    const Pair across = collide(c.middle, c.periodic);
    // Only the rounding of places differs: 1e-18 m of an overlap of 1e-5 m.
    const double tolerance = 1e-9;
    CHECK(norm(across.a.velocity - inside.a.velocity) < tolerance * 0.3);
    CHECK(norm(across.b.velocity - inside.b.velocity) < tolerance * 0.3);
    CHECK(norm(across.a.rotation - inside.a.rotation) < tolerance * 40);
    CHECK(norm(across.b.rotation - inside.b.rotation) < tolerance * 40);
  }
}

TEST_CASE("grains between close periodic sides shall meet by whichever image comes first") {
  // Two on a ring of four diameters, or of five and a half, rebound by one image and by the other
  // in turn. Elastic: one that is not seen in time sinks in, and leaves with another speed.
  for (const double period : {4e-3, 5.5e-3}) {
    for (const double speed : {0.3, 3.0, 10.0}) {
      DemRig rig;
      rig.setup.domain.min = {0, 0, 0};
      rig.setup.domain.max = {period, 8e-3, 8e-3};
      rig.material(2650.0, 5e7, 0.3);
      rig.law(0, 0, 1.0, 0.0);
      rig.diameters = {k_diameter};
      rig.setup.time.expected_speed = 10.0;
      rig.periodic(0);
      const auto dem = rig.make();
      dem->insert(std::vector{grain_at({1e-3, 4e-3, 4e-3}, {-speed, 0, 0}),
                              grain_at({2.95e-3, 4e-3, 4e-3}, {speed, 0, 0})});
      Stepper stepper(*dem);
      double first_overlap = 0.0;
      double overlap = 0.0;
      const double between = (period - 2.0 * k_diameter) / (2.0 * speed);
      while (stepper.time() < 100.0 * between) {
        stepper.step();
        double& most = stepper.time() < 2.0 * between ? first_overlap : overlap;
        most = std::max(most, dem->report().largest_overlap);
      }
      CAPTURE(period);
      CAPTURE(speed);
      CHECK(first_overlap > 0.0);
      CHECK(overlap < 1.05 * first_overlap);
      CHECK(std::abs(grain(*dem, 0).velocity.x) == test::approx(speed).epsilon(0.02));
    }
  }
}

TEST_CASE("a grain that passes a periodic side shall come back on the other, and not be lost") {
  DemRig rig = cube();
  for (int axis = 0; axis < 3; ++axis) rig.periodic(axis);
  const auto dem = rig.make();
  const Vec3 velocity{1.1, -0.9, 1.3};
  dem->insert(std::vector{grain_at({4e-3, 4e-3, 4e-3}, velocity)});
  Stepper stepper(*dem);
  while (stepper.time() < 0.05) {
    stepper.step(20);
    dem->remove_escaped();
  }
  CHECK(dem->balance().in_domain == 1);
  const Vec3 off = grain(*dem, 0).position - Vec3{4e-3, 4e-3, 4e-3} - stepper.time() * velocity;
  for (int d = 0; d < 3; ++d) {
    // A whole number of domains away, to the rounding of the steps.
    CHECK(std::abs(off[d] / 8e-3 - std::round(off[d] / 8e-3)) < 1e-9);
  }
}

TEST_CASE("what leaves through any open side shall be booked, with its mass") {
  for (int side = 0; side < 6; ++side) {
    CAPTURE(side);
    DemRig rig = cube();
    const auto dem = rig.make();
    Vec3 velocity;
    velocity[side / 2] = side % 2 == 0 ? -2.0 : 2.0;
    dem->insert(std::vector{grain_at({4e-3, 4e-3, 4e-3}, velocity), grain_at({6e-3, 6e-3, 6e-3})});
    Stepper stepper(*dem);
    while (stepper.time() < 5e-3) {
      stepper.step(10);
      dem->remove_escaped();
    }
    const auto& b = dem->balance();
    CHECK(b.emitted == 2);
    CHECK(b.in_domain == 1);
    CHECK(b.left == 1);
    const double mass = 2650.0 * std::numbers::pi / 6 * 1e-9;
    CHECK(b.mass_left == test::approx(mass).epsilon(1e-14));
    CHECK(b.mass_emitted == test::approx(b.mass_in_domain + b.mass_left).epsilon(1e-14));
  }
}

TEST_CASE("a lost grain shall be told with id, place, velocity and its last contact") {
  DemRig rig = cube();
  rig.wall(4, 0);
  const auto dem = rig.make();
  // The first one rests on the second; then it is wholly beyond the floor.
  dem->insert(std::vector{grain_at({4e-3, 4e-3, 2e-3}), grain_at({4e-3, 4e-3, 2.99e-3})});
  Stepper stepper(*dem);
  stepper.step(2);
  const auto rows = dem->rows();
  for (std::size_t n = 0; n < rows.count; ++n) {
    if (rows.id[n] == 0) const_cast<double*>(rows.position)[4 * n + 2] = -0.6e-3;
  }
  std::string text;
  try {
    dem->remove_escaped();
  } catch (const sdk::ModelError& e) {
    text = e.what();
  }
  CAPTURE(text);
  CHECK(text.find("grain 0 (diameter 0.001 m, m0) left the domain through the wall 'bottom'") == 0);
  CHECK(text.find("position (0.004, 0.004, -0.0006) m") != std::string::npos);
  CHECK(text.find("velocity (") != std::string::npos);
  CHECK(text.find("last known contact: grain 1; nearest surface: bottom, its centre is 0.0006 m "
                  "inside; likely cause: the time step is too long") != std::string::npos);
}

TEST_CASE("contacts shall be shown to sensors with their forces, also at walls and through sides") {
  // At rest: F = 4/3 E* sqrt(R*) overlap^1.5 with E* = E / (2 (1 - nu^2)).
  const double e = 5e7 / (2 * (1 - 0.09));
  const auto hertz = [&](double radius, double overlap) {
    return 4.0 / 3.0 * e * std::sqrt(radius) * std::pow(overlap, 1.5);
  };
  DemRig rig = cube();
  rig.periodic(0);
  rig.wall(4, 0);
  const auto dem = rig.make();
  const double overlap = 4e-6;
  dem->insert(std::vector{grain_at({8e-3 - 0.4e-3, 4e-3, 4e-3}),
                          grain_at({0.6e-3 - overlap, 4e-3, 4e-3}),
                          grain_at({4e-3, 4e-3, 0.5e-3 - overlap}), grain_at({4e-3, 6e-3, 4e-3})});
  dem->neighbours();
  const auto contacts = dem->contacts(0.0);
  REQUIRE(contacts.size() == 2);
  const auto rows = dem->rows();
  int pairs = 0;
  for (const auto& c : contacts) {
    CHECK(c.overlap == test::approx(overlap).epsilon(1e-9));
    if (c.row_j < 0) {
      CHECK(rows.id[c.row_i] == 2);
      CHECK(c.force.z == test::approx(hertz(0.5e-3, overlap)).epsilon(1e-9));
      CHECK(c.branch.z == test::approx(-0.5e-3 + 0.5 * overlap).epsilon(1e-9));
      continue;
    }
    ++pairs;
    CHECK(rows.id[c.row_i] == 0);
    CHECK(rows.id[c.row_j] == 1);
    CHECK(c.force.x == test::approx(-hertz(0.25e-3, overlap)).epsilon(1e-9));
    CHECK(c.branch.x == test::approx(1e-3 - overlap).epsilon(1e-9));
  }
  CHECK(pairs == 1);
}

TEST_CASE("contacts of grains of different weights shall be shown as the step will find them") {
  DemRig rig = cube();
  const auto dem = rig.make();
  std::vector<NewGrain> grains{grain_at({3.503e-3, 4e-3, 4e-3}), grain_at({4.5e-3, 4e-3, 4e-3})};
  grains[0].velocity = {0.4, 0.05, 0};
  grains[1].weight = 0.02;
  dem->insert(grains);
  dem->neighbours();
  const auto contacts = dem->contacts(0.0);
  REQUIRE(contacts.size() == 1);
  dem->contact(0.0, true);
  dem->force();
  dem->integrate();
  dem->advance_fine();
  // The light one feels all of the force, which the damping makes one of its own mass.
  const auto rows = dem->rows();
  const std::int32_t light = rows.id[0] == 1 ? 0 : 1;
  const double sign = contacts[0].row_i == light ? 1.0 : -1.0;
  const auto force = dem->last_force();
  for (int d = 0; d < 3; ++d) {
    CAPTURE(d);
    CHECK(sign * contacts[0].force[d] ==
          test::approx(force[static_cast<std::size_t>(4 * light + d)]).epsilon(1e-12));
  }
  CHECK(contacts[0].force.x != 0.0);
  CHECK(contacts[0].force.y != 0.0);
}

TEST_CASE("looking at contacts shall not change the run") {
  const auto run = [](bool looks) {
    DemRig rig = cube();
    rig.setup.gravity = {0, 0, -9.81};
    rig.wall(4, 0);
    const auto dem = rig.make();
    std::vector<NewGrain> grains;
    for (int n = 0; n < 27; ++n) {
      grains.push_back(grain_at(
          {1.5e-3 + 1.05e-3 * (n % 3), 1.5e-3 + 1.02e-3 * (n / 3 % 3), 0.6e-3 + 1.01e-3 * (n / 9)},
          {0.1 * std::sin(n), 0.1 * std::cos(n), -0.2}));
    }
    dem->insert(grains);
    Stepper stepper(*dem);
    for (int n = 0; n < 100; ++n) {
      stepper.step(10);
      if (looks)
        CHECK(dem->contacts(stepper.time()).size() <= 200);
      else
        dem->synchronise();  // a look brings all grains to the present time, as every sample does
    }
    Vec3 sum;
    for (int n = 0; n < 27; ++n) sum += (n + 1.0) * grain(*dem, n).position;
    return sum;
  };
  CHECK(run(true) == run(false));
}
