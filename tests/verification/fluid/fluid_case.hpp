// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/memory_archive.hpp"
#include "fluid/fluid_solver.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dust::test {

using sdk::Vec3;

/// A side with rules and values of a test's choice.
class TestSide final : public sdk::BoundaryCondition {
 public:
  sdk::SideRules side_rules;
  std::function<Vec3(Vec3, double)> velocity = [](Vec3, double) { return Vec3{}; };
  std::function<double(Vec3, double)> pressure = [](Vec3, double) { return 0.0; };

  [[nodiscard]] sdk::SideRules rules() const override { return side_rules; }
  void evaluate(const sdk::SideBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      const Vec3 p = b.position[n];
      const Vec3 v = velocity(p, b.time);
      b.velocity.set(n, v);
      b.pressure[n] = pressure(p, b.time);
    }
  }
};

inline std::unique_ptr<TestSide> wall(Vec3 velocity = {}) {
  auto s = std::make_unique<TestSide>();
  s->side_rules = {sdk::SideRule::fixed, sdk::SideRule::fixed, sdk::SideRule::gradient};
  s->velocity = [velocity](Vec3, double) { return velocity; };
  return s;
}
inline std::unique_ptr<TestSide> slip() {
  auto s = wall();
  s->side_rules.tangential_velocity = sdk::SideRule::gradient;
  return s;
}
inline std::unique_ptr<TestSide> open_side(double pressure, bool is_total) {
  auto s = std::make_unique<TestSide>();
  s->side_rules = {sdk::SideRule::gradient, sdk::SideRule::gradient,
                   is_total ? sdk::SideRule::pressure : sdk::SideRule::fixed};
  s->pressure = [pressure](Vec3, double) { return pressure; };
  return s;
}

/// A solver with everything it needs. Sides left out are periodic.
struct Case {
  Vec3 min;
  Vec3 max{1, 1, 1};
  std::array<int, 3> cells{1, 1, 1};
  scenario::FluidSpec fluid;
  bodies::BodySet bodies;
  std::array<std::unique_ptr<TestSide>, 6> sides;

  fluid::Grid grid;
  fluid::CellField eps;
  fluid::Exchange exchange;
  std::unique_ptr<fluid::FluidSolver> solver;
  double time = 0.0;

  void start() {
    std::array<bool, 3> periodic{};
    fluid::Boundaries boundaries{};
    for (int s = 0; s < 6; ++s) {
      boundaries[s] = sides[s].get();
      if (!sides[s]) periodic[s / 2] = true;
    }
    fluid.cells = cells;
    grid = fluid::Grid::make(min, max, cells, periodic);
    eps.assign(grid.size, 1.0);
    exchange = {fluid::FaceField(grid), fluid::FaceField(grid)};
    solver = std::make_unique<fluid::FluidSolver>(grid, fluid, bodies, boundaries);
  }
  void advance(double step) {
    solver->advance(time, step, eps, eps, exchange);
    time += step;
  }
  void advance_to(double end, double step) {
    const int n = static_cast<int>(std::lround((end - time) / step));
    for (int i = 0; i < n; ++i) advance(step);
  }
  void set_source(Vec3 force) {
    for (int d = 0; d < 3; ++d) {
      exchange.source.component[d].assign(grid.size, force[d]);
    }
  }
  [[nodiscard]] double u(int d, int i, int j, int k) const {
    return solver->velocity().component[d][grid.index(i, j, k)];
  }
  [[nodiscard]] double p(int i, int j, int k) const {
    return solver->pressure()[grid.index(i, j, k)];
  }
  /// Calls body(d, i, j, k, place, value) for the faces inside and on the domain.
  template <class Body>
  void each_face(int d, const Body& body) const {
    for (int k = 0; k < cells[2]; ++k) {
      for (int j = 0; j < cells[1]; ++j) {
        for (int i = 0; i < cells[0]; ++i) body(i, j, k, grid.face(d, i, j, k), u(d, i, j, k));
      }
    }
  }
};

/// Order between errors at two resolutions a factor 2 apart.
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }

using contract::MemoryArchive;

/// Open volume [m3] of the grid.
inline double open_volume(const Case& c) {
  double sum = 0.0;
  for (int k = 0; k < c.cells[2]; ++k) {
    for (int j = 0; j < c.cells[1]; ++j) {
      for (int i = 0; i < c.cells[0]; ++i) {
        sum += c.solver->open_fraction()[c.grid.index(i, j, k)];
      }
    }
  }
  return sum * c.grid.cell_volume();
}

}  // namespace dust::test
