// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/calibration/calibration.hpp"
#include "study/spec/spec.hpp"
#include "study/table.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace dust::study {

/// The answer of a calibration with its question, for the report.
struct CalibrationAnswer {
  CalibrationSettings settings;
  Calibration calibration;
};

/// All that the page of a study shows (tools/report/report.schema.json): the answer of a
/// calibration
/// (`answer` may be null), expectations, main effects and all points.
[[nodiscard]] nlohmann::json study_document(const Spec& spec, const Results& results,
                                            const CalibrationAnswer* answer);

/// Writes report.html of a study: one self-contained page in the look of a run's.
void write_study_report(const std::filesystem::path& file, const Spec& spec, const Results& results,
                        const CalibrationAnswer* answer);

/// A sentence for a terminal as it is printed: "+-" becomes a sign.
std::string with_true_signs(std::string text);

/// The part of a calibration.
[[nodiscard]] nlohmann::json calibration_json(const CalibrationAnswer& answer);

}  // namespace dust::study
