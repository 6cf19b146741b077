// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/run_files.hpp"
#include "run/simulation.hpp"

#include <vector>

namespace dust::run {

/// The fields of all sensors as they are now, for a frame. Throws sdk::ModelError where a sensor
/// gives another number of values than its grid has cells.
std::vector<io::SensorField> fields_of_sensors(const Simulation& simulation);

}  // namespace dust::run
