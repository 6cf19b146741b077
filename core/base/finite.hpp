// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cmath>
#include <cstddef>

/// Numbers that are none: infinite, or the result of a division of zero by zero.
namespace dust::base {

inline bool is_finite(double value) { return std::isfinite(value); }
/// No sum of the components: that of large ones may be infinite.
inline bool is_finite(sdk::Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The first of `count` numbers that is not finite, or `count`. A column of good numbers is passed
/// over without a branch per number.
inline std::size_t first_not_finite(const double* column, std::size_t count) {
  double probe = 0.0;  // stays zero unless a number is infinite or none
  for (std::size_t n = 0; n < count; ++n) probe += 0.0 * column[n];
  if (probe == 0.0) return count;
  std::size_t n = 0;
  while (n < count && std::isfinite(column[n])) ++n;
  return n;
}

}  // namespace dust::base
