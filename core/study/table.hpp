// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/plan.hpp"
#include "study/point_store.hpp"

#include <filesystem>
#include <vector>

namespace dust::study {

struct CalibrationAnswer;

/// The points of a study and what came of them, side by side.
struct Results {
  const Plan& plan;
  std::vector<Outcome> outcomes;  ///< one per point
};

/// "finished", "failed" or "waiting".
const char* status_word(Status status);

/// "free: not steady; rate: few grains": why outputs of a point have no standard error or no value;
/// "" where nothing says.
std::string why_no_errors(const Plan& plan, const Outcome& outcome);

/// study.csv: a row per point with inputs, replicate, outputs (sensors with their standard error),
/// status, seed, hash, wall_s, the reason of a failure and why_no_errors; replaced atomically.
void write_csv(const std::filesystem::path& file, const Results& results);

/// study.h5: the same as columns: /inputs, /outputs, /outputs_error and /points, one dataset per
/// column with its unit as attribute; /calibration where there is an answer (may be null). Replaced
/// atomically.
void write_h5(const std::filesystem::path& file, const Results& results,
              const CalibrationAnswer* answer);

}  // namespace dust::study
