// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dust::sdk {

/// Straight lines through points, constant before the first and after the last; 1 everywhere
/// without points. For values given over time or place as two lists of a scenario.
class Table {
 public:
  Table() = default;
  /// Throws ParameterError, with the names the lists have in the scenario, where they differ in
  /// length or `at` does not grow.
  Table(std::vector<double> at, std::vector<double> values, const std::string& at_name,
        const std::string& values_name)
      : at_(std::move(at)), values_(std::move(values)) {
    if (at_.size() != values_.size()) {
      throw ParameterError(at_name + " and " + values_name + " differ in length: give one of " +
                           values_name + " for each of " + at_name);
    }
    for (std::size_t n = 1; n < at_.size(); ++n) {
      if (!(at_[n] > at_[n - 1])) {
        throw ParameterError(at_name + " must grow from one entry to the next");
      }
    }
  }

  [[nodiscard]] bool is_empty() const { return at_.empty(); }
  [[nodiscard]] double operator()(double x) const {
    if (at_.empty()) return 1.0;
    if (x <= at_.front()) return values_.front();
    if (x >= at_.back()) return values_.back();
    const auto above =
        static_cast<std::size_t>(std::upper_bound(at_.begin(), at_.end(), x) - at_.begin());
    const double share = (x - at_[above - 1]) / (at_[above] - at_[above - 1]);
    return values_[above - 1] + share * (values_[above] - values_[above - 1]);
  }
  /// Mean from `from` to `to`: exact, and bit for bit the value where that does not vary.
  [[nodiscard]] double mean(double from, double to) const {
    const double first = (*this)(from);
    if (!(to > from)) return first;
    double sum = 0.0;
    double below = from;
    for (const double knot : at_) {
      if (knot <= from || knot >= to) continue;
      sum += (knot - below) * (0.5 * ((*this)(below) + (*this)(knot)) - first);
      below = knot;
    }
    sum += (to - below) * (0.5 * ((*this)(below) + (*this)(to)) - first);
    return first + sum / (to - from);
  }

 private:
  std::vector<double> at_;
  std::vector<double> values_;
};

}  // namespace dust::sdk
