// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/near_walls.hpp"

#include <utility>

namespace dust::coupling {

void NearWalls::use(std::vector<particles::Surface> surfaces) {
  surfaces_ = std::move(surfaces);
  std::erase_if(surfaces_, [](const particles::Surface& s) { return s.body == nullptr; });
}

std::optional<NearWalls::Wall> NearWalls::nearest(sdk::Vec3 point, double reach) const {
  std::optional<Wall> wall;
  for (const particles::Surface& s : surfaces_) {
    // Those that go elsewhere are met where they started: nearness to them is not known here.
    if (!s.may_touch(point, reach, 0.0)) continue;
    const bodies::SurfacePoint found = s.contact(point, reach);
    if (!(found.distance < reach) || (wall && found.distance >= wall->distance)) continue;
    wall = {found.distance, found.normal, s.displacing_speed > 0.0};
  }
  return wall;
}

}  // namespace dust::coupling
