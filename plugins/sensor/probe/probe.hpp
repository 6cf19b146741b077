// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <vector>

namespace dust::model::probe {

/// `count` places from `from` to `to` [m], both included; the middle for one.
inline std::vector<sdk::Vec3> line(sdk::Vec3 from, sdk::Vec3 to, std::int64_t count) {
  std::vector<sdk::Vec3> places;
  for (std::int64_t n = 0; n < count; ++n) {
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0.5;
    places.push_back(from + share * (to - from));
  }
  return places;
}

/// A lattice of `count` by `count_across` places: the line, shifted by shares of `across` [m].
inline std::vector<sdk::Vec3> lattice(sdk::Vec3 from, sdk::Vec3 to, std::int64_t count,
                                      sdk::Vec3 across, std::int64_t count_across) {
  std::vector<sdk::Vec3> places;
  for (const sdk::Vec3 shift : line({}, across, count_across)) {
    const sdk::Vec3 by = count_across > 1 ? shift : sdk::Vec3{};
    for (const sdk::Vec3 place : line(from, to, count)) places.push_back(place + by);
  }
  return places;
}

}  // namespace dust::model::probe
