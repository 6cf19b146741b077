// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/fluid_force.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <span>

namespace dust::scenario {

/// Tells forces of the fluid that would count twice: the same model twice, two models for one part
/// (the hydrostatic buoyancy by Archimedes and by a pressure gradient that holds it), parts that
/// momentum set III has in the drag. `models` in the order of Setup::fluid_forces; null where
/// wrong.
void check_forces(const Setup& setup, std::span<const sdk::FluidForce* const> models,
                  Diagnostics& diagnostics);

}  // namespace dust::scenario
