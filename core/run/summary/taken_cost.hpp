// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/run_cost.hpp"
#include "run/summary/summary.hpp"

#include <filesystem>

namespace dust::run {

/// What counters of work hold now.
CountsBefore::Work work_so_far(const Simulation& s);

/// What a run has taken, of a branch itself, in the terms in which an estimate tells it. Timers of
/// nodes hold wall time: the processor time of the run is shared out in their proportion. `folder`
/// is measured.
preflight::RunCost taken_cost(const Simulation& simulation, const RunFacts& facts,
                              const std::filesystem::path& folder);

}  // namespace dust::run
