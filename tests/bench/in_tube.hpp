// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/read_bed.hpp"
#include "support/dem_rig.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace dust::test {

/// Floor and tube that `bed` has settled in, round the z axis from z = 0 up. In a box round it the
/// bed would fall apart while it is timed, and half of its contacts would be gone.
inline void put_in_tube(DemRig& rig, const Bed& bed, int material) {
  double reach = 0.0;
  for (const particles::NewGrain& g : bed.grains) {
    reach = std::max(reach, std::hypot(g.position.x, g.position.y) + 0.5 * g.diameter);
  }
  const double radius = 1e-4 * std::round(1e4 * reach);  // what rests is pressed in by far less
  const double length = 1.5 * bed.high.z + 0.01;
  rig.setup.domain.min = {-radius - 2e-3, -radius - 2e-3, 0.0};
  rig.setup.domain.max = {radius + 2e-3, radius + 2e-3, length};
  rig.wall(4, material);
  scenario::BodySpec spec;
  spec.material = material;
  spec.shape = {.kind = "shape",
                .name = "cylinder",
                .values = {sdk::Vec3{0, 0, -2e-3}, sdk::Vec3{0, 0, 1}, length + 4e-3, radius, 1e-3},
                .path = {},
                .where = {}};
  rig.bodies.push_back(
      bodies::make_body(rig.setup, spec, std::vector<std::unique_ptr<sdk::Motion>>{}));
}

}  // namespace dust::test
