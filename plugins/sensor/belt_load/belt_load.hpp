// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <algorithm>
#include <cmath>

namespace dust::model::belt_load {

/// What lies on a stretch of belt, summed grain by grain.
struct Sums {
  double mass = 0.0;    ///< [kg]
  double aside = 0.0;   ///< [kg m] mass times distance from the middle, to the left positive
  double spread = 0.0;  ///< [kg m2] mass times its square
  double along = 0.0;   ///< [kg m/s] mass times velocity along the belt

  /// Those of one grain: mass [kg], distance from the middle [m], velocity along the belt [m/s].
  static constexpr Sums of_grain(double m, double y, double v) {
    return {.mass = m, .aside = m * y, .spread = m * y * y, .along = m * v};
  }
  constexpr Sums& operator+=(const Sums& other) {
    mass += other.mass;
    aside += other.aside;
    spread += other.spread;
    along += other.along;
    return *this;
  }
};

/// [m] Centre of mass across the belt: \f$ \bar y = \sum m y / \sum m \f$; as of the others
/// sdk::k_no_value for nothing.
constexpr double off_centre(const Sums& s) {
  return s.mass > 0.0 ? s.aside / s.mass : sdk::k_no_value;
}

/// [m] Half the width the load takes, as of an even strip: \f$ \sqrt{3 \mathrm{var}(y)} \f$.
inline double half_width(const Sums& s) {
  if (!(s.mass > 0.0)) return sdk::k_no_value;
  const double mean = s.aside / s.mass;
  return std::sqrt(3.0 * std::max(s.spread / s.mass - mean * mean, 0.0));
}

/// [m/s] Mean velocity along the belt, by mass.
constexpr double speed(const Sums& s) { return s.mass > 0.0 ? s.along / s.mass : sdk::k_no_value; }

}  // namespace dust::model::belt_load
