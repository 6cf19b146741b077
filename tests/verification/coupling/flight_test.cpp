// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace {

using namespace dust;
using test::World;

/// Still or streaming gas without feedback, one grain, one law.
struct Flight {
  explicit Flight(World::Choice choice) : world(one_way(std::move(choice))) {
    world.setup.gravity = {0, 0, -9.81};
    world.restart();
  }

  static World::Choice one_way(World::Choice choice) {
    choice.is_one_way = true;
    choice.min = {-10, -10, -10};
    choice.max = {10, 10, 10};
    choice.cells = {4, 4, 4};
    return choice;
  }
  /// One interval between two refreshes, never longer than `longest`.
  double advance(double longest, sdk::Vec3 gravity) {
    if (elapsed_ == 0) world.begin_step(world.choice.fluid_step);
    const double step = std::min(longest, world.coupling->refresh_interval());
    world.refresh({world.velocity, world.stress, nullptr, 0.0, step});
    world.grains.move(step, gravity);
    elapsed_ = 1;
    return step;
  }
  void run(double time, double interval, sdk::Vec3 gravity) {
    const int steps = static_cast<int>(std::lround(time / interval));
    for (int n = 0; n < steps; ++n) advance(time / steps, gravity);
  }

  World world;
  int elapsed_ = 0;
};

sdk::Vec3 reduced_gravity(double g, double fluid_density, double density) {
  return {0, 0, -g * (1.0 - fluid_density / density)};
}

double stokes(double, double) { return 1.0; }

TEST_CASE("grains shall fall at the tabulated terminal velocities") {
  struct Row {
    double diameter, speed;
  };
  // Sand in air, Schiller and Naumann (terminal_velocity.csv).
  for (const Row row : {Row{1e-5, 0.00798683}, Row{3e-4, 2.32025}, Row{6e-4, 4.527}}) {
    World::Choice choice;
    choice.drag = "wen_yu";
    Flight flight(choice);
    flight.world.grains.add({0, 0, 9}, {}, row.diameter);
    constexpr double k_long = 6.0;  // s, ten and more relaxation times
    flight.run(k_long, 1e-3, reduced_gravity(9.81, test::k_air, test::k_sand));
    CHECK(-flight.world.grains.velocity[2] == test::approx(row.speed).epsilon(1e-3));
  }
}

TEST_CASE("V-TERM-1: a grain shall fall at the terminal velocity of each drag law") {
  struct Row {
    const char* law;
    double fine, coarse;  // of 0.01 and 0.3 mm
  };
  // Sand in air (terminal_velocity.csv); Di Felice is Dallavalle for a lone sphere.
  const Row rows[] = {{"stokes", 0.00801994, 7.21794},    {"schiller_naumann", 0.00798683, 2.32025},
                      {"abraham", 0.00789232, 2.33416},   {"di_felice", 0.00819344, 2.15694},
                      {"koch_hill", 0.00801797, 2.31436}, {"beetstra", 0.00801731, 2.24063}};
  for (const Row& row : rows) {
    CAPTURE(row.law);
    for (const bool is_fine : {true, false}) {
      World::Choice choice;
      choice.drag = row.law;
      Flight flight(choice);
      flight.world.grains.add({0, 0, 9}, {}, is_fine ? 1e-5 : 3e-4);
      // Stokes' drag alone lets 0.3 mm fall for 9 relaxation times of 0.74 s: e^-9 short.
      flight.run(is_fine ? 0.1 : 6.6, 1e-3, reduced_gravity(9.81, test::k_air, test::k_sand));
      CHECK(-flight.world.grains.velocity[2] ==
            test::approx(is_fine ? row.fine : row.coarse).epsilon(1e-3));
    }
  }
}

TEST_CASE("a grain in rising gas shall follow the known transient") {
  World::Choice choice;
  choice.drag = "wen_yu";
  choice.density = 1.2;
  Flight flight(choice);
  flight.world.set(flight.world.velocity, [](sdk::Vec3) { return sdk::Vec3{0, 0, 0.40}; });
  flight.world.grains.add({0, 0, 0}, {}, 1e-4, 2000);
  const sdk::Vec3 g = reduced_gravity(9.80665, 1.2, 2000);
  constexpr double k_tolerance = 1e-4;
  constexpr double k_interval = 2e-5;
  flight.run(0.01, k_interval, g);
  CHECK(flight.world.grains.velocity[2] == test::approx(-0.0125526).epsilon(k_tolerance));
  flight.run(0.09, k_interval, g);
  CHECK(flight.world.grains.velocity[2] == test::approx(-0.0526313).epsilon(k_tolerance));
  CHECK(flight.world.grains.position[2] == test::approx(-3.61878e-3).epsilon(k_tolerance));
  flight.run(0.25, k_interval, g);
  CHECK(flight.world.grains.velocity[2] == test::approx(-0.0573925).epsilon(k_tolerance));
}

TEST_CASE("Stokes drag shall be integrated exactly, however long the step") {
  constexpr double k_exact = 1e-6;
  for (const double diameter : {5e-6, 1e-5, 1e-4}) {
    World::Choice choice;
    choice.factor = stokes;
    Flight flight(choice);
    flight.world.grains.add({0, 0, 0}, {2.0, 0, 0}, diameter);
    const double tau = test::k_sand * diameter * diameter / (18 * 1.8e-5);
    double time = 0.0;
    for (int n = 0; n < 40; ++n) time += flight.advance(1e-3, {0, 0, -9.81});
    const double* p = flight.world.grains.position.data();
    const double* v = flight.world.grains.velocity.data();
    const double decay = std::exp(-time / tau);
    CHECK(v[2] == test::approx(-9.81 * tau * (1 - decay)).epsilon(k_exact));
    CHECK(p[0] == test::approx(2.0 * tau * (1 - decay)).epsilon(k_exact));
    CHECK(p[2] == test::approx(-9.81 * tau * (time - tau * (1 - decay))).epsilon(k_exact));
  }
}

TEST_CASE("a grain at rest that a law of beds gives no drag shall fall as if in nothing") {
  for (const bool has_company : {false, true}) {
    World::Choice choice;
    choice.factor = [](double reynolds, double) { return 1e-3 * reynolds; };
    Flight flight(choice);
    if (has_company) flight.world.grains.add({1, 0, 0}, {0, 0, -1}, 5e-4);
    flight.world.grains.add({0, 0, 0}, {}, 5e-4);
    const std::size_t row = has_company ? 1 : 0;
    double time = 0.0;
    for (int n = 0; n < 5; ++n) time += flight.advance(2e-4, {0, 0, -9.81});
    CHECK(flight.world.grains.velocity[4 * row + 2] == test::approx(-9.81 * time).epsilon(1e-3));
  }
}

TEST_CASE("a fall with a constant drag coefficient shall be a hyperbolic tangent") {
  constexpr double k_c_d = 0.44;
  World::Choice choice;
  choice.factor = [](double reynolds, double) { return k_c_d / 24.0 * reynolds + 1e-12; };
  const double diameter = 6e-4;
  const sdk::Vec3 gravity = reduced_gravity(9.81, test::k_air, test::k_sand);
  const double g = norm(gravity);
  const double terminal = std::sqrt(4 * g * diameter * test::k_sand / (3 * k_c_d * test::k_air));
  const double time = 0.5;
  double last = 0.0;
  for (const double interval : {4e-4, 2e-4, 1e-4}) {
    Flight flight(choice);
    flight.world.grains.add({0, 0, 0}, {}, diameter);
    flight.run(time, interval, gravity);
    const double expected = -terminal * std::tanh(g * time / terminal);
    const double error = std::abs(flight.world.grains.velocity[2] / expected - 1);
    CHECK(error < 1e-3);
    // The coefficient is that of the middle of the interval: second order.
    if (last > 0.0) CHECK(last / error == test::approx(4.0).epsilon(0.1));
    last = error;
  }
}

/// A grain in a flow that changes evenly along each direction, which the faces hold exactly, by
/// Runge and Kutta's fourth order with tiny steps: nothing of the coupling is in it but the law.
struct Reference {
  const World& world;
  std::array<sdk::Vec3, 4> flow;  ///< at the origin, and its change along x, y, z [m/s, 1/s]
  sdk::Vec3 gravity;
  double diameter = 0.0;
  sdk::Vec3 x{}, v{};

  [[nodiscard]] sdk::Vec3 acceleration(sdk::Vec3 place, sdk::Vec3 velocity) const {
    const sdk::Vec3 slip =
        flow[0] + place.x * flow[1] + place.y * flow[2] + place.z * flow[3] - velocity;
    const double mass = test::k_sand * sdk::sphere_volume(diameter);
    double reynolds = norm(slip) * diameter * test::k_air / test::k_air_viscosity;
    double void_fraction = 1.0;
    double factor = 0.0;
    world.drag->evaluate({1, &reynolds, &void_fraction, &factor, nullptr});
    const double k = 3.0 * std::numbers::pi * test::k_air_viscosity * diameter * factor;
    return (k / mass) * slip + gravity;
  }
  void run(double time, int steps) {
    const double h = time / steps;
    for (int n = 0; n < steps; ++n) {
      const sdk::Vec3 v1 = v;
      const sdk::Vec3 a1 = acceleration(x, v1);
      const sdk::Vec3 v2 = v + 0.5 * h * a1;
      const sdk::Vec3 a2 = acceleration(x + 0.5 * h * v1, v2);
      const sdk::Vec3 v3 = v + 0.5 * h * a2;
      const sdk::Vec3 a3 = acceleration(x + 0.5 * h * v2, v3);
      const sdk::Vec3 v4 = v + h * a3;
      const sdk::Vec3 a4 = acceleration(x + h * v3, v4);
      x += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
  }
};

/// A flight with a refresh in every fluid step at least, and its error.
struct FlightResult {
  double interval;  ///< [s] between refreshes
  double error;     ///< of the place at the end, over the way
};
FlightResult run_flight(const std::string& law, double diameter, double fluid_step, double time,
                        const std::array<sdk::Vec3, 4>& flow) {
  World::Choice choice;
  choice.drag = law;
  choice.fluid_step = fluid_step;
  Flight flight(choice);
  World& world = flight.world;
  world.set(world.velocity,
            [&](sdk::Vec3 p) { return flow[0] + p.x * flow[1] + p.y * flow[2] + p.z * flow[3]; });
  const sdk::Vec3 start{0.8, 0, 0};
  world.grains.add({}, start, diameter);
  const sdk::Vec3 gravity = reduced_gravity(9.81, test::k_air, test::k_sand);
  world.begin_step(fluid_step);
  const double interval = world.coupling->refresh_interval();
  const int steps = static_cast<int>(std::lround(time / interval));
  for (int n = 0; n < steps; ++n) flight.advance(interval, gravity);
  Reference reference{world, flow, gravity, diameter, {}, start};
  constexpr int k_fine = 64;
  reference.run(steps * interval, k_fine * steps);
  const double* p = world.grains.position.data();
  return {interval, norm(sdk::Vec3{p[0], p[1], p[2]} - reference.x) / norm(reference.x)};
}

TEST_CASE("a flight in still or sheared air shall be right to second order in the fluid step") {
  const std::array<sdk::Vec3, 4> still{};
  // A jet's edge: it stretches, turns and shears at 40 1/s.
  const std::array<sdk::Vec3, 4> sheared{sdk::Vec3{0.3, 0, 0.1}, sdk::Vec3{-20, 0, 10},
                                         sdk::Vec3{0, -20, 0}, sdk::Vec3{40, 0, 40}};
  struct Grain {
    double diameter, time;
  };
  // 5 relaxation times of the fine one, a fall through 2 cm of the others.
  for (const Grain grain : {Grain{1e-5, 4e-3}, Grain{1e-4, 0.064}, Grain{3e-4, 0.064}}) {
    for (const std::string law :
         {"wen_yu", "schiller_naumann", "abraham", "di_felice", "koch_hill", "beetstra"}) {
      for (const auto& flow : {still, sheared}) {
        CAPTURE(grain.diameter);
        CAPTURE(law);
        CAPTURE(norm(flow[1]));
        FlightResult last{};
        for (const double fluid_step : {1e-3, 5e-4, 2.5e-4, 1.25e-4}) {
          CAPTURE(fluid_step);
          const FlightResult now = run_flight(law, grain.diameter, fluid_step, grain.time, flow);
          if (fluid_step == 1e-3) CHECK(now.error < 1e-3);
          // Below this the reference and rounding have a say.
          constexpr double k_exact = 2e-8;
          if (last.error > k_exact && now.error > k_exact && now.interval < 0.9 * last.interval) {
            const double order =
                std::log(last.error / now.error) / std::log(last.interval / now.interval);
            CHECK(order > 1.8);
          }
          last = now;
        }
      }
    }
  }
}

TEST_CASE("drag on a grain that is held shall be that of the slip there is") {
  // What would happen to it if it were free must not leak into its drag.
  World::Choice choice;
  choice.drag = "wen_yu";
  Flight flight(choice);
  World& world = flight.world;
  world.set(world.velocity, [](sdk::Vec3) { return sdk::Vec3{0, 0, 0.4}; });
  world.grains.add({0, 0, 0}, {}, 1e-4);
  world.begin_step(choice.fluid_step);
  double rate = 0.0;
  for (int n = 0; n < 3; ++n) {
    world.refresh();
    world.grains.hold(choice.fluid_step);
    rate = world.grains.action[3];
  }
  double reynolds = 0.4 * 1e-4 * test::k_air / test::k_air_viscosity;
  double void_fraction = 1.0;
  double factor = 0.0;
  world.drag->evaluate({1, &reynolds, &void_fraction, &factor, nullptr});
  const double mass = test::k_sand * sdk::sphere_volume(1e-4);
  const double wanted = 3.0 * std::numbers::pi * test::k_air_viscosity * 1e-4 * factor / mass;
  CHECK(rate == test::approx(wanted).epsilon(1e-12));
}

TEST_CASE("grains thrown into still air shall fly as tabulated") {
  struct Row {
    double speed, diameter, density, drop, x;
  };
  // projectile_still_air.csv, Schiller and Naumann.
  const Row rows[] = {{0.8, 6e-4, 2650, 0.14, 0.128076},  {0.8, 5e-4, 2650, 0.14, 0.125801},
                      {0.8, 3e-4, 2650, 0.14, 0.1147},    {0.8, 1e-4, 2650, 0.14, 0.0472915},
                      {0.8, 5e-5, 2650, 0.14, 0.0137983}, {0.2, 6e-4, 2650, 0.02, 0.0126114},
                      {0.4, 6e-4, 2650, 0.1, 0.0550546}};
  for (const Row& row : rows) {
    World::Choice choice;
    choice.drag = "wen_yu";
    Flight flight(choice);
    flight.world.grains.add({0, 0, 0}, {row.speed, 0, 0}, row.diameter, row.density);
    const double* p = flight.world.grains.position.data();
    std::array<double, 2> last{};
    while (-p[2] < row.drop) {
      last = {p[0], -p[2]};
      flight.advance(2e-4, {0, 0, -9.81});
    }
    const double part = (row.drop - last[1]) / (-p[2] - last[1]);
    CHECK(last[0] + part * (p[0] - last[0]) == test::approx(row.x).epsilon(2e-3));
  }
}

}  // namespace
