// SPDX-License-Identifier: Apache-2.0
// The step of free dust beside air that is solved at the same time, as a matrix
// (docs/decisions/0014_overlap_of_air_and_grains.md): which of its errors grow.
#include "error_growth.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace {

using dust::test::approx;
using dust::test::growth;
using dust::test::Relaxation;
using State = Eigen::RowVector4d;  // u, m, v, o
enum class Shown { end_of_step, mean_of_step };

/// Errors of one step with load `a`, `k` relaxations and h = `h` over `n` sub-steps, 0: many; drag
/// as slip^(1 + b), given to the air along its tangent (decision 0021).
Eigen::Matrix4d step_of(double a, double k, double h, int n, Shown shown, double b = 0.0) {
  const State u{1, 0, 0, 0};
  const State m{0, 1, 0, 0};
  const State v{0, 0, 1, 0};
  const State o{0, 0, 0, 1};
  const double implicit = h * a * k * (1.0 + b);
  const Relaxation left(implicit, n);
  const State gap = u - v - o / implicit;
  const State mean = v + o / implicit + left.mean * gap;
  // A grain relaxes at the rate of the slip it begins with.
  const double gain = -std::expm1(-k) + k * std::exp(-k) * b;
  const State received = gain * ((shown == Shown::mean_of_step ? m : u) - v);
  Eigen::Matrix4d step;
  step.row(0) = v + o / implicit + left.end * gap;
  step.row(1) = mean;
  step.row(2) = v + received;
  step.row(3) = implicit * (mean - v) - a * received;
  return step;
}

double largest_growth(double h, int n, Shown shown, double b = 0.0) {
  return dust::test::largest_growth(
      [&](double a, double k) { return step_of(a, k, h, n, shown, b); });
}

}  // namespace

TEST_CASE("dust that is shown the mean air of the last step shall be stable beside it") {
  for (const int sub_steps : {1, 2, 5, 0}) {
    for (const double h : {1.0, 1.5, 2.0, 3.0, 4.0}) {
      CAPTURE(sub_steps);
      CAPTURE(h);
      // Rounding of eigenvalues next to 1: the kept momentum makes a double one where drag is weak.
      CHECK(largest_growth(h, sub_steps, Shown::mean_of_step) < 1.0 + 1e-7);
    }
  }
}

TEST_CASE("dust whose drag grows faster than its slip shall be stable beside it, too") {
  for (const int sub_steps : {1, 2, 5, 0}) {
    for (const double b : {0.1, 0.3, 0.6}) {
      CAPTURE(sub_steps);
      CAPTURE(b);
      CHECK(largest_growth(2.0, sub_steps, Shown::mean_of_step, b) < 1.0 + 1e-7);
    }
    // Steeper still: dense beds of grains that relax more than once in a step would ring.
    CHECK(growth(step_of(3000.0, 1.0, 2.0, sub_steps, Shown::mean_of_step, 1.0)) < 1.0);
    CHECK(growth(step_of(1e5, 2.0, 2.0, sub_steps, Shown::mean_of_step, 1.0)) > 1.05);
  }
}

TEST_CASE("dust that is shown the air at the end of the step shall not be stable beside it") {
  CHECK(largest_growth(2.0, 2, Shown::end_of_step) == approx(1.02).epsilon(0.01));
  double most = 0.0;
  for (const double h : {1.0, 1.5, 2.0, 3.0, 4.0}) {
    most = std::max(most, largest_growth(h, 0, Shown::end_of_step));
  }
  CHECK(most == approx(1.12).epsilon(0.01));
}

TEST_CASE("22 kg of dust per kg of air that relaxes five times in the step shall ring") {
  CHECK(growth(step_of(22.0, 5.0, 2.0, 5, Shown::mean_of_step)) == approx(0.95).epsilon(0.01));
}
