// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/pressure_solver.hpp"

#include "dust/sdk/error.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <random>

using namespace dust;
using fluid::CellField;
using fluid::FaceField;
using fluid::Grid;

namespace {

constexpr double k_tolerance = 1e-11;

struct Problem {
  Grid grid;
  FaceField k;
  CellField b;
};

/// Random openness over four decades, a solid block, a thin wall, one open side at the top.
Problem make(std::array<int, 3> cells, std::array<bool, 3> periodic, bool has_open_side) {
  Problem p;
  p.grid = Grid::make({0, 0, 0}, {0.1, 0.02, 0.08}, cells, periodic);
  p.k = FaceField(p.grid);
  p.b.assign(p.grid.size, 0.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto is_solid = [&](int i, int, int k) {
    const double x = (i + 0.5) / cells[0];
    const double z = (k + 0.5) / cells[2];
    return (x < 0.3 && z > 0.4 && z < 0.6) || (std::abs(x - 0.7) * cells[0] < 0.6 && z > 0.2);
  };
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        const auto o = p.grid.index(i, j, k);
        for (int d = 0; d < 3; ++d) {
          std::array<int, 3> low = {i, j, k};
          const bool is_edge = low[d] == 0;
          low[d] = is_edge ? cells[d] - 1 : low[d] - 1;
          if ((is_edge && !periodic[d]) || cells[d] == 1) continue;
          if (is_solid(i, j, k) || is_solid(low[0], low[1], low[2])) continue;
          const double h = p.grid.spacing[d];
          const double value = std::pow(10.0, -3 * uniform(random)) / (h * h);
          p.k.component[d][o] = value;
          if (is_edge) p.k.component[d][o + cells[d] * p.grid.stride[d]] = value;
        }
        if (has_open_side && k == cells[2] - 1 && !is_solid(i, j, k)) {
          const double h = p.grid.spacing.z;
          p.k.component[2][o + p.grid.stride[2]] = 2 / (h * h);
        }
      }
    }
  }
  return p;
}

struct Solved {
  CellField x;
  int iterations = 0;
};

Solved solve(Problem& p, double tolerance = k_tolerance) {
  fluid::PressureSolver solver(p.grid, p.k);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < p.grid.count[2]; ++k) {
    for (int j = 0; j < p.grid.count[1]; ++j) {
      for (int i = 0; i < p.grid.count[0]; ++i) {
        const auto o = p.grid.index(i, j, k);
        p.b[o] = solver.is_open(o) ? uniform(random) : 0.0;
      }
    }
  }
  solver.coefficients() = p.k;
  solver.prepare();
  Solved s{CellField(p.grid.size, 0.0)};
  CellField b = p.b;
  s.iterations = solver.solve(b, tolerance, s.x).iterations;
  return s;
}

/// The same system by a direct solver; `pinned` fixes the first cell of a singular one.
CellField direct(const Problem& p, bool is_singular) {
  const auto& n = p.grid.count;
  const int cells = n[0] * n[1] * n[2];
  const auto number = [&](int i, int j, int k) { return i + n[0] * (j + n[1] * k); };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b(cells);
  double mean = 0.0;
  int open = 0;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const auto o = p.grid.index(i, j, k);
        double diagonal = 0.0;
        for (int d = 0; d < 3; ++d) {
          for (int high = 0; high < 2; ++high) {
            const double c = p.k.component[d][o + high * p.grid.stride[d]];
            if (c == 0.0) continue;
            diagonal += c;
            std::array<int, 3> q = {i, j, k};
            q[d] += high ? 1 : -1;
            if (q[d] < 0 || q[d] >= n[d]) {
              if (!p.grid.is_periodic[d]) continue;
              q[d] = (q[d] + n[d]) % n[d];
            }
            entries.emplace_back(number(i, j, k), number(q[0], q[1], q[2]), -c);
          }
        }
        entries.emplace_back(number(i, j, k), number(i, j, k), diagonal > 0 ? diagonal : 1.0);
        b[number(i, j, k)] = p.b[o];
        if (diagonal > 0) {
          mean += p.b[o];
          ++open;
        }
      }
    }
  }
  if (is_singular) {
    for (int c = 0; c < cells; ++c) b[c] -= mean / open;
    entries.emplace_back(0, 0, 1e4);
  }
  Eigen::SparseMatrix<double> a(cells, cells);
  a.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a);
  const Eigen::VectorXd x = factor.solve(b);
  CellField result(p.grid.size, 0.0);
  double level = 0.0;
  for (int c = 0; c < cells; ++c) level += x[c] / cells;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        result[p.grid.index(i, j, k)] = x[number(i, j, k)] - (is_singular ? level : 0.0);
      }
    }
  }
  return result;
}

double largest_difference(const Problem& p, const CellField& a, const CellField& b) {
  const fluid::PressureSolver solver(p.grid, p.k);
  double difference = 0.0;
  double scale = 0.0;
  for (std::size_t o = 0; o < p.grid.size; ++o) {
    if (!solver.is_open(static_cast<std::ptrdiff_t>(o))) continue;
    difference = std::max(difference, std::abs(a[o] - b[o]));
    scale = std::max(scale, std::abs(b[o]));
  }
  return difference / scale;
}

}  // namespace

TEST_CASE("the multigrid solver shall give what a direct solver gives") {
  constexpr double k_agreement = 1e-8;
  for (const auto& cells : {std::array<int, 3>{33, 5, 27}, {40, 1, 36}, {24, 7, 1}, {16, 16, 16}}) {
    auto p = make(cells, {false, false, false}, true);
    const auto s = solve(p);
    const double off = largest_difference(p, s.x, direct(p, false));
    MESSAGE("[" << cells[0] << ", " << cells[1] << ", " << cells[2] << "]: " << s.iterations
                << " iterations, off by " << off);
    CHECK(off < k_agreement);
    CHECK(s.iterations < 60);
  }
}

TEST_CASE("periodic directions shall be joined, also with an odd number of cells") {
  auto p = make({15, 6, 20}, {true, true, false}, true);
  const auto s = solve(p);
  CHECK(largest_difference(p, s.x, direct(p, false)) < 1e-8);
}

TEST_CASE("a closed domain shall be solved up to its mean") {
  auto p = make({24, 1, 20}, {true, false, false}, false);
  for (int d = 0; d < 3; ++d) {
    for (auto& c : p.k.component[d]) c = c > 0 ? 1.0 : 0.0;  // no solid pocket is cut off
  }
  for (int k = 0; k < 20; ++k) {
    for (int i = 0; i < 24; ++i) {
      const auto o = p.grid.index(i, 0, k);
      p.k.component[0][o] = 1.0;
      if (i == 0) p.k.component[0][p.grid.index(24, 0, k)] = 1.0;
      if (k > 0) p.k.component[2][o] = 1.0;
    }
  }
  const auto s = solve(p);
  const auto exact = direct(p, true);
  double mean = 0.0;
  for (int k = 0; k < 20; ++k) {
    for (int i = 0; i < 24; ++i) mean += s.x[p.grid.index(i, 0, k)];
  }
  CHECK(std::abs(mean) < 1e-9);
  CHECK(largest_difference(p, s.x, exact) < 1e-8);
}

TEST_CASE("a uniform right side in a closed domain shall give no pressure") {
  // Its mean goes out and leaves rounding of one sign everywhere, which has no solution.
  auto p = make({12, 9, 10}, {true, true, true}, false);
  for (auto& c : p.k.component) std::fill(c.begin(), c.end(), 1.0);
  for (const double value : {0.1, 1.0 / 3.0, -1e-9}) {
    fluid::PressureSolver solver(p.grid, p.k);
    solver.coefficients() = p.k;
    solver.prepare();
    CellField b(p.grid.size, value);
    CellField x(p.grid.size, 0.0);
    CHECK(solver.solve(b, k_tolerance, x).iterations == 0);
    for (const double value_of_x : x) REQUIRE(value_of_x == 0.0);
  }
}

TEST_CASE("the pressure shall have the same bits on one and on two threads") {
  auto p = make({64, 9, 60}, {false, false, false}, true);
  CellField x[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    x[threads - 1] = solve(p, 1e-6).x;
  }
  CHECK(x[0] == x[1]);
}
