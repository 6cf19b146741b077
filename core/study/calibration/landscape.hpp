// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/calibration/calibration.hpp"

namespace dust::study {

/// The density of the parameters over a grid as fine as the dimension allows, its likeliest place
/// and its region; where the region falls between the places of the grid, by a cloud of its own.
Landscape make_landscape(const CalibrationSettings& settings,
                         const std::vector<std::unique_ptr<Surrogate>>& surrogates);

/// Sum of squared misses over their variances, and minus the logarithm of the density.
struct Fit {
  double misfit = 0.0;
  double minus_log = 0.0;
};
Fit fit_of(const CalibrationSettings& settings, const std::vector<Prediction>& predictions);

/// Estimates, correlations and the answer in sentences, from the landscape.
void conclude(const CalibrationSettings& settings, Calibration& calibration);

/// Quantile of the chi-square distribution (Wilson and Hilferty 1931; within 1 % for p above 0.5).
double chi_square_quantile(double probability, double freedom);

/// How many separate pieces the region has, by neighbours on the grid.
std::size_t pieces_of_region(const Landscape& landscape, std::size_t dimensions);

}  // namespace dust::study
