// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <nlohmann/json.hpp>

namespace dust::run {

/// What got out of the air of a run as a sampler there would find it: by hood and by side that
/// lets dust out {"kg", "kg_per_h", "inhalable_kg", "thoracic_kg", "respirable_kg"}, and where
/// material was brought in "g_per_tonne" and the three also in mg per kg of it: the dustiness of EN
/// 15051. Amounts in kg count since t = 0, the others since the plant is as it is (PlantBegin).
/// Shares by the conventions of EN 481, each class at its aerodynamic diameter.
nlohmann::ordered_json dust_outflow_json(const Simulation& s, const RunFacts& facts);

}  // namespace dust::run
