// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/pressure_solver.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/plugin.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace dust::fluid {
namespace {

constexpr int k_max_iterations = 200;
/// Rounding of a mean over a million cells and more.
constexpr double k_rounding = 1e-12;

DUST_KERNEL void to_float_row(int n, double scale, const double* from, float* to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) to[i] = static_cast<float>(scale * from[i]);
}

// Lanes are added in a fixed pattern (eight partial sums), so the vector width does not matter.
template <class Term>
inline __attribute__((always_inline)) double lane_sum(int n, const Term& term) {
  double s[8] = {};
  int i = 0;
  for (; i + 8 <= n; i += 8) {
    for (int l = 0; l < 8; ++l) s[l] += term(i + l);
  }
  for (int l = 0; i < n; ++i, ++l) s[l] += term(i);
  return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

DUST_KERNEL double dot_row(int n, const double* a, const float* b) {
  return lane_sum(n, [=](int i) { return a[i] * static_cast<double>(b[i]); });
}

DUST_KERNEL double square_row(int n, const double* a) {
  return lane_sum(n, [=](int i) { return a[i] * a[i]; });
}

DUST_KERNEL void direction_row(int n, double beta, const float* z, double* p) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) p[i] = static_cast<double>(z[i]) + beta * p[i];
}

DUST_KERNEL double apply_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, const double* ax,
                             const double* ay, const double* az, const double* x, double* y) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    y[i] = ax[i] * (x[i] - x[i - 1]) + ax[i + 1] * (x[i] - x[i + 1]) + ay[i] * (x[i] - x[i - sy]) +
           ay[i + sy] * (x[i] - x[i + sy]) + az[i] * (x[i] - x[i - sz]) +
           az[i + sz] * (x[i] - x[i + sz]);
  }
  return lane_sum(n, [=](int i) { return x[i] * y[i]; });
}

DUST_KERNEL double flat_apply_row(int n, std::ptrdiff_t sz, const double* ax, const double* az,
                                  const double* x, double* y) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    y[i] = ax[i] * (x[i] - x[i - 1]) + ax[i + 1] * (x[i] - x[i + 1]) + az[i] * (x[i] - x[i - sz]) +
           az[i + sz] * (x[i] - x[i + sz]);
  }
  return lane_sum(n, [=](int i) { return x[i] * y[i]; });
}

DUST_KERNEL double update_row(int n, double alpha, const double* p, const double* q, double* x,
                              double* r) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    x[i] += alpha * p[i];
    r[i] -= alpha * q[i];
  }
  return lane_sum(n, [=](int i) { return r[i] * r[i]; });
}

}  // namespace

PressureSolver::PressureSolver(const Grid& grid, const FaceField& pattern)
    : grid_(grid), k_(grid), direction_(grid.size, 0.0), image_(grid.size, 0.0) {
  find_regions(pattern);
  MultigridLevel finest;
  finest.count = grid.count;
  finest.is_periodic = grid.is_periodic;
  finest.stride = grid.stride;
  finest.start = grid.index(0, 0, 0);
  for (int d = 0; d < 3; ++d) {
    finest.spacing[d] = grid.spacing[d];
    finest.face[d].assign(grid.size, 0.0F);
    for (std::size_t o = 0; o < grid.size; ++o) {
      finest.face[d][o] = pattern.component[d][o] > 0.0 ? 1.0F : 0.0F;
    }
  }
  const auto& across = finest.face[1];
  finest.is_flat = grid.count[1] == 1 &&
                   std::all_of(across.begin(), across.end(), [](float a) { return a == 0.0F; });
  is_flat_ = finest.is_flat;
  finest.inverse_diagonal.assign(grid.size, 0.0F);
  finest.x.assign(grid.size, 0.0F);
  finest.b.assign(grid.size, 0.0F);
  finest.mask.assign(grid.size, 1.0F);
  multigrid_ = std::make_unique<Multigrid>(std::move(finest));
}

void PressureSolver::find_regions(const FaceField& pattern) {
  const auto& n = grid_.count;
  region_.assign(grid_.size, -1);
  std::vector<std::array<int, 3>> stack;
  std::int32_t region = 0;
  const auto open_sum = [&](std::ptrdiff_t o) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      sum += pattern.component[d][o] + pattern.component[d][o + grid_.stride[d]];
    }
    return sum;
  };
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const std::ptrdiff_t first = grid_.index(i, j, k);
        if (region_[first] >= 0 || !(open_sum(first) > 0.0)) continue;
        bool is_anchored = false;
        region_[first] = region;
        stack.push_back({i, j, k});
        while (!stack.empty()) {
          const auto cell = stack.back();
          stack.pop_back();
          const std::ptrdiff_t o = grid_.index(cell[0], cell[1], cell[2]);
          for (int d = 0; d < 3; ++d) {
            for (int side = 0; side < 2; ++side) {
              if (!(pattern.component[d][o + side * grid_.stride[d]] > 0.0)) continue;
              auto next = cell;
              next[d] += side == 1 ? 1 : -1;
              if (next[d] < 0 || next[d] >= n[d]) {
                if (!grid_.is_periodic[d]) {
                  is_anchored = true;
                  continue;
                }
                next[d] = (next[d] + n[d]) % n[d];
              }
              const std::ptrdiff_t q = grid_.index(next[0], next[1], next[2]);
              if (region_[q] >= 0) continue;
              region_[q] = region;
              stack.push_back(next);
            }
          }
        }
        if (!is_anchored) singular_regions_.push_back(region);
        ++region;
      }
    }
  }
}

std::int32_t PressureSolver::room(std::ptrdiff_t cell) const {
  const auto at = std::lower_bound(singular_regions_.begin(), singular_regions_.end(),
                                   region_[static_cast<std::size_t>(cell)]);
  if (at == singular_regions_.end() || *at != region_[static_cast<std::size_t>(cell)]) return -1;
  return static_cast<std::int32_t>(at - singular_regions_.begin());
}

void PressureSolver::prepare() {
  MultigridLevel& f = multigrid_->finest();
  const auto& n = grid_.count;
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> faces = n;
    faces[d] += 1;
    for_rows(faces[0], faces[1], faces[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      to_float_row(faces[0], 1.0, &k_.component[d][o], &f.face[d][o]);
    });
  }
  multigrid_->prepare();
}

void PressureSolver::take_mean_out(CellField& values) const {
  const auto& n = grid_.count;
  for (const std::int32_t region : singular_regions_) {
    double sum = 0.0;
    double cells = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
          const std::ptrdiff_t o = grid_.index(0, j, k);
          for (int i = 0; i < n[0]; ++i) {
            if (region_[o + i] != region) continue;
            if (pass == 0) {
              sum += values[o + i];
              cells += 1.0;
            } else {
              values[o + i] -= sum / cells;
            }
          }
        }
      }
    }
  }
}

void PressureSolver::wrap(CellField& values) const {
  const auto& n = grid_.count;
  for (int d = 0; d < 3; ++d) {
    if (!grid_.is_periodic[d]) continue;
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const std::ptrdiff_t s = grid_.stride[d];
    for (int a = 0; a < n[e]; ++a) {
      for (int b = 0; b < n[f]; ++b) {
        const std::ptrdiff_t o = grid_.index(0, 0, 0) + a * grid_.stride[e] + b * grid_.stride[f];
        values[o - s] = values[o + (n[d] - 1) * s];
        values[o + n[d] * s] = values[o];
      }
    }
  }
}

/// Brings a right side without a mean, which a pressure without a datum needs; returns the square
/// of what is left by rounding, which no pressure can balance.
double PressureSolver::make_solvable(CellField& r) {
  if (!is_singular()) return 0.0;
  const double nothing = k_rounding * k_rounding * squares(r);
  // The second time the rounding of the first: it has no solution either, and is not small when
  // the mean was large.
  take_mean_out(r);
  take_mean_out(r);
  return nothing;
}

double PressureSolver::squares(const CellField& r) {
  const auto& n = grid_.count;
  return sum_rows(n[0], n[1], n[2], partial_,
                  [&](int j, int k) { return square_row(n[0], &r[grid_.index(0, j, k)]); });
}

/// The finest level's x is about the solution for `r`, brought to a norm of about 1: single
/// precision has a small range.
void PressureSolver::precondition(const CellField& r, double scale) {
  const auto& n = grid_.count;
  MultigridLevel& f = multigrid_->finest();
  for_rows(n[0], n[1], n[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    to_float_row(n[0], scale, &r[o], &f.b[o]);
  });
  multigrid_->cycle();
}

/// image_ = the equation's left side for the direction p; returns their product.
double PressureSolver::apply(const CellField& p) {
  const auto& n = grid_.count;
  const std::ptrdiff_t sy = grid_.stride[1];
  const std::ptrdiff_t sz = grid_.stride[2];
  return sum_rows(n[0], n[1], n[2], partial_, [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    if (is_flat_) {
      return flat_apply_row(n[0], sz, &k_.component[0][o], &k_.component[2][o], &p[o], &image_[o]);
    }
    return apply_row(n[0], sy, sz, &k_.component[0][o], &k_.component[1][o], &k_.component[2][o],
                     &p[o], &image_[o]);
  });
}

PressureSolver::Result PressureSolver::solve(CellField& b, double tolerance, CellField& x) {
  const auto& n = grid_.count;
  CellField& r = b;
  CellField& p = direction_;
  MultigridLevel& f = multigrid_->finest();
  std::fill(x.begin(), x.end(), 0.0);
  std::fill(p.begin(), p.end(), 0.0);
  const auto sum = [&](const auto& body) { return sum_rows(n[0], n[1], n[2], partial_, body); };
  const auto at = [&](int j, int k) { return grid_.index(0, j, k); };

  const double nothing = make_solvable(r);
  const double bb = squares(r);
  Result result;
  if (!std::isfinite(bb)) {
    throw sdk::ModelError("the pressure equation has a right side that is not finite");
  }
  if (bb <= nothing) return result;
  const double scale = 1.0 / std::sqrt(bb);
  double rz = 0.0;
  double rr = bb;
  while (rr > tolerance * tolerance * bb) {
    if (result.iterations == k_max_iterations) {
      throw sdk::ModelError("the pressure equation did not converge in " +
                            std::to_string(k_max_iterations) + " iterations, residual " +
                            std::to_string(std::sqrt(rr / bb)) +
                            " of the right side; a larger fluid.pressure_tolerance or fewer "
                            "cells of very different openness may help");
    }
    ++result.iterations;
    precondition(r, scale);
    const double rz_new =
        sum([&](int j, int k) { return dot_row(n[0], &r[at(j, k)], &f.x[at(j, k)]); });
    const double beta = result.iterations == 1 ? 0.0 : rz_new / rz;
    rz = rz_new;
    for_rows(n[0], n[1], n[2],
             [&](int j, int k) { direction_row(n[0], beta, &f.x[at(j, k)], &p[at(j, k)]); });
    wrap(p);
    const double alpha = rz / apply(p);
    rr = sum([&](int j, int k) {
      const std::ptrdiff_t o = at(j, k);
      return update_row(n[0], alpha, &p[o], &image_[o], &x[o], &r[o]);
    });
    if (!std::isfinite(rr)) throw sdk::ModelError("the pressure equation broke down (not finite)");
  }
  if (is_singular()) take_mean_out(x);
  result.relative_residual = std::sqrt(rr / bb);
  return result;
}

}  // namespace dust::fluid
