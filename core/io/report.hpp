// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace dust::io {

/// Writes DIR/report.html from the files in DIR alone (scenario.yaml, summary.json, series.csv,
/// results.h5, report.json): one self-contained page that opens offline.
void write_report(const std::filesystem::path& folder);

}  // namespace dust::io
