// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere_parts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::model::big_particle {

/// Radius of the sphere a grain's volume is spread over, relative to the grain's: the solids
/// fraction inside it is 1 - eps_inner, so the ratio is (1 - eps_inner)^(-1/3).
inline double enlargement(double inner_void_fraction) {
  return 1.0 / std::cbrt(1.0 - inner_void_fraction);
}

/// Border planes of the cells that a sphere may meet along one axis, as distances from its centre
/// over its radius.
struct Planes {
  int first = 0;              ///< cell above the lowest plane
  std::vector<double> place;  ///< one more than cells

  void set(double centre, double origin, double spacing, double radius) {
    first = static_cast<int>(std::floor((centre - radius - origin) / spacing));
    const int last = static_cast<int>(std::floor((centre + radius - origin) / spacing));
    place.clear();
    for (int i = first; i <= last + 1; ++i) {
      place.push_back((origin + i * spacing - centre) / radius);
    }
    // The whole sphere lies between the outer planes; rounding must not cut it off.
    place.front() = -1.0;
    place.back() = 1.0;
  }
  [[nodiscard]] std::size_t cells() const { return place.size() - 1; }
};

}  // namespace dust::model::big_particle
