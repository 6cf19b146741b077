// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace dust::test {

/// Velocity of a fluid with n implicit sub-steps of a drag H towards `steady`, 0: many: what is
/// left of its distance at the end, and on the mean over the sub-steps.
struct Relaxation {
  Relaxation(double drag, int n)
      : end(n == 0 ? std::exp(-drag) : std::pow(1.0 + drag / n, -n)), mean((1.0 - end) / drag) {}
  double end, mean;
};

/// Largest growth of an error by one step, besides the 1 of the momentum that both have together.
double growth(const Eigen::MatrixXd& step);

/// The largest of make(load, relaxations per step): from dust in clean air to a bed, grains from
/// heavy to carried along.
template <class Make>
double largest_growth(const Make& make) {
  double most = 0.0;
  for (double a = 1e-3; a < 1.1e5; a *= 1.6) {
    for (double k = 1e-4; k < 1.1e3; k *= 1.6) most = std::max(most, growth(make(a, k)));
  }
  return most;
}

}  // namespace dust::test
