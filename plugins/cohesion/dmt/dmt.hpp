// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace dust::model::dmt {

/// Attraction [N] of two spheres in touch: \f$ F = 2 \pi \gamma R^* \f$ for d >= 0, else 0.
/// `surface_energy` gamma [J/m2]: the work to part a unit area of the two surfaces; `radius` R*
/// [m], `overlap` d [m].
/// Source: Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53 (1975) 314,
/// doi:10.1016/0021-9797(75)90018-1, in the form of Maugis, J. Colloid Interface Sci. 150 (1992)
/// 243: Hertz' profile, constant attraction.
[[gnu::always_inline]] inline double attraction(double surface_energy, double radius,
                                                double overlap) {
  return overlap >= 0.0 ? (2.0 * std::numbers::pi) * surface_energy * radius : 0.0;
}

/// Overlap [m] of Hertz spheres under their own attraction:
/// \f$ (3 \pi \gamma \sqrt{R^*} / (2 E^*))^{2/3} \f$. `young` E* [Pa].
inline double resting_overlap(double surface_energy, double young, double radius) {
  const double root =
      std::cbrt(1.5 * std::numbers::pi * surface_energy * std::sqrt(radius) / young);
  return root * root;
}

}  // namespace dust::model::dmt
