// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/table.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace dust::study {

/// Degrees of freedom of an error that allows for its own: those that sensors tell.
constexpr double k_free = std::numeric_limits<double>::infinity();

/// Noise of one run's output.
struct Noise {
  double deviation = 0.0;  ///< one standard deviation [unit of the output]
  double freedom = k_free;
};

/// Scatter of the replicates of a point, pooled over all points; without replicates the standard
/// errors the sensors tell; nothing without both.
std::optional<Noise> noise_of(const Results& results, std::size_t output);

/// How many standard errors tell a change from noise: two, or more where few values tell the error:
/// the 97.5 % quantile of Student's t, 12.7 of two values, 4.3 of three.
double clear_limit(double freedom);

/// Standard error of the mean of two values or more, by their scatter.
double error_of_mean(const std::vector<double>& values);

/// A run's output that has not settled in the time observed: its mean may still change by more than
/// runs scatter.
bool is_unsteady(const OutputValue& output);

}  // namespace dust::study
