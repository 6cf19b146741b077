// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/near_walls.hpp"

#include "particles/surface_search.hpp"

#include <utility>

namespace dust::coupling {

void NearWalls::use(std::vector<particles::Surface> surfaces) {
  surfaces_ = std::move(surfaces);
  std::erase_if(surfaces_, [](const particles::Surface& s) {
    return s.body == nullptr || s.displacing_speed > 0.0;
  });
}

std::optional<NearWalls::Wall> NearWalls::nearest(sdk::Vec3 point, double reach) const {
  const auto [surface, found] = particles::nearest_surface(surfaces_, point, reach);
  if (surface == nullptr) return std::nullopt;
  return Wall{found.distance, found.normal};
}

}  // namespace dust::coupling
