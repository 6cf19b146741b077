// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/report_run.hpp"

#include <string>
#include <vector>

namespace dust::io {

/// A limit of validity beside what the run reached.
struct Limit {
  std::string name;
  double reached = 0.0;
  std::string valid;  ///< "at most 0.5"
  bool is_touched = false;
  std::string consequence;  ///< of going beyond it
};

/// The limits that the books of a run can tell, from summary.json and report.json; those whose
/// number is missing are left out.
[[nodiscard]] std::vector<Limit> limits_of(const RunText& run);

/// The largest overlap of fine grains over the smaller radius where that is beyond what contact
/// laws hold for; otherwise 0.
[[nodiscard]] double crushed_overlap(const RunText& run);

/// Whether an entry of "health" in summary.json is told as a limit.
[[nodiscard]] bool is_limit_key(const std::string& key);

}  // namespace dust::io
