// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/sensor.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of a sensor whose wanted surfaces (sdk::SurfacesWanted) are not there: no wall in a box,
/// nothing below a stretch, or a belt that runs another way. Bodies that move or are taken away may
/// come there: they are asked for where they stand at the beginning and at the end.
void check_sensor_surfaces(const scenario::Setup& setup, const bodies::BodySet& bodies,
                           const scenario::SensorSpec& spec, const sdk::Sensor& sensor,
                           scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
