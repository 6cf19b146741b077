// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/dem_rig.hpp"

#include <numbers>
#include <vector>

namespace dust::test {

/// 256 equal grains at rest in the densest packing (face-centred cubic, twelve neighbours each),
/// periodic all round; neighbours are `apart` diameters from each other.
inline std::vector<particles::NewGrain> densest_packing(DemRig& rig, double diameter,
                                                        double apart) {
  const double side = apart * std::numbers::sqrt2 * diameter;
  rig.diameters = {diameter};
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {4 * side, 4 * side, 4 * side};
  for (const int axis : {0, 1, 2}) rig.periodic(axis);
  const sdk::Vec3 corners[] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  std::vector<particles::NewGrain> grains;
  for (int n = 0; n < 256; ++n) {
    const sdk::Vec3 cell{n / 4 % 4 + 0.25, n / 16 % 4 + 0.25, n / 64 + 0.25};
    grains.push_back({.position = side * (cell + corners[n % 4]), .diameter = diameter});
  }
  return grains;
}

}  // namespace dust::test
