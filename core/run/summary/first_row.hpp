// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "run/summary/series_row.hpp"

#include <span>
#include <string>

namespace dust::run {

/// The first row of series.csv. Sensors look for the first time after a step: what their columns
/// show of the moment, a second sensor of the same settings sees here, which looks at the state at
/// the start and is gone. Contacts and loads of walls are not known before the first step.
/// `going_on`: names of sensors that another run has given its state; they have looked.
SeriesRow first_row(const Simulation& simulation, const registry::Registry& registry,
                    std::span<const std::string> going_on);

}  // namespace dust::run
