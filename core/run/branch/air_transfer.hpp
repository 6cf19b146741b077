// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/branch/comparison.hpp"
#include "run/simulation.hpp"

#include <functional>
#include <string>

namespace dust::run {

/// Takes a warning.
using Warn = std::function<void(const std::string& text)>;

/// Tells what of the fluid and its dust begins anew, before anything is given. `is_same_world`:
/// nothing but what comes in and what looks at it differs.
void report_what_air_drops(const Comparison& both, bool is_same_world, const Warn& warn);

/// Gives a branch the other run's fluid, on the same grid, and what grains and fluid owe each other
/// where both are coupled as before.
void transfer_fluid(const Comparison& both, const Simulation::Owners& to, bool is_same_world);

/// The dust in the air and on surfaces. Where a body stands now, it hangs beside that.
void transfer_dust(const Comparison& both, const Simulation::Owners& to, bool is_same_world,
                   const Warn& warn);

}  // namespace dust::run
