// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/dust_sizes.hpp"
#include "report/figure.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dust::report {

/// One column of series.csv; a cell that is not a number is NaN.
struct SeriesColumn {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// What a run folder says in text. Files that are missing or damaged leave their part empty and a
/// line in `notes`; only a folder without summary.json is refused.
struct RunText {
  nlohmann::json summary;
  nlohmann::json report;
  std::string scenario;
  std::vector<SeriesColumn> series;
  std::vector<Figure> figures;
  DustSizes dust;  ///< which sizes are dust
  std::vector<std::string> notes;
};

/// Reads the text files of a run. Throws base::UserError with a remedy when it is not a run.
[[nodiscard]] RunText read_run_text(const std::filesystem::path& folder);
/// The same of a run that goes on, whose summary.json and report.json are given.
[[nodiscard]] RunText read_run_text(const std::filesystem::path& folder, nlohmann::json summary,
                                    nlohmann::json report);

/// Cells of a line of a CSV file; a quoted cell may hold commas, a doubled quote stands for one.
[[nodiscard]] std::vector<std::string> csv_cells(const std::string& line);

/// Numbers and strings of a JSON object that may lack them or hold something else.
[[nodiscard]] std::optional<double> number_at(const nlohmann::json& object, const char* key);
[[nodiscard]] std::string text_at(const nlohmann::json& object, const char* key);
[[nodiscard]] const nlohmann::json& object_at(const nlohmann::json& object, const char* key);
[[nodiscard]] const nlohmann::json& list_at(const nlohmann::json& object, const char* key);

}  // namespace dust::report
