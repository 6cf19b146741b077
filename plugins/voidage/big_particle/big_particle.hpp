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
class Planes {
 public:
  /// Those round a sphere at `centre` [m]; cells of `spacing` [m] begin at `origin` [m].
  void set(double centre, double origin, double spacing, double radius) {
    first_ = static_cast<int>(std::floor((centre - radius - origin) / spacing));
    const int last = static_cast<int>(std::floor((centre + radius - origin) / spacing));
    distances_.clear();
    for (int i = first_; i <= last + 1; ++i) {
      distances_.push_back((origin + i * spacing - centre) / radius);
    }
    // The whole sphere lies between the outer planes; rounding must not cut it off.
    distances_.front() = -1.0;
    distances_.back() = 1.0;
  }
  [[nodiscard]] int first() const { return first_; }  ///< cell above the lowest plane
  [[nodiscard]] const std::vector<double>& distances() const { return distances_; }
  [[nodiscard]] std::size_t cells() const { return distances_.size() - 1; }

 private:
  int first_ = 0;
  std::vector<double> distances_;  ///< one more than cells
};

}  // namespace dust::model::big_particle
