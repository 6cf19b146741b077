// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/run_cost.hpp"
#include "run/summary/summary.hpp"

#include <filesystem>

namespace dust::run {

/// What a run has taken, in the terms in which an estimate tells it. Timers of nodes hold wall
/// time: the processor time of the run is shared out in their proportion. `folder` is measured.
preflight::RunCost taken_cost(const Simulation& simulation, const RunFacts& facts,
                              const std::filesystem::path& folder);

}  // namespace dust::run
