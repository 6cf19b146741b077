// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <numbers>

namespace dust::model::lubrication {

struct Constants {
  double viscosity = 0.0;     ///< [Pa s]
  double smallest_gap = 0.0;  ///< [-] of R*
  double reach = 0.0;         ///< [-] of R*
  double most = 0.0;          ///< [m*/dt] largest resistance, see largest_resistance()
};

/// Largest resistance of one film [m*/dt]: the part of a pair's relative speed that it may take in
/// a step. Films of several neighbours add up. Their damping, over all grains of a packing, is at
/// most this times the largest eigenvalue of \f$ \sum n n^T \f$ over the films of one grain,
/// because m* v_n^2 of a pair is never above \f$ m_i v_{in}^2 + m_j v_{jn}^2 \f$: a third of their
/// number where they lie all round. A velocity that is predicted over half a step (Adams-Bashforth)
/// is stable up to 1. With the twelve neighbours of the densest packing a tenth gives 0.4, and
/// leaves room for films that all lie on one axis. Beyond a reach of 1 further neighbours are
/// within it, as many as the sphere of \f$ (2 + \delta_r/2) R \f$ holds. Own derivation.
inline double largest_resistance(double reach) {
  const double wider = std::max(0.8 + 0.2 * reach, 1.0);  // (2 + reach / 2) / (2 + 1 / 2)
  return 0.1 / (wider * wider * wider);
}

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

/// Attraction [N] of a pair that parts at `speed` [m/s] (< 0: approaches):
/// \f$ \min(K, c\, m^*/\Delta t)\, v \f$ with c of largest_resistance(). A film stiffer than the
/// step stops a pair within some 1/c steps, and neither throws it back nor, with those of other
/// neighbours, feeds their motion; one that the step resolves is not touched.
inline double attraction(const Constants& c, double resistance, double speed, double mass,
                         double time_step) {
  return std::min(resistance, c.most * mass / time_step) * speed;
}

}  // namespace dust::model::lubrication
