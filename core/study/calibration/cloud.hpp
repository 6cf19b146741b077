// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/calibration/calibration.hpp"

namespace dust::study {

using Surrogates = std::vector<std::unique_ptr<Surrogate>>;

/// Places of equal weight drawn from the density of the parameters, for regions that fall between
/// the places of a grid: spread evenly at first, then drawn together by weighing the goals more and
/// more, thinned by their weights, and moved along differences of their own (Del Moral, Doucet and
/// Jasra 2006, doi:10.1111/j.1467-9868.2006.00553.x; ter Braak 2006,
/// doi:10.1007/s11222-006-8769-1). The same every time.
WeighedPlaces draw_cloud(const CalibrationSettings& settings, const Surrogates& surrogates);

/// From `place` to the nearest place of largest density: compass search down to a millionth of the
/// cube's edge.
std::vector<double> refined(const CalibrationSettings& settings, const Surrogates& surrogates,
                            std::vector<double> place, double step);

/// What all surrogates say of a place.
std::vector<Prediction> predictions_at(const Surrogates& surrogates,
                                       const std::vector<double>& place);

}  // namespace dust::study
