// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/page.hpp"

#include <string>
#include <vector>

namespace dust::report {

/// Writes DIR/report.json (all that the page shows) and DIR/report.html (the page, complete in
/// itself) from the files in DIR alone: scenario.yaml, summary.json, series.csv, results.h5 and
/// what the run left in report.json. Returns what is missing on the page, a sentence each.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const Templates& templates = Templates());

}  // namespace dust::report
