// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/audit/departures.hpp"
#include "run/audit/force_shares.hpp"
#include "run/simulation.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dust::run {

/// By side of the domain, those that grains have left through: count, mass, and which the first
/// were.
[[nodiscard]] nlohmann::ordered_json departures_json(const Departures& departures);

/// The models of forces that act, and how large the forces of each kind are.
[[nodiscard]] nlohmann::ordered_json forces_json(const scenario::Setup& setup,
                                                 const ForceShares& shares);
/// A table for the report; none without samples.
void add_force_table(const ForceShares& shares, nlohmann::ordered_json& tables);

/// What run.log says at the end.
[[nodiscard]] std::vector<std::string> audit_lines(const Simulation& s, const ForceShares& shares);

}  // namespace dust::run
