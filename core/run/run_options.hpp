// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/reader.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace dust::run {

/// What the command line of `engine run` says.
struct RunOptions {
  std::filesystem::path scenario;
  std::vector<scenario::Override> overrides;
  std::vector<std::filesystem::path> set_files;
  std::optional<std::filesystem::path> output;
  bool force = false;
  bool resume = false;
  bool quiet = false;
  bool verbose = false;
  int threads = 0;               ///< 0 = all cores
  std::optional<int> live_port;  ///< serve the growing report there; 0 = any free port
  std::vector<std::filesystem::path> plugin_path;
  std::string command;  ///< as typed, for run.log
  std::string program;  ///< version, commit and compiler, for run.log
};

/// Runs a scenario from reading to report; returns the exit status (CONTRACT: 0, 1, 130, 143).
/// Throws base::UserError for everything found before the first file is written.
int run_scenario(const RunOptions& options);

/// Writes the task graph as DOT to stdout: of a scenario, or with the timings of a finished run.
int print_graph(const RunOptions& options, const std::optional<std::filesystem::path>& run_folder);

}  // namespace dust::run
