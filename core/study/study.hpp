// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dust::study {

/// What the command line of `engine study` says.
struct StudyOptions {
  std::filesystem::path file;
  std::optional<std::filesystem::path> output;
  bool resume = false;
  bool force = false;
  bool dry_run = false;
  bool fail_fast = false;
  bool quiet = false;
  int jobs = 0;  ///< 0 = as the study says
  std::string launcher = "local";
  std::vector<std::string> plugin_path;
};

/// Runs a study from reading to report; returns the exit status: 0 all points finished, 1 a point
/// failed, 130 or 143 interrupted. Throws base::UserError for everything found before the first
/// file is written.
int run_study(const StudyOptions& options);

}  // namespace dust::study
