// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dust::run {

/// What each emitter was asked for and what came, for summary.json.
nlohmann::ordered_json emitters_json(const Simulation& simulation, const RunFacts& facts);
/// The same sizes as tables of the report.
void add_emitter_tables(const Simulation& simulation, nlohmann::ordered_json& tables);
/// One sentence per stream that falls short of what was asked, with the reason.
std::vector<std::string> shortfalls(const Simulation& simulation, const RunFacts& facts);

}  // namespace dust::run
