// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace my_boundary {

/// Strength of a gusty wind relative to its mean: \f$ 1 + a \sin(2 \pi f t) \f$;
/// gusts a [-], frequency f [1/s], time t [s].
inline double strength(double gusts, double frequency, double time) {
  return 1.0 + gusts * std::sin(2.0 * std::numbers::pi * frequency * time);
}

}  // namespace my_boundary
