// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

namespace dust::run {

/// That of a run which becomes another plant now.
[[nodiscard]] PlantBegin plant_begin_now(const Simulation& s);
/// That of the plant which runs.
[[nodiscard]] PlantBegin plant_begin(const RunFacts& facts);

}  // namespace dust::run
