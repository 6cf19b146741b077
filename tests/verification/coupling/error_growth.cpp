// SPDX-License-Identifier: Apache-2.0
#include "error_growth.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace dust::test {

double growth(const Eigen::MatrixXd& step) {
  const Eigen::VectorXcd all = step.eigenvalues();
  Eigen::Index kept = 0;
  double nearest = 1e30;
  for (Eigen::Index n = 0; n < all.size(); ++n) {
    const double off = std::abs(all[n] - 1.0);
    if (off < nearest) nearest = off, kept = n;
  }
  double most = 0.0;
  for (Eigen::Index n = 0; n < all.size(); ++n) {
    if (n != kept) most = std::max(most, std::abs(all[n]));
  }
  return most;
}

}  // namespace dust::test
