// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/sensor.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <span>

namespace dust::preflight {

/// What a sensor sees where nothing is yet: no grains and no cells of the fluid. `class_diameters`
/// stay the caller's.
sdk::WorldView empty_world(const scenario::Setup& setup, std::span<const double> class_diameters);

/// Warns of a sensor that looks at a fluid that is not there, or whose means have no error. Lets it
/// look at the empty `world` once: one that cannot do with this gravity or this domain says so in
/// its first look, which would end the run.
void check_first_look(const scenario::Setup& setup, const scenario::SensorSpec& spec,
                      const sdk::ParameterSchema& parameters, sdk::Sensor& sensor,
                      const sdk::WorldView& world, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
