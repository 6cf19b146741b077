// SPDX-License-Identifier: Apache-2.0
#include "particles/surface_search.hpp"

namespace dust::particles {

std::span<const std::int32_t> SurfaceSearch::may_touch(std::span<const Surface> surfaces,
                                                       sdk::Vec3 point, double reach,
                                                       double duration) {
  found_.clear();
  for (std::size_t s = 0, parts = 0; s < surfaces.size(); s += parts) {
    const Surface& first = surfaces[s];
    parts = first.body != nullptr ? static_cast<std::size_t>(first.body->shape->parts()) : 1;
    if (parts == 1) {
      if (first.may_touch(point, reach, duration)) found_.push_back(static_cast<std::int32_t>(s));
      continue;
    }
    first.find_touchable_parts(point, reach, duration, parts_);
    for (const std::int32_t part : parts_) found_.push_back(static_cast<std::int32_t>(s) + part);
  }
  return found_;
}

NearestSurface nearest_surface(std::span<const Surface> surfaces, sdk::Vec3 point, double reach) {
  thread_local SurfaceSearch search;
  NearestSurface nearest;
  for (const std::int32_t s : search.may_touch(surfaces, point, reach, 0.0)) {
    const Surface& surface = surfaces[static_cast<std::size_t>(s)];
    const bodies::SurfacePoint found = surface.contact(point, reach);
    if (!(found.distance < reach)) continue;
    if (nearest.surface != nullptr && found.distance >= nearest.point.distance) continue;
    nearest = {&surface, found};
  }
  return nearest;
}

}  // namespace dust::particles
