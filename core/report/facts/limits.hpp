// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/run_text.hpp"

#include <string>
#include <vector>

namespace dust::report {

/// The limits of validity that the balance of a run tells, beside what it reached; those whose
/// number is missing are left out: [{"key", "reached", "bound": "at_most" | "at_least", "value",
/// "is_touched"}]. The key is that of "health" in summary.json.
[[nodiscard]] nlohmann::json limits_json(const RunText& run);

/// The largest overlap of fine grains over the smaller radius where that is beyond what contact
/// laws hold for; otherwise 0.
[[nodiscard]] double crushed_overlap(const RunText& run);

}  // namespace dust::report
