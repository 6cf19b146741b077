// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <span>

namespace dust::preflight {

/// What a sensor sees where nothing is yet: no grains and no cells of the fluid. `class_diameters`
/// stay the caller's.
sdk::WorldView empty_world(const scenario::Setup& setup, std::span<const double> class_diameters);

/// Lets each sensor look at it once: those that cannot do with this gravity or this domain say so
/// in their first look, which would end the run.
void check_first_looks(const scenario::Setup& setup, std::span<const double> class_diameters,
                       const registry::Registry& registry, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
