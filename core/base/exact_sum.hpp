// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::base {

/// A sum whose rounding does not grow with the number of terms: what is lost in each addition is
/// added up, too (Neumaier, Z. Angew. Math. Mech. 54 (1974) 39).
class ExactSum {
 public:
  ExactSum() = default;
  /// Goes on from a sum that was saved.
  ExactSum(double sum, double lost) : sum_(sum), lost_(lost) {}

  ExactSum& operator+=(double term) {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
    return *this;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }
  [[nodiscard]] double sum() const { return sum_; }
  [[nodiscard]] double lost() const { return lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

}  // namespace dust::base
