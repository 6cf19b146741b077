// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "fluid/fluid_solver.hpp"

#include <string>

namespace dust::run {

/// SHA-256 of ids, positions, velocities, angular velocities (by id) and the fluid fields (null:
/// there is no fluid).
std::string state_digest(const sdk::GrainColumns& particles, const fluid::FluidSolver* fluid,
                         const fluid::Grid& grid);

}  // namespace dust::run
