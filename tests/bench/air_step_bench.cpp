// SPDX-License-Identifier: Apache-2.0
// Whole fluid steps of the belt box, for the comparison with other solvers:
//   air_step_bench [cells across] [steps] [threads] [pressure tolerance]
// 330 x 11 x 350 mm of air with a belt in its lower left corner (80 mm long, its top at 200 mm,
// 0.8 m/s), open to the left and right, steps of 1 ms. Prints one line: seconds per step of the
// second half of the run, processor time and wall time, and what the steps did.
#include "bench/still_side.hpp"
#include "fluid/fluid_solver.hpp"

#include <tbb/global_control.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>

using namespace dust;
using sdk::Vec3;

namespace {

constexpr double k_step = 1e-3;
constexpr Vec3 k_size{0.33, 0.011, 0.35};

/// Everything below the top and left of the front of the belt.
class Block final : public bodies::OnePart<Block> {
 public:
  [[nodiscard]] bodies::SurfacePoint nearest(Vec3 p) const override {
    const double over_x = p.x - 0.08;
    const double over_z = p.z - 0.2;
    if (over_x > 0.0 && over_z > 0.0) {
      const double r = std::hypot(over_x, over_z);
      return {r, {over_x / r, 0.0, over_z / r}};
    }
    return over_x > over_z ? bodies::SurfacePoint{over_x, {1, 0, 0}}
                           : bodies::SurfacePoint{over_z, {0, 0, 1}};
  }
  [[nodiscard]] bodies::Triangles triangles(Vec3, Vec3, double) const override { return {}; }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }
};

/// The top runs to the right; the front stands.
class Belt final : public sdk::Motion {
 public:
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      b.velocity.x[n] = b.normal.z[n] > 0.9 ? 0.8 : 0.0;
      b.velocity.y[n] = b.velocity.z[n] = 0.0;
    }
  }
  [[nodiscard]] double largest_speed() const override { return 0.8; }
};

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Mean over the domain of |div u| step: what is called the local continuity error elsewhere.
double continuity_error(const fluid::FluidSolver& solver, const fluid::Grid& grid) {
  double sum = 0.0;
  int cells = 0;
  const auto& u = solver.velocity();
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::ptrdiff_t o = grid.index(i, j, k);
        if (solver.open_fraction()[o] < 1.0) continue;
        double divergence = 0.0;
        for (int d = 0; d < 3; ++d) {
          divergence += (u.component[d][o + grid.stride[d]] - u.component[d][o]) / grid.spacing[d];
        }
        sum += std::abs(divergence);
        ++cells;
      }
    }
  }
  return k_step * sum / cells;
}

}  // namespace

int main(int argc, char** argv) {
  const int across = argc > 1 ? std::atoi(argv[1]) : 1;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 200;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 1;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  bodies::BodySet bodies(1);
  bodies[0].name = "belt";
  bodies[0].shape = std::make_unique<Block>();
  bodies[0].motions.push_back(std::make_unique<Belt>());
  scenario::FluidSpec fluid;
  fluid.cells = {264, across, 280};
  fluid.density = 1.2139;
  fluid.viscosity = 1.8e-5;
  if (argc > 4) fluid.pressure_tolerance = std::atof(argv[4]);
  const auto grid = fluid::Grid::make({0, 0, 0}, k_size, fluid.cells, {});
  using sdk::SideRule;
  const test::StillSide open({SideRule::gradient, SideRule::gradient, SideRule::pressure});
  const test::StillSide slip({SideRule::fixed, SideRule::gradient, SideRule::gradient});
  const test::StillSide wall({SideRule::fixed, SideRule::fixed, SideRule::gradient});
  fluid::FluidSolver solver(grid, fluid, bodies, {&open, &open, &slip, &slip, &wall, &wall});
  const fluid::CellField eps(grid.size, 1.0);
  const fluid::Exchange exchange{fluid::FaceField(grid), fluid::FaceField(grid)};
  double cpu = 0.0;
  double wall_seconds = 0.0;
  int sub_steps = 0;
  int iterations = 0;
  const int half = steps / 2;
  for (int n = 0; n < steps; ++n) {
    if (n == half) {
      cpu = cpu_time();
      wall_seconds = wall_time();
      sub_steps = iterations = 0;
    }
    solver.advance(n * k_step, k_step, eps, eps, exchange);
    sub_steps += solver.report().sub_steps;
    iterations += solver.report().pressure_iterations;
  }
  const double counted = steps - half;
  std::printf(
      "cells [264, %d, 280] threads %d cpu_s_per_step %.5f wall_s_per_step %.5f sub_steps %.2f "
      "iterations %.1f speed %.4f continuity %.2e\n",
      across, threads, (cpu_time() - cpu) / counted, (wall_time() - wall_seconds) / counted,
      sub_steps / counted, iterations / counted, solver.report().largest_speed,
      continuity_error(solver, grid));
}
