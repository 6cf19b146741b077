// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "preflight/air/side_faces.hpp"
#include "scenario/diagnostics.hpp"

namespace dust::preflight {

/// Refuses a sensor of wall shear on a side that has none, or whose viscosity it does not know.
/// `sensor` is the model of `spec`.
void check_wall_shear(const scenario::Setup& setup, const SideModels& sides,
                      const scenario::SensorSpec& spec, const sdk::Sensor& sensor,
                      scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
