// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace dust::report {

/// All that the page of a run shows, as report.schema.json in tools/report describes it: numbers
/// in SI units, names and texts from the run, and blobs of pictures. No markup, and no words of the
/// page: those are of the templates.
[[nodiscard]] nlohmann::json run_document(const std::filesystem::path& folder);

/// The same of a run that goes on: `summary` and `report` stand for the files summary.json and
/// report.json that it has not written yet.
[[nodiscard]] nlohmann::json run_document(const std::filesystem::path& folder,
                                          const nlohmann::json& summary,
                                          const nlohmann::json& report);

}  // namespace dust::report
