// SPDX-License-Identifier: Apache-2.0
// What lies on surfaces that run: a flat belt and a drum, against the way that they go.
#include "airborne/surface_transport.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

using namespace dust;
using airborne::Flow;
using airborne::Layers;
using airborne::SurfaceTransport;
using fluid::Grid;
using sdk::Vec3;

namespace {

constexpr double k_speed = 0.7;  // [m/s]

/// Surfaces in a grid and what lies on them.
struct Carried {
  Grid grid;
  Flow flow;
  Layers layers{1};
  SurfaceTransport transport;
  std::vector<std::vector<double>> out{{0.0}};
  std::uint8_t sides_passed = 0b11;  ///< of pieces to come: left and right

  explicit Carried(const Grid& g) : grid(g), flow(g) {}

  void add_piece(std::array<int, 3> cell, Vec3 point, Vec3 area, Vec3 velocity) {
    const auto index = static_cast<std::int32_t>(grid.index(cell[0], cell[1], cell[2]));
    flow.walls.push_back({index, 0, -area / grid.cell_volume()});
    flow.surface_motions.push_back({point, area, velocity, false, sides_passed});
  }
  void prepare() {
    flow.walls_found += 1;
    transport.prepare(grid, flow, layers);
  }
  void run(double end, int steps) {
    for (int n = 0; n < steps; ++n) transport.advance(flow, end / steps, layers, out);
  }
  [[nodiscard]] double mass() {
    return std::accumulate(layers.rows().begin(), layers.rows().end(), 0.0);
  }
};

/// A belt through the middle of the cells, one row of them along x.
Carried flat_belt(int cells, bool is_periodic, bool passes_sides = true) {
  Carried c(Grid::make({0, 0, 0}, {1, 0.1, 0.1}, {cells, 1, 1}, {is_periodic, true, false}));
  if (!passes_sides) c.sides_passed = 0;
  for (int i = 0; i < cells; ++i) {
    const Vec3 centre = c.grid.centre(i, 0, 0);
    c.add_piece({i, 0, 0}, centre, {0, 0, c.grid.spacing.x * 0.1}, {k_speed, 0, 0});
  }
  c.prepare();
  return c;
}

}  // namespace

TEST_CASE("what lies on a belt shall go as far as the belt and spread as upwind differences do") {
  constexpr int k_cells = 100;
  Carried c = flat_belt(k_cells, true);
  for (std::size_t i = 10; i < 20; ++i) c.layers.add(i, 0, 0.1);
  const double before = c.mass();
  c.run(0.5, 200);
  double middle = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < k_cells; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / k_cells;
    middle += x * c.layers.on(i)[0];
    square += x * x * c.layers.on(i)[0];
    CHECK(c.layers.on(i)[0] >= 0.0);
  }
  CHECK(c.mass() == test::approx(before).epsilon(1e-14));
  CHECK(middle == test::approx(0.15 + k_speed * 0.5).epsilon(1e-12));
  // Numerical diffusion v h (1 - v dt/h) / 2 of an explicit step; the block has w^2/12 less h^2/12.
  const double h = 1.0 / k_cells;
  const double courant = k_speed * 0.5 / 200 / h;
  const double expected = (0.01 - h * h) / 12.0 + k_speed * h * (1.0 - courant) * 0.5;
  CHECK(square - middle * middle == test::approx(expected).epsilon(1e-9));
}

TEST_CASE("what a belt takes out of the domain shall be counted, all of it") {
  Carried c = flat_belt(50, false);
  for (std::size_t i = 0; i < 50; ++i) c.layers.add(i, 0, 0.02);
  c.run(0.5, 100);
  // An even layer leaves at its rate until its end comes near.
  CHECK(c.out[0][0] == test::approx(k_speed * 0.5).epsilon(1e-3));
  CHECK(c.mass() + c.out[0][0] == test::approx(1.0).epsilon(1e-14));
  c.run(3.0, 600);
  CHECK(c.mass() < 1e-14);
  CHECK(c.out[0][0] == test::approx(1.0).epsilon(1e-12));
}

TEST_CASE("what lies on a surface that ends before a side shall wait there, not leave") {
  Carried c = flat_belt(50, false, false);
  for (std::size_t i = 0; i < 50; ++i) c.layers.add(i, 0, 0.02);
  c.run(3.0, 600);
  CHECK(c.out[0][0] == 0.0);
  CHECK(c.mass() == test::approx(1.0).epsilon(1e-13));
  CHECK(c.layers.on(49)[0] == test::approx(1.0).epsilon(1e-12));
}

TEST_CASE("a step of many cells shall lose nothing") {
  Carried c = flat_belt(50, true);
  c.layers.add(7, 0, 1.0);
  c.run(2.0, 1);
  CHECK(c.mass() == test::approx(1.0).epsilon(1e-13));
  for (const double lies : c.layers.rows()) CHECK(lies >= 0.0);
}

TEST_CASE("what lies on a drum shall turn with it") {
  constexpr int k_cells = 60;
  constexpr double k_radius = 0.35;
  Carried c(
      Grid::make({0, 0, 0}, {1, 1.0 / k_cells, 1}, {k_cells, 1, k_cells}, {false, true, false}));
  const double h = c.grid.spacing.x;
  std::vector<double> angles;
  // Pieces where the circle passes a cell, as long as it is there.
  constexpr int k_parts = 40'000;
  std::vector<double> length(c.grid.size, 0.0);
  for (int n = 0; n < k_parts; ++n) {
    const double a = 2.0 * std::numbers::pi * (n + 0.5) / k_parts;
    const int i = static_cast<int>((0.5 + k_radius * std::cos(a)) / h);
    const int k = static_cast<int>((0.5 + k_radius * std::sin(a)) / h);
    length[static_cast<std::size_t>(c.grid.index(i, 0, k))] +=
        2.0 * std::numbers::pi * k_radius / k_parts;
  }
  for (int k = 0; k < k_cells; ++k) {
    for (int i = 0; i < k_cells; ++i) {
      const double along = length[static_cast<std::size_t>(c.grid.index(i, 0, k))];
      if (!(along > 0.0)) continue;
      const Vec3 from = c.grid.centre(i, 0, k) - Vec3{0.5, c.grid.centre(i, 0, k).y, 0.5};
      const Vec3 normal = from / norm(from);
      c.add_piece({i, 0, k}, c.grid.centre(i, 0, k) + (k_radius - norm(from)) * normal,
                  along * c.grid.spacing.y * normal, k_speed * Vec3{-normal.z, 0, normal.x});
      angles.push_back(std::atan2(normal.z, normal.x));
    }
  }
  c.prepare();
  const std::size_t first = static_cast<std::size_t>(
      std::min_element(angles.begin(), angles.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      angles.begin());
  c.layers.add(first, 0, 1.0);
  c.run(1.0, 400);
  double x = 0.0;
  double z = 0.0;
  for (std::size_t n = 0; n < angles.size(); ++n) {
    x += c.layers.on(n)[0] * std::cos(angles[n]);
    z += c.layers.on(n)[0] * std::sin(angles[n]);
  }
  CHECK(c.mass() == test::approx(1.0).epsilon(1e-13));
  CHECK(c.out[0][0] == 0.0);
  // 2 rad; pieces that a cell's corner cuts off are short, and known to a part only.
  CHECK(std::atan2(z, x) == test::approx(k_speed / k_radius).epsilon(0.05));
}
