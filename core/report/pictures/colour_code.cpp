// SPDX-License-Identifier: Apache-2.0
#include "report/pictures/colour_code.hpp"

#include <algorithm>
#include <cmath>

namespace dust::report {

double place_on_scale(double value, double most) {
  return value > 0.0 ? 1.0 + std::log10(value / most) / k_decades : -1.0;
}

std::uint8_t colour_code(double place) {
  return static_cast<std::uint8_t>(std::lround(1.0 + 253.0 * std::clamp(place, 0.0, 1.0)));
}

}  // namespace dust::report
