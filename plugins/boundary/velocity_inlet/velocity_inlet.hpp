// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::velocity_inlet {

/// Parabola over 0 <= s <= 1 that is 0 at the ends and has the mean 1: the profile of laminar flow
/// between plates.
constexpr double parabola(double s) { return 6.0 * s * (1.0 - s); }

/// Mean of the parabola over a cell of width `h` (in s) round `s`, so that the cells of a side add
/// up to its flow whatever their number: the mean of s (1 - s) is s (1 - s) - h^2 / 12.
constexpr double parabola_mean(double s, double h) { return 6.0 * (s * (1.0 - s) - h * h / 12.0); }

}  // namespace dust::model::velocity_inlet
