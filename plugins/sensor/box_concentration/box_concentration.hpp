// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::box_concentration {

/// Mass concentration of weighted grains in a box.
///
/// \f$ c = \frac{1}{V} \sum_{i \in V} w_i m_i \f$ with the statistical weight \f$ w_i \f$ [-], the
/// mass of one real grain \f$ m_i \f$ [kg] and the volume \f$ V \f$ [m3] of the box.
/// @param weighted_mass  [kg] sum of w m over the grains whose centres lie in the box, >= 0
/// @param volume         [m3] > 0, bodies inside the box included
/// @return [kg/m3]
/// Own definition.
inline double concentration(double weighted_mass, double volume) { return weighted_mass / volume; }

/// Mass in the box per emitted mass in grams per tonne (parts per million by mass); 0 before
/// anything was emitted.
inline double grams_per_tonne(double mass, double emitted_mass) {
  constexpr double k_grams_per_tonne = 1e6;
  return emitted_mass > 0.0 ? k_grams_per_tonne * mass / emitted_mass : 0.0;
}

}  // namespace dust::model::box_concentration
