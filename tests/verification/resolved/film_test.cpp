// SPDX-License-Identifier: Apache-2.0
// What the grid sees of a thin film, and what the law `lubrication` has to add.
#include "support/approx.hpp"
#include "unit/resolved/resolved_box.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::test {
namespace {

constexpr double k_diameter = 8.0;  // in cells
constexpr double k_radius = 0.5 * k_diameter;

/// Resistance to an approach over that of a lone sphere, by series in bispherical coordinates
/// (Brenner 1961, 10.1016/0009-2509(61)80035-3): to a wall at `gap`, or, `is_pair`, to an equal
/// sphere that comes as fast from the other side: a plane without friction half-way.
double known_resistance(double gap, bool is_pair) {
  const double alpha = std::acosh(1.0 + (is_pair ? 0.5 : 1.0) * gap / k_radius);
  const double s = std::sinh(alpha);
  double sum = 0.0;
  for (int n = 1; (2 * n + 1) * alpha < 60.0; ++n) {
    const double m = 2.0 * n + 1.0;
    const double half = 0.5 * m * alpha;
    const double term = is_pair ? (4.0 * std::pow(std::cosh(half), 2) + m * m * s * s) /
                                      (2.0 * std::sinh(m * alpha) - m * std::sinh(2.0 * alpha))
                                : (2.0 * std::sinh(m * alpha) + m * std::sinh(2.0 * alpha)) /
                                      (4.0 * std::pow(std::sinh(half), 2) - m * m * s * s);
    sum += n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (term - 1.0);
  }
  return 4.0 / 3.0 * s * sum;
}

/// Of the law `lubrication` with a `reach` in cells: what acts below it.
double law_resistance(double gap, bool is_pair, double reach) {
  const double excess = std::max(0.0, k_radius / gap - k_radius / reach);
  return (is_pair ? 0.5 : 1.0) * excess;
}

/// Of the grid: spheres 8 cells across, held where they are while their surfaces move.
double grid_resistance(double gap, bool is_pair) {
  ResolvedBox box;
  box.cells = {32, 32, is_pair ? 32 : 24};
  box.max = {32.0, 32.0, static_cast<double>(box.cells[2])};
  for (std::size_t side = 0; side < 4; ++side) box.sides[side] = slip();
  box.sides[4] = is_pair ? open_side(0.0, false) : wall();
  box.sides[5] = open_side(0.0, false);
  box.fluid.density = 1.0;
  box.fluid.viscosity = 1.0;
  box.fluid.pressure_tolerance = 1e-6;
  box.step = 0.8;
  box.is_held = true;
  const double speed = 1e-6;
  const double away = k_radius + 0.5 * gap;
  if (is_pair) {
    box.grains.add({16.0, 16.0, 16.0 - away}, k_diameter, 1e15, {0.0, 0.0, speed});
    box.grains.add({16.0, 16.0, 16.0 + away}, k_diameter, 1e15, {0.0, 0.0, -speed});
  } else {
    box.grains.add({16.0, 16.0, k_radius + gap}, k_diameter, 1e15, {0.0, 0.0, -speed});
  }
  box.begin();
  double resistance = 0.0;
  double before = 0.0;
  int steps = 0;
  do {
    before = resistance;
    for (int n = 0; n < 50; ++n) box.one_step();
    steps += 50;
    resistance = std::abs(box.mean_force[0].z) / (3.0 * std::numbers::pi * k_diameter * speed);
  } while (std::abs(resistance - before) > 5e-4 * resistance && steps < 3000);
  return resistance;
}

}  // namespace

TEST_CASE("V-FILM: the grid and the law of lubrication shall share the resistance of a film") {
  for (const bool is_pair : {false, true}) {
    const double reach = is_pair ? 0.15 : 0.5;  // in cells
    for (const double gap : {1.0, 0.4, 0.2, 0.1, 0.05}) {
      const double known = known_resistance(gap, is_pair);
      const double grid = grid_resistance(gap, is_pair);
      const double both = grid + law_resistance(gap, is_pair, reach);
      MESSAGE((is_pair ? "pair" : "wall") << " at " << gap << " cells: grid " << grid / known
                                          << ", with the law " << both / known << " of " << known);
      CHECK(both == test::approx(known).epsilon(0.2));
    }
  }
}

}  // namespace dust::test
