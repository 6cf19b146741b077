// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/series_row.hpp"

#include <nlohmann/json.hpp>

namespace dust::run {

/// The energy account of the grains, where the scenario asks for it (`audit: {energy: true}`);
/// docs/theory/energy.md.
void visit_energy(const Simulation& s, const ColumnVisitor& visit);
[[nodiscard]] nlohmann::ordered_json energy_json(const Simulation& s);
/// A table for the report.
void add_energy_table(const Simulation& s, nlohmann::ordered_json& tables);

}  // namespace dust::run
