// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <numbers>

namespace dust::model::lubrication {

struct Constants {
  double viscosity = 0.0;     ///< [Pa s]
  double smallest_gap = 0.0;  ///< [-] of R*
  double reach = 0.0;         ///< [-] of R*
};

/// Resistance [kg/s] of the film between two spheres, or a sphere and a plane, to approach and
/// parting along the normal,
/// \f$ K = 6 \pi \mu R^{*2} \left(\frac{1}{h} - \frac{1}{h_r}\right) \f$, 0 in touch and beyond
/// h_r = reach R*; h = max(gap, smallest_gap R*). Radius R* and gap [m].
/// Source: the leading term of Jeffrey and Onishi (1984) 10.1017/S0022112084000355.
inline double resistance(const Constants& c, double radius, double gap) {
  // 6 pi mu R* (1 / delta - 1 / delta_r), delta = h / R*
  const double delta = std::max(gap / radius, c.smallest_gap);
  const double k = 6.0 * std::numbers::pi * c.viscosity * radius * (1.0 / delta - 1.0 / c.reach);
  return gap > 0.0 && delta < c.reach ? k : 0.0;
}

/// Attraction [N] of a pair that parts at `speed` [m/s] (< 0: approaches), at the end of a step
/// that the film's own force slows: \f$ K v / (1 + K \Delta t / m^*) \f$.
inline double attraction(double resistance, double speed, double mass, double time_step) {
  return resistance * speed / (1.0 + resistance * time_step / mass);
}

}  // namespace dust::model::lubrication
