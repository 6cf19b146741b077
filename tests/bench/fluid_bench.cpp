// SPDX-License-Identifier: Apache-2.0
// Times of the pressure solve and of whole fluid steps at the size of the transfer point:
//   fluid_bench [threads] [steps] [cells across]
#include "bench/still_side.hpp"
#include "dust/sdk/parameter_schema.hpp"
#include "fluid/fluid_solver.hpp"
#include "fluid/pressure/pressure_solver.hpp"

#include <tbb/global_control.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <random>

using namespace dust;
using sdk::Vec3;

namespace {

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Belt final : public sdk::Motion {
 public:
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      const Vec3 t = 0.8 * cross(b.axis, b.normal[n]);
      b.velocity.set(n, t);
    }
  }
  [[nodiscard]] double largest_speed() const override { return 0.8; }
};

bodies::BodySet belt() {
  bodies::BodySet set;
  for (const auto& kind : bodies::shape_catalogue()) {
    if (kind.name != "conveyor") continue;
    bodies::Body body;
    body.name = "belt";
    const std::vector<sdk::Value> values = {Vec3{0.08, 0, 0.158}, Vec3{-1.02, 0, 0.158}, 0.039,
                                            0.003};
    body.shape = kind.make(values);
    body.motions.push_back(std::make_unique<Belt>());
    set.push_back(std::move(body));
  }
  return set;
}

/// Noisy bed in the lower half, free above, one open side: as the prototype measured.
void pressure(std::array<int, 3> cells) {
  const auto grid = fluid::Grid::make({0, 0, 0}, {0.33, 0.011, 0.35}, cells, {false, false, false});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  fluid::CellField eps(grid.size, 1.0);
  fluid::FaceField pattern(grid);
  const auto is_solid = [&](Vec3 p) {
    return std::hypot(std::max(p.x - 0.08, 0.0), p.z - 0.158) < 0.042 ||
           (std::abs(p.x - 0.2) < 0.002 && p.z > 0.1 && p.z < 0.25);
  };
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        const auto o = grid.index(i, j, k);
        eps[o] = k < cells[2] / 2 ? 0.4 + 0.15 * uniform(random) : 0.97 + 0.03 * uniform(random);
        for (int d = 0; d < 3; ++d) {
          const std::array<int, 3> c = {i, j, k};
          Vec3 below = grid.centre(i, j, k);
          below[d] -= grid.spacing[d];
          if (c[d] == 0 || is_solid(grid.centre(i, j, k)) || is_solid(below)) continue;
          pattern.component[d][o] = 1.0;
        }
        if (k == cells[2] - 1) pattern.component[2][o + grid.stride[2]] = 1.0;
      }
    }
  }
  const double begin = wall_time();
  fluid::PressureSolver solver(grid, pattern);
  const double built = wall_time();
  for (int d = 0; d < 3; ++d) {
    for (std::size_t o = static_cast<std::size_t>(grid.stride[d]); o < grid.size; ++o) {
      const double h = grid.spacing[d];
      solver.coefficients().component[d][o] =
          pattern.component[d][o] * 0.5 * (eps[o] + eps[o - grid.stride[d]]) / (h * h);
    }
  }
  fluid::CellField b(grid.size, 0.0);
  fluid::CellField x(grid.size, 0.0);
  double best_setup = 1e9;
  double best_solve = 1e9;
  int iterations = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    for (int k = 0; k < cells[2]; ++k) {
      for (int j = 0; j < cells[1]; ++j) {
        for (int i = 0; i < cells[0]; ++i) {
          const auto o = grid.index(i, j, k);
          b[o] = solver.is_open(o) ? uniform(random) - 0.5 + (k == 0 ? 1.0 : 0.0) : 0.0;
        }
      }
    }
    const double t0 = wall_time();
    solver.prepare();
    const double t1 = wall_time();
    iterations = solver.solve(b, 1e-6, x).iterations;
    best_setup = std::min(best_setup, t1 - t0);
    best_solve = std::min(best_solve, wall_time() - t1);
  }
  std::printf(
      "pressure [%d, %d, %d]: built once %.1f ms, set-up %.2f ms, solve to 1e-6 %.1f ms, "
      "%d iterations\n",
      cells[0], cells[1], cells[2], 1e3 * (built - begin), 1e3 * best_setup, 1e3 * best_solve,
      iterations);
}

void transfer_point(int across, int steps) {
  const auto bodies = belt();
  scenario::FluidSpec fluid;
  fluid.cells = {264, across, 280};
  fluid.density = 1.2139;
  fluid.viscosity = 1.8e-5;
  const auto grid = fluid::Grid::make({0, 0, 0}, {0.33, 0.011, 0.35}, fluid.cells, {});
  using sdk::SideRule;
  const test::StillSide open({SideRule::gradient, SideRule::gradient, SideRule::pressure});
  const test::StillSide slip({SideRule::fixed, SideRule::gradient, SideRule::gradient});
  const test::StillSide wall({SideRule::fixed, SideRule::fixed, SideRule::gradient});
  const double begin = wall_time();
  fluid::FluidSolver solver(grid, fluid, bodies, {&open, &open, &slip, &slip, &wall, &wall});
  std::printf("built in %.2f s\n", wall_time() - begin);
  const fluid::CellField eps(grid.size, 1.0);
  fluid::Exchange exchange{fluid::FaceField(grid), fluid::FaceField(grid)};
  // A falling stream of sand: drag towards -2 m/s in a column right of the head pulley.
  for (int k = 0; k < 280; ++k) {
    for (int j = 0; j < across; ++j) {
      for (int i = 112; i < 120; ++i) {
        const auto o = grid.index(i, j, k);
        exchange.coefficient.component[2][o] = 20.0;
        exchange.source.component[2][o] = -40.0;
      }
    }
  }
  for (int n = 0; n < steps; ++n) {
    const double t0 = wall_time();
    const double c0 = cpu_time();
    solver.advance(n * 1e-3, 1e-3, eps, eps, exchange);
    const auto& r = solver.report();
    if (n < 5 || n % 50 == 49) {
      std::printf(
          "t = %.3f s: %.0f ms (cpu %.0f ms), %d sub-steps, %d iterations, courant %.2f, "
          "divergence %.1e, speed %.3f\n",
          (n + 1) * 1e-3, 1e3 * (wall_time() - t0), 1e3 * (cpu_time() - c0), r.sub_steps,
          r.pressure_iterations, r.courant_number, r.divergence, r.largest_speed);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 2;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 10;
  const int across = argc > 3 ? std::atoi(argv[3]) : 9;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  std::printf("%d threads\n", threads);
  pressure({264, 1, 280});
  pressure({264, 9, 280});
  transfer_point(across, steps);
}
