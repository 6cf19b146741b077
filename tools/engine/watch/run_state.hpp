// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace dust::engine {

/// What the files of a run tell from outside, while it goes on or later.
struct RunState {
  bool is_running = false;  ///< a process holds the folder
  double time = 0.0;        ///< [s] of the last row of series.csv
  double end = 0.0;         ///< [s] of the scenario
  double particles = 0.0;
  std::string status;  ///< of summary.json; "" where there is none
  std::string reason;  ///< of a failure
};

/// Throws base::UserError where `folder` holds no run.
RunState read_run_state(const std::filesystem::path& folder);

/// "t = 0.35 of 0.7 s, 50.0 %, 12345 grains".
std::string state_text(const RunState& state);

}  // namespace dust::engine
