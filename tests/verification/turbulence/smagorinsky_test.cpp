// SPDX-License-Identifier: Apache-2.0
// The eddy viscosity of known flows, and what its stress does to momentum and energy.
#include "contract/plugin_library.hpp"
#include "support/approx.hpp"
#include "verification/fluid/fluid_case.hpp"
#include "verification/fluid/test_bodies.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using namespace dust;
using sdk::Vec3;

constexpr double k_rho = 1.2;
constexpr double k_coefficient = 0.17;
constexpr double k_pi = std::numbers::pi;

std::unique_ptr<sdk::TurbulenceModel> smagorinsky(double coefficient = k_coefficient) {
  const test::PluginLibrary library("turbulence_smagorinsky");
  const std::vector<sdk::Value> values = {coefficient};
  return std::unique_ptr<sdk::TurbulenceModel>(
      static_cast<sdk::TurbulenceModel*>(library.offers.at(0).factory(values).release()));
}

test::Case box(std::array<int, 3> cells, Vec3 max, double viscosity) {
  test::Case c;
  c.cells = cells;
  c.max = max;
  c.fluid.density = k_rho;
  c.fluid.viscosity = viscosity;
  c.fluid.pressure_tolerance = 1e-10;
  return c;
}

TEST_CASE("plane shear shall have the eddy viscosity of the formula, less near the walls") {
  // u = 200 z between a wall at rest and one that moves.
  constexpr double k_shear = 200.0;
  constexpr int k_cells = 20;
  const auto model = smagorinsky();
  auto c = box({8, 8, k_cells}, {0.04, 0.08, 0.02}, 1.8e-5);
  c.sides[4] = test::wall();
  c.sides[5] = test::wall({k_shear * 0.02, 0, 0});
  c.start();
  c.solver->use(*model);
  c.solver->set_velocity([](Vec3 x) { return Vec3{k_shear * x.z, 0, 0}; });
  c.advance(1e-7);
  REQUIRE(c.solver->eddy_viscosity() != nullptr);
  const double width = std::cbrt(0.005 * 0.01 * 0.001);
  for (int k = 0; k < k_cells; ++k) {
    const double wall = 0.001 * std::min(k + 0.5, k_cells - k - 0.5);
    const double length = std::min(k_coefficient * width, 0.41 * wall);
    const double expected = k_rho * length * length * k_shear;
    CAPTURE(k);
    // The stress has acted for 1e-7 s on cells that it changes within 1e-3 s.
    CHECK((*c.solver->eddy_viscosity())[static_cast<std::size_t>(c.grid.index(3, 4, k))] ==
          test::approx(expected).epsilon(1e-3));
  }
}

TEST_CASE("a side shall be a wall where a hood draws, and none while air is blown through it") {
  // The shear of above. From the start on a hood, an eighth of the side, draws through the lower
  // wall what comes in evenly through the upper one.
  constexpr double k_shear = 200.0;
  constexpr int k_cells = 20;
  const auto model = smagorinsky();
  auto c = box({8, 8, k_cells}, {0.04, 0.08, 0.02}, 1.8e-5);
  c.sides[4] = test::wall();
  c.sides[4]->velocity = [](Vec3 x, double time) {
    return Vec3{0, 0, time > 0.0 && x.x < 0.005 ? -8e-9 : 0.0};
  };
  c.sides[5] = test::wall();
  c.sides[5]->velocity = [](Vec3, double time) {
    return Vec3{k_shear * 0.02, 0, time > 0.0 ? -1e-9 : 0.0};
  };
  c.start();
  c.solver->use(*model);
  c.solver->set_velocity([](Vec3 x) { return Vec3{k_shear * x.z, 0, 0}; });
  for (int n = 0; n < 3; ++n) c.advance(1e-7);
  const double width = std::cbrt(0.005 * 0.01 * 0.001);
  for (int k = 0; k < k_cells; ++k) {
    const double length = std::min(k_coefficient * width, 0.41 * 0.001 * (k + 0.5));
    CAPTURE(k);
    CHECK((*c.solver->eddy_viscosity())[static_cast<std::size_t>(c.grid.index(3, 4, k))] ==
          test::approx(k_rho * length * length * k_shear).epsilon(1e-3));
  }
}

TEST_CASE("stretching shall count like shear: |S| of a vortex array") {
  // u = (sin x cos y, -cos x sin y): |S| = 2 |cos x cos y|, no shear stress at all.
  constexpr int k_cells = 64;
  const auto model = smagorinsky();
  auto c = box({k_cells, k_cells, 1}, {2 * k_pi, 2 * k_pi, 0.1}, 1e-5);
  c.start();
  c.solver->use(*model);
  c.solver->set_velocity([](Vec3 x) {
    return Vec3{std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0};
  });
  c.advance(1e-6);
  const double width = 2 * k_pi / k_cells;  // one cell in depth does not count
  double worst = 0.0;
  for (int j = 0; j < k_cells; ++j) {
    for (int i = 0; i < k_cells; ++i) {
      const Vec3 x = c.grid.centre(i, j, 0);
      const double strain = 2.0 * std::abs(std::cos(x.x) * std::cos(x.y));
      const double expected = k_rho * std::pow(k_coefficient * width, 2) * strain;
      const double got =
          (*c.solver->eddy_viscosity())[static_cast<std::size_t>(c.grid.index(i, j, 0))];
      worst =
          std::max(worst, std::abs(got - expected) / (k_rho * std::pow(k_coefficient * width, 2)));
    }
  }
  MESSAGE("largest error of |S|: " << worst << " of 2");
  CHECK(worst < 5e-3);  // second order: (h^2 / 6) of 64 cells per wave, for each derivative
}

/// A box of air that shears as U sin(k z), as kinetic energy [J/m3] and momentum.
struct Wave {
  static constexpr int k_cells = 64;
  static constexpr double k_height = 0.1;
  static constexpr double k_speed = 2.0;
  explicit Wave(const sdk::TurbulenceModel* model)
      : c(box({4, 4, k_cells}, {0.01, 0.01, k_height}, 1e-9)) {
    c.start();
    if (model != nullptr) c.solver->use(*model);
    c.solver->set_velocity([](Vec3 x) {
      return Vec3{0.3 + k_speed * std::sin(2 * k_pi * x.z / k_height), 0.1, 0};
    });
  }
  [[nodiscard]] double momentum() const {
    double sum = 0.0;
    c.each_face(0, [&](int, int, int, Vec3, double u) { sum += u; });
    return sum;
  }
  /// Of the wave alone.
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    c.each_face(0,
                [&](int, int, int, Vec3, double u) { sum += 0.5 * k_rho * (u - 0.3) * (u - 0.3); });
    return sum / (4 * 4 * k_cells);
  }
  test::Case c;
};

TEST_CASE("the eddies shall take the energy of the formula and no momentum") {
  const auto model = smagorinsky();
  Wave wave(model.get());
  const double momentum = wave.momentum();
  const double before = wave.energy();
  constexpr double k_step = 2e-6;
  constexpr int k_steps = 5;
  for (int n = 0; n < k_steps; ++n) wave.c.advance(k_step);
  CHECK(wave.momentum() == test::approx(momentum).epsilon(1e-12));
  // -dE/dt = rho l^2 <|u'|^3> = rho l^2 (U k)^3 4 / (3 pi)
  const double width = std::cbrt(0.0025 * 0.0025 * Wave::k_height / Wave::k_cells);
  const double slope = Wave::k_speed * 2 * k_pi / Wave::k_height;
  const double expected =
      k_rho * std::pow(k_coefficient * width, 2) * std::pow(slope, 3) * 4.0 / (3.0 * k_pi);
  const double lost = (before - wave.energy()) / (k_steps * k_step);
  MESSAGE("energy lost: " << lost << " W/m3, expected " << expected);
  CHECK(lost == test::approx(expected).epsilon(0.01));
  Wave laminar(nullptr);
  for (int n = 0; n < k_steps; ++n) laminar.c.advance(k_step);
  CHECK(before - laminar.energy() < 1e-3 * (before - wave.energy()));
}

TEST_CASE("air that is nowhere sheared shall not notice the model") {
  const auto model = smagorinsky();
  const auto run = [&](bool has_model) {
    auto c = box({6, 5, 4}, {0.1, 0.1, 0.1}, 1.8e-5);
    c.start();
    if (has_model) c.solver->use(*model);
    c.solver->set_velocity([](Vec3) { return Vec3{1.0, -2.0, 0.5}; });
    for (int n = 0; n < 3; ++n) c.advance(1e-3);
    return c.solver->velocity().component;
  };
  CHECK(run(true) == run(false));
}

TEST_CASE("the eddies shall stay stable wherever the Courant number allows the step") {
  const auto model = smagorinsky(0.3);
  auto c = box({16, 16, 16}, {0.1, 0.1, 0.1}, 1e-9);
  c.start();
  c.solver->use(*model);
  c.solver->set_velocity([](Vec3 x) {
    const double a = 2 * k_pi / 0.1;
    return Vec3{3.0 * std::sin(a * x.y) + std::cos(3 * a * x.z), 3.0 * std::sin(a * x.z),
                3.0 * std::sin(a * x.x) * std::cos(4 * a * x.y)};
  });
  double last = 1e300;
  for (int n = 0; n < 100; ++n) {
    c.advance(2e-3);
    if (n % 20 != 0) continue;
    double energy = 0.0;
    for (int d = 0; d < 3; ++d) {
      c.each_face(d, [&](int, int, int, Vec3, double u) { energy += u * u; });
    }
    CHECK(energy < last);
    last = energy;
  }
}

TEST_CASE("the eddies shall stay stable in flat cells and along a direction of one cell") {
  // Plates 16 mm apart, the upper at 10 m/s, from rest: the velocity stays between the plates'.
  const auto model = smagorinsky();
  struct Cells {
    std::array<int, 3> count;
    double step;
  };
  for (const Cells& cells : {Cells{{4, 4, 16}, 1e-3}, Cells{{1, 1, 16}, 10e-3}}) {
    auto c = box(cells.count, {0.04, 0.04, 0.016}, 1.8e-5);
    c.sides[4] = test::wall();
    c.sides[5] = test::wall({10, 0, 0});
    c.start();
    c.solver->use(*model);
    c.advance_to(0.5, cells.step);
    double low = 0.0, high = 0.0;
    c.each_face(0, [&](int, int, int, Vec3, double u) {
      low = std::min(low, u);
      high = std::max(high, u);
    });
    CAPTURE(cells.count[0]);
    CHECK(low > -0.01);
    CHECK(high < 10.01);
    CHECK(high > 5.0);  // the eddies have set it in motion
  }
}

/// Air of next to no viscosity at 5 m/s over a box of 16 cells' height, whose walls are `bodies`,
/// or sides where there are none. [m/s] of each layer of cells after 20 ms.
std::vector<double> layers(bodies::BodySet bodies, bool has_sides, double lower_speed) {
  const auto model = smagorinsky();
  auto c = box({6, 4, 16}, {0.06, 0.04, 0.16}, 1e-9);
  if (has_sides) {
    c.sides[4] = test::wall();
    c.sides[5] = test::wall();
  } else {
    c.sides[4] = test::slip();
    c.sides[5] = test::slip();
  }
  c.bodies = std::move(bodies);
  c.start();
  c.solver->use(*model);
  c.solver->set_velocity([&](Vec3 x) { return Vec3{x.z > 0.08 ? 5.0 : lower_speed, 0, 0}; });
  for (int n = 0; n < 20; ++n) c.advance(1e-3);
  std::vector<double> speeds;
  for (int k = 0; k < 16; ++k) speeds.push_back(c.u(0, 3, 2, k));
  return speeds;
}

bodies::BodySet set_of(std::unique_ptr<bodies::Shape> one,
                       std::unique_ptr<bodies::Shape> other = {}) {
  bodies::BodySet all;
  all.push_back(test::body(std::move(one), 0.0));
  if (other) all.push_back(test::body(std::move(other), 0.0));
  return all;
}

TEST_CASE("eddies shall not reach through a sheet, wherever it lies in the cells") {
  for (const double place : {0.08, 0.0777, 0.0823}) {
    CAPTURE(place);
    const auto speeds = layers(
        set_of(std::make_unique<test::Plate>(Vec3{0, 0, place}, Vec3{0, 0, 1}, 0.0)), false, 0.0);
    for (int k = 0; k < 16; ++k) {
      // What the plate's own cell starts with is that of its side or not; it stays there.
      if (k == 7 || k == 8) continue;
      CHECK(std::abs(speeds[static_cast<std::size_t>(k)] - (k > 8 ? 5.0 : 0.0)) < 1e-5);
    }
  }
}

TEST_CASE("eddies shall end at walls, be they sides or bodies on the grid's planes") {
  const auto sides = layers({}, true, 5.0);
  const auto bodies =
      layers(set_of(std::make_unique<test::HalfSpace>(Vec3{0, 0, 0.03}, Vec3{0, 0, 1}),
                    std::make_unique<test::HalfSpace>(Vec3{0, 0, 0.13}, Vec3{0, 0, -1})),
             false, 5.0);
  for (int k = 0; k < 16; ++k) CHECK(std::abs(sides[static_cast<std::size_t>(k)] - 5.0) < 1e-5);
  for (int k = 3; k < 13; ++k) CHECK(std::abs(bodies[static_cast<std::size_t>(k)] - 5.0) < 1e-5);
}

TEST_CASE("eddies in the corners of a box shall not depend on the names of the axes") {
  // A lid that moves along the first of the axes, a belt along the second, an open side: whose
  // edges meet walls. Other orders of the names, and the eddy viscosity of the cell with the same
  // place.
  const auto eddies = [](const std::array<int, 3>& axis) {
    const auto along = [&](Vec3 v) {
      Vec3 named;
      for (std::size_t n = 0; n < 3; ++n) named[axis[n]] = v[static_cast<int>(n)];
      return named;
    };
    const auto model = smagorinsky();
    std::array<int, 3> cells{};
    for (std::size_t n = 0; n < 3; ++n)
      cells[static_cast<std::size_t>(axis[n])] = 6 + 2 * static_cast<int>(n);
    auto c = box(cells, along({0.06, 0.08, 0.1}), 1.8e-5);
    const auto side = [&](int n, int high) -> auto& {
      return c.sides[static_cast<std::size_t>(2 * axis[static_cast<std::size_t>(n)] + high)];
    };
    side(0, 0) = test::wall();
    side(0, 1) = test::open_side(0.0, false);
    side(1, 0) = test::wall(along({0.7, 0.0, 0.0}));
    side(1, 1) = test::wall(along({0.0, 0.0, 0.4}));
    side(2, 0) = test::wall();
    side(2, 1) = test::wall(along({1.0, 0.3, 0.0}));
    c.start();
    c.solver->use(*model);
    c.advance(1e-6);
    std::vector<double> found;
    for (int k = 0; k < 10; ++k) {
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 6; ++i) {
          std::array<int, 3> at{};
          for (std::size_t n = 0; n < 3; ++n)
            at[static_cast<std::size_t>(axis[n])] = std::array<int, 3>{i, j, k}[n];
          found.push_back((*c.solver->eddy_viscosity())[static_cast<std::size_t>(
              c.grid.index(at[0], at[1], at[2]))]);
        }
      }
    }
    return found;
  };
  const auto first = eddies({0, 1, 2});
  const double largest = *std::max_element(first.begin(), first.end());
  CHECK(largest > 0.0);
  for (const std::array<int, 3>& axis :
       {std::array<int, 3>{1, 2, 0}, std::array<int, 3>{2, 0, 1}, std::array<int, 3>{1, 0, 2},
        std::array<int, 3>{0, 2, 1}, std::array<int, 3>{2, 1, 0}}) {
    CAPTURE(axis[0]);
    CAPTURE(axis[1]);
    const auto other = eddies(axis);
    double apart = 0.0;
    for (std::size_t n = 0; n < first.size(); ++n)
      apart = std::max(apart, std::abs(other[n] - first[n]));
    CHECK(apart < 1e-9 * largest);
  }
}

}  // namespace
