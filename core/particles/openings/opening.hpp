// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <string>

namespace dust::particles {

/// A place where particles are drawn out of the domain: those that touch it, or pass it where a
/// side is open, leave.
struct Opening {
  std::string name;  ///< of the body or side
  int side = -1;     ///< of the domain; -1: in the surface of a body
  sdk::Vec3 min;     ///< [m] box round it, in the body's frame or the domain's; what a side has
  sdk::Vec3 max;     ///< along its normal does not count

  /// `rounding` [m]: a flat box on a flat face has no depth.
  [[nodiscard]] bool holds(sdk::Vec3 p, double rounding) const {
    for (int d = 0; d < 3; ++d) {
      if (side >= 0 && d == side / 2) continue;
      if (p[d] < min[d] - rounding || p[d] > max[d] + rounding) return false;
    }
    return true;
  }
};

}  // namespace dust::particles
