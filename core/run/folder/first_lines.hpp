// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <string>
#include <vector>

namespace dust::run {

/// What run.log says of a run that begins, behind log_header(): the state that it starts from,
/// what meshes say of themselves, time steps, moisture.
std::vector<std::string> first_lines(const Simulation& simulation, const RunFacts& facts);

}  // namespace dust::run
