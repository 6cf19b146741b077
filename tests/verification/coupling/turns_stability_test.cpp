// SPDX-License-Identifier: Apache-2.0
// The step of grains and air that take turns, as a matrix, with a drag that grows faster than the
// slip (docs/decisions/0021_drag_is_given_along_its_tangent.md): which of its errors grow.
#include "error_growth.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using dust::test::Relaxation;
using State = Eigen::RowVector3d;  // u, v, o

struct Scheme {
  double least_implicit;  ///< share of the drag coefficient
  bool has_tangent;       ///< else the coefficient alone is known
};

/// Errors of one step with load `a`, `k` relaxations, drag as slip^(1 + b), `n` sub-steps of the
/// air; 0: many.
Eigen::Matrix3d step_of(double a, double k, double b, int n, bool is_held, const Scheme& scheme) {
  const State u{1, 0, 0};
  const State v{0, 1, 0};
  const State o{0, 0, 1};
  const double given = a * k * std::max(-std::expm1(-k) / k, scheme.least_implicit);
  const double known = scheme.has_tangent ? b : 0.0;
  // The coefficient is that of the slip before the step, which is in error, too.
  const double implicit = given * (1.0 + known);
  const State source = implicit * v + given * (known - b) * (u - v);
  const Relaxation left(implicit, n);
  const State steady = (source + o) / implicit;
  const State end = steady + left.end * (u - steady);
  const State mean = steady + left.mean * (u - steady);
  // A grain relaxes at the rate of the slip it begins with.
  const double gain = is_held ? k * (1.0 + b) : -std::expm1(-k) + k * std::exp(-k) * b;
  const State received = gain * (end - v);
  Eigen::Matrix3d step;
  step.row(0) = end;
  step.row(1) = is_held ? v : State(v + received);
  step.row(2) = implicit * mean - source - a * received;
  return step;
}

double largest_growth(double b, int n, bool is_held, const Scheme& scheme) {
  return dust::test::largest_growth(
      [&](double a, double k) { return step_of(a, k, b, n, is_held, scheme); });
}

TEST_CASE("no error of grains and air that take turns shall grow, with the tangent of the drag") {
  for (const bool is_held : {false, true}) {
    for (const double b : {0.0, 0.1, 0.3, 0.6, 1.0}) {
      for (const int sub_steps : {1, 2, 5, 0}) {
        CAPTURE(is_held);
        CAPTURE(b);
        CAPTURE(sub_steps);
        // Rounding of eigenvalues next to 1: the kept momentum makes a double one where drag is
        // weak.
        CHECK(largest_growth(b, sub_steps, is_held, {0.7, true}) < 1.0 + 1e-7);
      }
    }
  }
}

TEST_CASE(
    "errors shall grow with the coefficient alone from an inertia of a tenth of the drag on") {
  CHECK(largest_growth(0.05, 1, true, {0.6, false}) < 1.0 + 1e-7);
  CHECK(largest_growth(0.12, 1, true, {0.6, false}) > 1.05);
  CHECK(largest_growth(0.3, 1, true, {1.0, false}) < 1.0 + 1e-7);
  CHECK(largest_growth(0.4, 1, true, {1.0, false}) > 1.05);
}

TEST_CASE("with many sub-steps of the air 0.6 of the drag shall be too little to be implicit") {
  CHECK(largest_growth(0.0, 0, true, {0.6, true}) > 1.05);
}

}  // namespace
