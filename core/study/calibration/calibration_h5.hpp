// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/hdf5_file.hpp"

namespace dust::study {

struct CalibrationAnswer;

/// Writes group /calibration of a study's file: the grid over the free parameters (`places`, in
/// their units), what the surrogates say there of every target and how sure (`targets`,
/// `targets_error`), and minus the logarithm of the density; the confidence region is where that is
/// at most the attribute `region_level`. Nothing where the calibration ended before its first
/// surrogate.
void write_landscape(hid_t root, const CalibrationAnswer& answer);

}  // namespace dust::study
