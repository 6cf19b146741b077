// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dust::model::bed_height {

/// Mass of grains over height, in bins between the lowest and the highest grain.
class Profile {
 public:
  static constexpr std::size_t k_bins = 4096;

  /// `heights` [m] and `masses` [kg] of the same grains.
  Profile(const std::vector<double>& heights, const std::vector<double>& masses)
      : bins_(k_bins, 0.0) {
    if (heights.empty()) return;
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    low_ = *low;
    width_ = (*high - *low) / k_bins;
    for (std::size_t g = 0; g < heights.size(); ++g) {
      const double at = width_ > 0.0 ? (heights[g] - low_) / width_ : 0.0;
      bins_[std::min(k_bins - 1, static_cast<std::size_t>(at))] += masses[g];
      total_ += masses[g];
      moment_ += masses[g] * heights[g];
    }
  }
  /// [m] sdk::k_no_value without grains, as below().
  [[nodiscard]] double mean() const { return total_ > 0.0 ? moment_ / total_ : sdk::k_no_value; }
  /// Height [m] below which the `share` of the mass lies, to a 4096th of what the grains span; the
  /// highest grain for 1.
  [[nodiscard]] double below(double share) const {
    if (!(total_ > 0.0)) return sdk::k_no_value;
    double sum = 0.0;
    for (std::size_t b = 0; b < k_bins; ++b) {
      if (bins_[b] > 0.0 && sum + bins_[b] >= share * total_) {
        return low_ + width_ * (static_cast<double>(b) + (share * total_ - sum) / bins_[b]);
      }
      sum += bins_[b];
    }
    return low_ + width_ * k_bins;
  }

 private:
  std::vector<double> bins_;
  double low_ = 0.0;
  double width_ = 0.0;
  double total_ = 0.0;
  double moment_ = 0.0;
};

}  // namespace dust::model::bed_height
