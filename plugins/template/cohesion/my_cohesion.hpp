// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace my_cohesion {

inline constexpr double k_two_pi = 6.283185307179586;

/// Attraction [N] of a pair: \f$ F = 2 \pi \gamma R^* \max(0, 1 - s/a) \f$, s the gap, 0 in touch.
/// surface_energy gamma [J/m2] > 0; reach a [m] > 0; radius R* [m]; overlap [m], < 0 with a gap.
/// Source: Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53 (1975) 314, in touch.
[[gnu::always_inline]] inline double attraction(double surface_energy, double reach, double radius,
                                                double overlap) {
  const double gap = std::max(-overlap, 0.0);
  return k_two_pi * surface_energy * radius * std::max(0.0, 1.0 - gap / reach);
}

/// Overlap [m] at which elastic spheres rest under their attraction in touch, from
/// \f$ \tfrac43 E^* \sqrt{R^*} d^{3/2} = 2 \pi \gamma R^* \f$. young E* [Pa].
inline double resting_overlap(double surface_energy, double young, double radius) {
  return std::pow(0.75 * k_two_pi * surface_energy * std::sqrt(radius) / young, 2.0 / 3.0);
}

}  // namespace my_cohesion
