// SPDX-License-Identifier: Apache-2.0
// Virtual mass and memory of a sphere, against closed forms.
#include "still.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace dust;
using test::Still;
using test::stokes_drag;
using test::World;

constexpr double k_g = 9.81;
constexpr double k_water = 998.2;
constexpr double k_viscosity = 1e-3;

World::Choice water(double fluid_step) {
  World::Choice choice;
  choice.density = k_water;
  choice.viscosity = k_viscosity;
  choice.fluid_step = fluid_step;
  return choice;
}
World::Choice without_drag(double fluid_step) {
  World::Choice choice = water(fluid_step);
  // Exactly none would leave the coupling no rate to work with.
  choice.factor = [](double, double) { return 1e-9; };
  return choice;
}

TEST_CASE("a sphere let go shall start with the acceleration of its own and its virtual mass") {
  for (const double density : {2650.0, 998.2 * 0.1, 1.2}) {
    CAPTURE(density);
    constexpr double k_step = 1e-6;
    Still still(water(k_step), {{"virtual_mass"}}, {0, 0, -k_g});
    still.world.grains.add({0, 0, 0}, {}, 1e-3, density);
    still.step(1, still.weight(density));
    const double expected = -k_g * (density - k_water) / (density + 0.5 * k_water);
    // Drag grows over the step: 1e-6 s of at least 0.028 s.
    CHECK(still.world.grains.velocity[2] / k_step == test::approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("with virtual mass Stokes's fall shall be integrated exactly, however light the sphere") {
  for (const double density : {2650.0, 100.0}) {
    constexpr double k_step = 1e-3;
    constexpr double k_diameter = 2e-4;
    Still still(water(k_step), {{"virtual_mass"}}, {0, 0, -k_g});
    still.world.grains.add({0, 0, 0}, {}, k_diameter, density);
    const double volume = sdk::sphere_volume(k_diameter);
    const double drag = stokes_drag(k_viscosity, k_diameter);
    const double time = (density + 0.5 * k_water) * volume / drag;
    const double end = -(density - k_water) * volume * k_g / drag;
    for (int n = 1; n <= 12; ++n) {
      still.step(2, still.weight(density));
      const double expected = end * (1.0 - std::exp(-n * k_step / time));
      CHECK(still.world.grains.velocity[2] == test::approx(expected).epsilon(1e-9));
    }
  }
}

TEST_CASE("an accelerating stream shall take a sphere along by its virtual mass") {
  constexpr double k_step = 1e-3;
  constexpr double k_rate = 3.0;  // m/s2
  Still still(without_drag(k_step), {{"virtual_mass"}});
  still.world.grains.add({0.1, 0.2, 0.3}, {}, 1e-3, 2650.0);
  double before = 0.0;
  for (int n = 1; n <= 20; ++n) {
    const double u = k_rate * n * k_step;
    still.world.set(still.world.velocity, [u](sdk::Vec3) { return sdk::Vec3{u, 0, 0}; });
    still.step(4, {});
    // In the first step the fluid has no past.
    if (n == 1) before = still.world.grains.velocity[0];
  }
  const double share = 0.5 * k_water / (2650.0 + 0.5 * k_water);
  CHECK(std::abs(before) < 1e-10 * k_rate * k_step);
  CHECK(still.world.grains.velocity[0] == test::approx(share * k_rate * 19 * k_step).epsilon(1e-6));
}

TEST_CASE("the acceleration of the fluid shall be that along the path of the grain") {
  constexpr double k_strain = 5.0;  // 1/s: u = s (x, -y, 0)
  World::Choice choice = without_drag(1e-3);
  choice.cells = {8, 8, 8};
  Still still(choice, {{"virtual_mass"}});
  still.world.set(still.world.velocity, [](sdk::Vec3 x) {
    return k_strain * sdk::Vec3{x.x, -x.y, 0.0};
  });
  still.world.grains.add({0.4, 0.3, 0.2}, {2.0, 1.0, 0.5}, 1e-3, 2650.0);
  still.map();
  still.refresh(1e-3);
  const double mass = 0.5 * k_water * sdk::sphere_volume(1e-3);
  // In the frame of m + m_a: the share of it that the DEM's mass feels.
  const double share = 2650.0 / (2650.0 + 0.5 * k_water);
  CHECK(still.force().x == test::approx(share * mass * k_strain * 2.0).epsilon(1e-6));
  CHECK(still.force().y == test::approx(-share * mass * k_strain * 1.0).epsilon(1e-6));
  CHECK(std::abs(still.force().z) < 1e-6 * still.force().x);
}

TEST_CASE("the blow of a contact shall be felt by the virtual mass, one interval late") {
  constexpr double k_step = 1e-4;
  Still still(without_drag(k_step), {{"virtual_mass"}});
  still.world.grains.add({0, 0, 0}, {}, 1e-3, 2650.0);
  still.step(1, {});
  const double blow = 0.2;  // m/s to the sphere's own mass
  still.world.grains.velocity[1] += blow;
  still.step(1, {});
  const double share = 2650.0 / (2650.0 + 0.5 * k_water);
  CHECK(still.world.grains.velocity[1] == test::approx(share * blow).epsilon(1e-6));
  still.step(1, {});
  CHECK(still.world.grains.velocity[1] == test::approx(share * blow).epsilon(1e-6));
}

/// Fall from rest with Stokes drag, virtual mass and memory: M v' + C int v' / sqrt(t - t') + K v =
/// F. By Laplace's transform, with x1, x2 the roots of M x^2 + C sqrt(pi) x + K (real for light
/// spheres): sums of exp(x^2 t) erfc(-x sqrt(t)).
double fall_with_memory(double mass, double memory, double drag, double force, double t) {
  const double b = memory * std::sqrt(std::numbers::pi);
  const double root = std::sqrt(b * b - 4.0 * mass * drag);
  const double x1 = (-b + root) / (2.0 * mass);
  const double x2 = (-b - root) / (2.0 * mass);
  const auto e = [t](double x) { return std::exp(x * x * t) * std::erfc(-x * std::sqrt(t)); };
  return force / (mass * (x1 - x2)) * ((e(x1) - 1.0) / x1 - (e(x2) - 1.0) / x2);
}

TEST_CASE("a light sphere let go shall rise as its drag, virtual mass and memory say") {
  constexpr double k_density = 300.0;
  constexpr double k_diameter = 2e-4;
  constexpr double k_step = 1e-4;
  const double volume = sdk::sphere_volume(k_diameter);
  const double mass = (k_density + 0.5 * k_water) * volume;
  const double drag = stokes_drag(k_viscosity, k_diameter);
  const double memory =
      1.5 * k_diameter * k_diameter * std::sqrt(std::numbers::pi * k_water * k_viscosity);
  const double force = (k_water - k_density) * volume * k_g;
  const auto run = [&](bool has_memory, int steps) {
    std::vector<Still::Force> names = {{"virtual_mass"}};
    if (has_memory) names.push_back({"basset"});
    Still still(water(k_step), names, {0, 0, -k_g});
    still.world.grains.add({0, 0, 0}, {}, k_diameter, k_density);
    for (int n = 0; n < steps; ++n) still.step(1, still.weight(k_density));
    return still.world.grains.velocity[2];
  };
  for (const int steps : {10, 30, 100, 400}) {
    const double expected = fall_with_memory(mass, memory, drag, force, steps * k_step);
    const double got = run(true, steps);
    MESSAGE(steps * k_step << " s: " << got << " m/s, closed form " << expected);
    // 1 % by the joined pieces of the past, the rest by steps of 1/20 of the relaxation time.
    CHECK(got == test::approx(expected).epsilon(0.02));
  }
  // Without the memory it is another motion: the comparison can fail.
  CHECK(run(false, 30) > 1.2 * run(true, 30));
}

TEST_CASE(
    "a fall without drag shall slow down as the virtual mass grows with the acceleration number") {
  // (m + C_A(A_c) m_f) v' = (m - m_f) g with A_c = v^2 / (D v'): v' by repeated insertion, v by
  // Euler's rule in steps so small that they do not show.
  constexpr double k_density = 2650.0;
  constexpr double k_diameter = 1e-3;
  constexpr double k_time = 0.05;
  const auto acceleration = [](double v, double guess) {
    for (int n = 0; n < 50; ++n) {
      const double number = v * v / (k_diameter * guess);
      const double c_a = 1.05 - 0.066 / (number * number + 0.12);
      guess = (k_density - k_water) * k_g / (k_density + c_a * k_water);
    }
    return guess;
  };
  double speed = 0.0;
  double rate = k_g;
  constexpr int k_fine = 50000;
  for (int n = 0; n < k_fine; ++n) {
    rate = acceleration(speed, rate);
    speed += rate * k_time / k_fine;
  }
  const auto fall = [&](const char* kind, double step) {
    Still still(without_drag(step), {{"virtual_mass", {{"acceleration", std::string(kind)}}}},
                {0, 0, -k_g});
    still.world.grains.add({0, 0, 0}, {}, k_diameter, k_density);
    const int steps = static_cast<int>(std::lround(k_time / step));
    for (int n = 0; n < steps; ++n) still.step(1, still.weight(k_density));
    return -still.world.grains.velocity[2];
  };
  CHECK(fall("odar_hamilton", 1e-4) == test::approx(speed).epsilon(2e-3));
  const double plain = (k_density - k_water) * k_g / (k_density + 0.5 * k_water) * k_time;
  CHECK(fall("any", 1e-4) == test::approx(plain).epsilon(1e-5));
  CHECK(plain > 1.05 * speed);
}

TEST_CASE(
    "the memory of a stream that gains speed evenly shall fall with the acceleration number") {
  // A sphere too heavy to follow, u = a t: the force is C_H(A_c) / 6 of C 2 a sqrt(t), A_c = a t^2
  // / D.
  constexpr double k_step = 1e-3;
  constexpr double k_rate = 0.5;  // m/s2
  constexpr double k_diameter = 2e-3;
  Still still(without_drag(k_step), {{"basset", {{"acceleration", std::string("odar_hamilton")}}}});
  still.world.grains.add({0, 0, 0}, {}, k_diameter, 1e7);
  const double c =
      1.5 * k_diameter * k_diameter * std::sqrt(std::numbers::pi * k_water * k_viscosity);
  for (int n = 0; n <= 100; ++n) {
    const double time = n * k_step;
    still.world.set(still.world.velocity, [&](sdk::Vec3) {
      return sdk::Vec3{k_rate * time, 0, 0};
    });
    still.step(1, {});
    if (n != 40 && n != 100) continue;
    const double number = k_rate * time * time / k_diameter;
    const double plain = c * 2.0 * k_rate * std::sqrt(time + 0.5 * k_step);
    const double expected = (2.88 + 3.12 / std::pow(1.0 + number, 3)) / 6.0 * plain;
    MESSAGE("A_c " << number << ": " << still.force().x / plain << " of Basset's force");
    CHECK(still.force().x == test::approx(expected).epsilon(0.03));
    CHECK(plain > 1.2 * expected);
  }
}

TEST_CASE("the memory of a grain shall survive a restart and a new order of rows") {
  const auto make = [] {
    auto still = std::make_unique<Still>(water(1e-3),
                                         std::vector<Still::Force>{{"virtual_mass"}, {"basset"}},
                                         sdk::Vec3{0, 0, -k_g});
    for (int n = 0; n < 5; ++n) still->world.grains.add({0.1 * n, 0, 0}, {}, 1e-4 * (n + 1));
    return still;
  };
  const auto whole = make();
  const auto part = make();
  const auto step = [](Still& s) { s.step(3, s.weight(test::k_sand)); };
  for (int n = 0; n < 20; ++n) {
    step(*whole);
    step(*part);
  }
  test::MemoryArchive archive;
  part->world.coupling->save(archive);
  part->world.restart();
  part->world.coupling->use(part->forces, {});
  part->world.coupling->load(archive);
  for (auto* s : {whole.get(), part.get()}) {
    s->world.grains.swap(0, 3);
    for (int n = 0; n < 20; ++n) step(*s);
  }
  CHECK(whole->world.grains.velocity == part->world.grains.velocity);
  CHECK(whole->world.grains.velocity[2] < 0.0);
}

}  // namespace
