// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::spillage {

constexpr double k_seconds_per_hour = 3600.0;

/// [kg/h] of `mass` [kg] in `duration` [s].
constexpr double per_hour(double mass, double duration) {
  return duration > 0.0 ? k_seconds_per_hour * mass / duration : 0.0;
}

/// One standard error [kg] of a counted mass: grains that come one by one scatter like a Poisson
/// count, \f$ \sigma = \sqrt{\sum (w m)^2} \f$; below 0: nothing came, there is no estimate.
inline double error_of(double squares) { return squares > 0.0 ? std::sqrt(squares) : -1.0; }

}  // namespace dust::model::spillage
