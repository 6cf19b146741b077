// SPDX-License-Identifier: Apache-2.0
#include "airborne/impaction.hpp"

#include <numbers>

namespace dust::airborne {

double impaction_efficiency(double stokes) {
  // Below, no point follows a path that ends on the sphere.
  constexpr double k_smallest_stokes = 1.0 / 24.0;
  if (!(stokes > k_smallest_stokes)) return 0.0;
  const double root = stokes / (stokes + 0.25);
  return root * root;
}

double cleared_flow(const DustClass& dust, double diameter, double speed) {
  const double efficiency = impaction_efficiency(dust.response_time * speed / diameter);
  return speed * 0.25 * std::numbers::pi * diameter * diameter * efficiency;
}

}  // namespace dust::airborne
