// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/reader.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace dust::run {

/// What a run is asked to do; the command line fills it.
struct RunOptions {
  std::filesystem::path scenario;
  std::vector<scenario::Override> overrides;     ///< --set, applied last
  std::vector<std::filesystem::path> set_files;  ///< --set-file, laid over the scenario in order
  std::optional<std::filesystem::path> output;   ///< -o; nothing = results/<name>, -2, -3 ...
  bool force = false;                            ///< write into a folder that holds a result
  bool resume = false;                           ///< go on from the checkpoint of `output`
  bool quiet = false;
  bool verbose = false;
  int threads = 0;                               ///< 0 = all cores
  std::vector<std::filesystem::path> plugin_path;  ///< --plugin-path
};

/// Runs a scenario; returns the exit status (0, 130 or 143). Throws base::UserError for what is
/// found before anything is written and base::RunError for a failure while running.
int run_scenario(const RunOptions& options);

/// Prints the task graph as DOT; with `run_folder`, with the timings of that run.
int print_graph(const RunOptions& options, const std::optional<std::filesystem::path>& run_folder);

}  // namespace dust::run
