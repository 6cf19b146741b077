// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dust::model::gaussian {

/// Standard deviations at which the kernel ends along each axis [-].
inline constexpr double k_reach = 3.0;
/// Least standard deviation in cells: below it the kernel is narrower than the grid can show.
inline constexpr double k_min_cells = 0.5;

/// Standard deviation [m] along one axis: `width` over the diameter, at least half a cell.
inline double deviation(double width, double diameter, double spacing) {
  return std::max(width * diameter, k_min_cells * spacing);
}

/// Shares below this are what rounding leaves of a cell that the kernel's end only touches.
inline constexpr double k_nothing = 1e-14;

/// Largest number of cells along one axis that a kernel of the standard deviation `sigma` [m]
/// reaches into. Three deviations to either side are often a whole number of cells: a little more
/// than rounding takes from it is added, or one cell would be missing.
inline int most_cells(double sigma, double spacing) {
  constexpr double k_rounding = 1e-6;
  return static_cast<int>(2.0 * k_reach * sigma / spacing + k_rounding) + 2;
}

/// Shares of the cells along one axis of a truncated Gaussian; they sum to 1.
class Shares {
 public:
  /// Those of a kernel round `centre` [m] with the standard deviation `sigma` [m].
  void set(double centre, double origin, double spacing, double sigma) {
    const double end = k_reach * sigma;
    first_ = static_cast<int>(std::floor((centre - end - origin) / spacing));
    const int last = static_cast<int>(std::floor((centre + end - origin) / spacing));
    const double scale = 1.0 / (std::numbers::sqrt2 * sigma);
    const double whole = 2.0 * std::erf(k_reach / std::numbers::sqrt2);
    weights_.clear();
    double below = -std::erf(k_reach / std::numbers::sqrt2);
    for (int i = first_; i <= last; ++i) {
      const double edge = std::min(origin + (i + 1) * spacing - centre, end);
      const double above = std::erf(edge * scale);
      weights_.push_back((above - below) / whole);
      below = above;
    }
  }
  [[nodiscard]] int first() const { return first_; }  ///< cell of the first share
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }

 private:
  int first_ = 0;
  std::vector<double> weights_;
};

}  // namespace dust::model::gaussian
