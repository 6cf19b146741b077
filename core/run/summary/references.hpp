// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "setup/reference_spec.hpp"

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace dust::run {

/// The references of a scenario beside what the sensors found (`sensors` as in summary.json):
/// quantity, unit, value, uncertainty, ours, our_uncertainty, error_percent (|R - S|/|R| x 100),
/// source; null where there is no number; `problem` in words where nothing can be compared.
nlohmann::ordered_json references_json(std::span<const scenario::ReferenceSpec> references,
                                       const nlohmann::ordered_json& sensors);

/// One line for each of them, for the log.
std::vector<std::string> reference_lines(const nlohmann::ordered_json& references);

}  // namespace dust::run
