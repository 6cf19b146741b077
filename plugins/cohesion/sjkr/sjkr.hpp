// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <numbers>

namespace dust::model::sjkr {

/// Attraction [N] of two grains in touch: \f$ F = C A,\; A = 2 \pi R^* d \f$ for d > 0, else 0.
/// `energy_density` C [J/m3], `radius` R* [m], `overlap` d [m]. A is the area of the circle in
/// which the undeformed spheres cut each other, to first order in d/R: twice Hertz' contact area.
/// Source: the simplified form of Johnson, Kendall, Roberts, Proc. R. Soc. A 324 (1971) 301, that
/// is common in DEM codes.
[[gnu::always_inline]] inline double attraction(double energy_density, double radius,
                                                double overlap) {
  return energy_density * (2.0 * std::numbers::pi) * radius * std::max(overlap, 0.0);
}

/// Overlap over R* [-] at which elastic spheres rest: \f$ (3 \pi C / (2 E^*))^2 \f$ from
/// \f$ \tfrac43 E^* \sqrt{R^*} d^{3/2} = 2 \pi C R^* d \f$. `young` E* [Pa].
inline double resting_strain(double energy_density, double young) {
  const double root = 1.5 * std::numbers::pi * energy_density / young;
  return root * root;
}

}  // namespace dust::model::sjkr
