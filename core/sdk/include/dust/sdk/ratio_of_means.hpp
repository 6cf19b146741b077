// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sampling.hpp"

#include <cstddef>

namespace dust::sdk {

/// Standard error of the figure mean(top) / mean(base), in its unit: BatchMeans::ratio_error. Where
/// mean(top) has none, its ratio has none either, and for the same reason: the residuals of a feed
/// that comes in lumps scatter so much that what the top remembers is lost in them, and a mean that
/// has not settled would look settled once it is divided.
[[nodiscard]] inline double error_of_ratio(const BatchMeans& means, std::size_t top,
                                           std::size_t base) {
  const double of_top = means.error(top);
  return of_top < 0.0 ? of_top : means.ratio_error(top, base);
}

}  // namespace dust::sdk
