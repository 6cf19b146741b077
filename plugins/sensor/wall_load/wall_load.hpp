// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>
#include <dust/sdk/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace dust::model::wall_load {

/// Torque about `about` [m] from that about the origin: \f$ T_p = T_0 - p \times F \f$.
inline sdk::Vec3 torque_about(sdk::Vec3 about, sdk::Vec3 torque, sdk::Vec3 force) {
  return torque - cross(about, force);
}

/// Bins of equal width in the logarithm of the energy, from `least` to `largest` [J]; what lies
/// below or above falls into the first or the last.
struct Bins {
  double least = 1e-12;
  double largest = 1.0;
  std::size_t count = 48;

  [[nodiscard]] std::size_t index(double energy) const {
    if (!(energy > least)) return 0;
    const double share = std::log(energy / least) / std::log(largest / least);
    return std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
  }
  /// [J] geometric middle of a bin.
  [[nodiscard]] double middle(std::size_t bin) const {
    return least *
           std::pow(largest / least, (static_cast<double>(bin) + 0.5) / static_cast<double>(count));
  }
  /// [J] Middle of the bin that holds the median of counts; sdk::k_no_value without counts.
  [[nodiscard]] double median(std::span<const double> counts) const {
    double total = 0.0;
    for (const double c : counts) total += c;
    double sum = 0.0;
    for (std::size_t b = 0; b < counts.size(); ++b) {
      sum += counts[b];
      if (total > 0.0 && sum >= 0.5 * total) return middle(b);
    }
    return sdk::k_no_value;
  }
};

}  // namespace dust::model::wall_load
