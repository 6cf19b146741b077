// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::run {

/// Dust finer than 30 um that a drop of material gives off [g/t] in a wind of `speed` [m/s], of the
/// moisture `moisture` [-]: 1000 k 0.0016 (U/2.2)^1.3 / (M/2 %)^1.4 with k = 0.74 (AP-42, 13.2.4,
/// 2006); docs/theory/dust.md, eq. (23).
inline double drop_emission(double speed, double moisture) {
  constexpr double k_below_30_um = 0.74;
  constexpr double k_grams_per_kilogram = 1e3;
  return k_grams_per_kilogram * k_below_30_um * 0.0016 * std::pow(speed / 2.2, 1.3) /
         std::pow(moisture / 0.02, 1.4);
}

/// By how much more a drop of `height` [m] gives off per tonne than one of 2 m: (H/2)^1.25 (VDI
/// 3790-3, 2010). What that guideline gives for the drop of 2 m itself rests on a class of
/// dustiness that no scenario knows.
inline double drop_height_factor(double height) { return std::pow(height / 2.0, 1.25); }

/// Air [m3/s] that `load` [kg/s] of the mean size `size` [m], falling `height` [m], draws into a
/// chute through the open `area` [m2] at its upstream end: Q [ft3/min] = 10 A (R S^2/D)^(1/3) of
/// ft2, short tons/h, ft and ft (Anderson 1964). An upper estimate, within a factor of 2;
/// docs/theory/dust.md, eq. (24).
inline double induced_air(double load, double height, double size, double area) {
  constexpr double k_foot = 0.3048;          // m
  constexpr double k_short_ton = 907.18474;  // kg
  const double tons_per_hour = load * 3600.0 / k_short_ton;
  const double fall = height / k_foot;
  const double speed = 10.0 * std::cbrt(tons_per_hour * fall * fall / (size / k_foot));  // ft/min
  return area * speed * k_foot / 60.0;
}

}  // namespace dust::run
