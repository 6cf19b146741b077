// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/run_text.hpp"

namespace dust::report {

/// Balances of what was released: [{"of", "emitted", "in_domain", "left", "removed", "difference",
/// "is_closed"}]; a part that the summary lacks is 0.
[[nodiscard]] nlohmann::json balance_json(const nlohmann::json& summary);

/// Figures beside published numbers, with their difference.
[[nodiscard]] nlohmann::json references_json(const nlohmann::json& summary);

/// What the run cost, by node of the task graph; null where it does not say.
[[nodiscard]] nlohmann::json cost_json(const RunText& run);

}  // namespace dust::report
