// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace dust::model::trajectory {

/// A weighted sample sorted by value, ready for quantiles.
struct SortedSample {
  std::vector<double> value;       ///< ascending
  std::vector<double> weight;      ///< > 0
  std::vector<std::size_t> block;  ///< time block of each value, 0 <= block < blocks
  double total_weight = 0.0;
};

/// Sorts values with their weights and time blocks; equal values keep their order.
inline SortedSample sorted(std::span<const double> values, std::span<const double> weights,
                           std::span<const std::size_t> blocks) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  SortedSample sample;
  for (const std::size_t i : order) {
    sample.value.push_back(values[i]);
    sample.weight.push_back(weights[i]);
    sample.block.push_back(blocks[i]);
    sample.total_weight += weights[i];
  }
  return sample;
}

/// Weighted quantile: the value below which the share p of the weight lies.
///
/// Value i stands at the share \f$ (W_i - w_i/2)/W \f$ with the running sum \f$ W_i \f$ and the
/// total \f$ W \f$ (Hazen's plotting position with weights); linear in between, the outermost
/// values beyond. @return in the unit of the values; sdk::k_no_value for an empty sample.
/// Source: Hyndman and Fan (1996), definition 5, doi:10.1080/00031305.1996.10473566.
inline double quantile(const SortedSample& s, double p) {
  if (s.value.empty()) return sdk::k_no_value;
  const double wanted = p * s.total_weight;
  double below = 0.0;
  double share_before = 0.0;
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    const double share = below + 0.5 * s.weight[i];
    if (share >= wanted) {
      if (i == 0) return s.value[0];
      const double f = (wanted - share_before) / (share - share_before);
      return s.value[i - 1] + f * (s.value[i] - s.value[i - 1]);
    }
    below += s.weight[i];
    share_before = share;
  }
  return s.value.back();
}

/// Standard error of the weighted share below the quantile, from sums over time blocks.
///
/// \f$ \sigma_F^2 = \frac{B}{B-1} \sum_b (A_b - \bar A)^2 / W^2 \f$ with
/// \f$ A_b = \sum_{i \in b} w_i (I(x_i \le q) - p) \f$ : the ratio estimator linearised, so that
/// fluctuations of the flow count as well as those of the positions, and grains that cross together
/// are not taken for independent ones.
/// @param blocks  number B of time blocks; -1 is returned below 8
inline double share_error(const SortedSample& s, double q, double p, std::size_t blocks) {
  constexpr std::size_t k_min_blocks = 8;
  if (blocks < k_min_blocks || s.total_weight <= 0.0) return -1.0;
  std::vector<double> sums(blocks, 0.0);
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    sums[s.block[i]] += s.weight[i] * ((s.value[i] <= q ? 1.0 : 0.0) - p);
  }
  const double n = static_cast<double>(blocks);
  const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / n;
  double squares = 0.0;
  for (const double a : sums) squares += (a - mean) * (a - mean);
  return std::sqrt(n / (n - 1.0) * squares) / s.total_weight;
}

/// Standard error of a quantile by inverting the error of the share:
/// \f$ \sigma_q = \frac12 [Q(p + \sigma_F) - Q(p - \sigma_F)] \f$.
/// @return -1 for fewer than 10 values or without an error of the share
/// Source: Woodruff (1952), doi:10.1080/01621459.1952.10483443.
inline double quantile_error(const SortedSample& s, double p, std::size_t blocks) {
  constexpr std::size_t k_min_values = 10;
  if (s.value.size() < k_min_values) return -1.0;
  const double share = share_error(s, quantile(s, p), p, blocks);
  if (share < 0.0) return -1.0;
  return 0.5 * (quantile(s, std::min(p + share, 1.0)) - quantile(s, std::max(p - share, 0.0)));
}

}  // namespace dust::model::trajectory
