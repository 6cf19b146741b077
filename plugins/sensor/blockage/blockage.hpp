// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace dust::model::blockage {

/// A straight line through values over time.
struct Trend {
  double slope = 0.0;   ///< [per s]
  double error = -1.0;  ///< [per s] one standard error; negative: too few values
};

/// [unit of y per s] Least-squares slope of `y` over `t`, from `t_begin` [s] on. The values are
/// first averaged to 20 blocks, which remember each other less than they do; where neighbouring
/// residuals still do (lag-1 correlation r above \f$ 2/\sqrt{n} \f$, what chance gives in one case
/// of forty), the variance is \f$ (1+r)/(1-r) \f$ times larger (Bayley and Hammersley 1946,
/// doi:10.2307/2983560).
inline Trend trend(std::span<const double> t, std::span<const double> y, double t_begin) {
  constexpr std::size_t k_blocks = 20;
  const auto first =
      static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), t_begin) - t.begin());
  const std::size_t count = t.size() - first;
  const std::size_t size = std::max<std::size_t>(count / k_blocks, 1);
  std::vector<double> x;
  std::vector<double> v;
  for (std::size_t n = first; n + size <= t.size(); n += size) {
    double sum_x = 0.0;
    double sum_y = 0.0;
    for (std::size_t k = n; k < n + size; ++k) {
      sum_x += t[k];
      sum_y += y[k];
    }
    x.push_back(sum_x / static_cast<double>(size));
    v.push_back(sum_y / static_cast<double>(size));
  }
  const auto n = static_cast<double>(x.size());
  if (n < 3.0) return {};
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / n;
    mean_y += v[k] / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (v[k] - mean_y);
  }
  if (!(xx > 0.0)) return {};
  Trend line{xy / xx, -1.0};
  double squares = 0.0;
  double products = 0.0;
  double last = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = v[k] - mean_y - line.slope * (x[k] - mean_x);
    squares += off * off;
    products += off * last;
    last = off;
  }
  constexpr double k_min_blocks = 8.0;
  if (n < k_min_blocks) return line;
  constexpr double k_max_memory = 0.9;
  const double memory = squares > 0.0 ? std::min(products / squares, k_max_memory) : 0.0;
  const double variance = squares / (n - 2.0) / xx;
  const bool has_memory = memory > 2.0 / std::sqrt(n);
  line.error = std::sqrt(has_memory ? variance * (1.0 + memory) / (1.0 - memory) : variance);
  return line;
}

/// Whether the mass held grows for good: surely (twice its error) and by more than `share` of what
/// comes in.
constexpr bool is_filling(const Trend& mass, double inflow, double share) {
  return mass.error >= 0.0 && mass.slope > 2.0 * mass.error && mass.slope > share * inflow;
}

}  // namespace dust::model::blockage
