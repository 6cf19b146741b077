// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"

#include <nlohmann/json.hpp>

namespace dust::run {

/// What a figure is (sdk::FigureRole), as summary.json and the files beside series.csv say it.
/// Of the parts that a figure has none of, nothing is written.
nlohmann::ordered_json role_json(const sdk::FigureRole& role);

/// What each column of series.csv is, in their order: {"name [unit]": role_json}.
nlohmann::ordered_json series_roles(const Simulation& simulation);

/// The description of series.csv that stands beside it, after the W3C's "Model for Tabular Data
/// and Metadata on the Web" (2015).
nlohmann::ordered_json series_metadata(const Simulation& simulation);

}  // namespace dust::run
