// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/references.hpp"
#include "setup/reference_curve.hpp"

#include <vector>

namespace dust::scenario {

/// Reads the list `reference_curves` and writes it out into `resolved`. A curve belongs to the
/// first of the sensor's curves whose axes have the dimensions of its units. Curves of a sensor
/// that is switched off are checked and left out.
std::vector<ReferenceCurve> read_reference_curves(MapReader& top,
                                                  const std::vector<SensorFigures>& sensors,
                                                  Node& resolved, Diagnostics& diagnostics);

}  // namespace dust::scenario
