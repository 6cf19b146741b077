// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

/// Separations along a periodic direction: the shortest of all images (minimum image). Four lanes
/// at once: lanes::fold.
namespace dust::base {

/// Of two points inside one period of `length`; without branches. A direction without a period has
/// length 0, or an infinite half.
constexpr double nearest_image(double apart, double length, double half) {
  return apart > half ? apart - length : apart < -half ? apart + length : apart;
}
constexpr double nearest_image(double apart, double length) {
  return nearest_image(apart, length, 0.5 * length);
}

/// Of two points anywhere; `length` > 0.
inline double nearest_image_of_any(double apart, double length) {
  return apart - length * std::round(apart / length);
}

}  // namespace dust::base
