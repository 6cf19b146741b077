// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/parameter_schema.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Refuses a sensor that looks where nothing is: a box from `min` to `max` apart from the domain, a
/// place among `points`, `from` or `to` outside it, a plane (`point`, `normal`) that its box does
/// not meet, a stretch (`point`, `direction`, `length`) that ends beyond it, `drops` below it.
/// Warns of `points`, at which the air is asked, in bodies. Lengths of these names, of any sensor.
void check_sensor_places(const scenario::Setup& setup, const bodies::BodySet& bodies,
                         const scenario::SensorSpec& spec, const sdk::ParameterSchema& parameters,
                         scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
