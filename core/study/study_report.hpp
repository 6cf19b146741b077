// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/calibration.hpp"
#include "study/spec.hpp"
#include "study/table.hpp"

#include <filesystem>

namespace dust::study {

/// The answer of a calibration with its question, for the report.
struct CalibrationAnswer {
  CalibrationSettings settings;
  Calibration calibration;
};

/// Writes report.html of a study: one self-contained page in the look of a run's, with the answer
/// of a calibration (`answer` may be null), expectations, main effects and all points.
void write_study_report(const std::filesystem::path& file, const Spec& spec, const Results& results,
                        const CalibrationAnswer* answer);

/// A sentence for a terminal as it is printed: "+-" becomes a sign.
std::string with_true_signs(std::string text);

/// The section of a calibration.
std::string calibration_html(const CalibrationAnswer& answer);

}  // namespace dust::study
