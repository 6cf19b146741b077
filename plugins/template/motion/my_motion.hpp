// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace my_motion {

/// Speed of a surface that slides to and fro, relative to its largest: \f$ \cos 2 \pi f t \f$;
/// frequency f [1/s], time t [s].
inline double phase(double frequency, double time) {
  return std::cos(2.0 * std::numbers::pi * frequency * time);
}

}  // namespace my_motion
