// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <cmath>

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

/// Mass in the box per emitted mass in grams per tonne (parts per million by mass);
/// sdk::k_no_value before anything was emitted.
inline double grams_per_tonne(double mass, double emitted_mass) {
  constexpr double k_grams_per_tonne = 1e6;
  return emitted_mass > 0.0 ? k_grams_per_tonne * mass / emitted_mass : sdk::k_no_value;
}

/// Standard error of the mass present at one moment, taken for its mean over time.
///
/// \f$ \sigma = \sqrt{s_b^2 + \sum (w m)^2} \f$: what comes and goes with the flow, by the
/// deviation \f$ s_b \f$ of means over stretches of time, and the counting of what is there. Dust
/// that an eddy brings in one lump is no sum of independent grains: counting alone promises too
/// much.
/// @param deviation  [kg] of batch means; negative = none
/// @param squares    [kg2] sum of (w m)^2 of the grains present
/// @return [kg]; `deviation` where it is negative
/// Own definition.
inline double moment_error(double deviation, double squares) {
  return deviation < 0.0 ? deviation : std::hypot(deviation, std::sqrt(squares));
}

/// How often what is in the box has been renewed: \f$ N T / \sum t \f$, the grains seen over those
/// present in the mean. Below `k_min_renewals` the means over time are those of one population, and
/// their scatter says nothing of another one.
/// @param grains    that were there
/// @param stay      [s] that all of them together were there
/// @param duration  [s] observed
inline double renewals(double grains, double stay, double duration) {
  return stay > 0.0 ? grains * duration / stay : 0.0;
}
constexpr double k_min_renewals = 3.0;

}  // namespace dust::model::box_concentration
