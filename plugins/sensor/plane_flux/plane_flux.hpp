// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <algorithm>
#include <cmath>

namespace dust::model::plane_flux {

/// Standard error of a rate counted over a time, from batch means and from counting.
///
/// Counts of independent grains scatter by \f$ \sigma = \sqrt{\sum w_i^2} / T \f$ (Poisson,
/// weighted). A feed may be more regular than that, so the batch means decide as soon as there are
/// enough grains; for rare ones a lucky row of equal batches must not promise more than counting
/// can know, and the larger of the two is taken.
/// @param batch_error  [1/s or kg/s] from batch means, negative = none
/// @param sum          sum of the weights (or weighted masses) of the passages
/// @param squares      sum of their squares
/// @param duration     [s] counted
/// @return one standard error; negative where there is none: without a passage, with fewer than 20
///   independent grains, where the rate has not settled
inline double rate_error(double batch_error, double sum, double squares, double duration) {
  constexpr double k_many = 100.0;  // effective number from which batch means are trusted alone
  if (squares <= 0.0 || duration <= 0.0) return sdk::k_no_estimate;
  const double poisson = std::sqrt(squares) / duration;
  const double effective_number = sum * sum / squares;
  if (effective_number < sdk::k_min_grains) return sdk::k_few_grains;
  if (batch_error == sdk::k_not_steady) return sdk::k_not_steady;
  if (batch_error >= 0.0 && effective_number >= k_many) return batch_error;
  return std::max(batch_error, poisson);
}

/// Mass passed per mass emitted in the same time, in grams per tonne (parts per million by mass);
/// sdk::k_no_value when nothing was emitted.
/// @param rate      [kg/s] mean over the time
/// @param duration  [s]
/// @param emitted   [kg] in that time
inline double grams_per_tonne(double rate, double duration, double emitted) {
  constexpr double k_grams_per_tonne = 1e6;
  return emitted > 0.0 ? k_grams_per_tonne * rate * duration / emitted : sdk::k_no_value;
}

}  // namespace dust::model::plane_flux
