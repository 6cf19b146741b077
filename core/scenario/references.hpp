// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"
#include "scenario/text/values.hpp"
#include "setup/reference_curve.hpp"
#include "setup/reference_spec.hpp"

#include <string>
#include <utility>
#include <vector>

namespace dust::scenario {

/// The figures and curves that a sensor will report, with their units, as far as it knows before it
/// has seen a grain: those of size classes are missing.
struct SensorFigures {
  std::string sensor;
  bool is_enabled = true;
  std::vector<std::pair<std::string, std::string>> figures;  ///< path, unit
  std::vector<CurveAxes> curves;
};

/// What `model` says of itself; a sensor that could not be made (null) has no figures.
SensorFigures figures_of(const std::string& name, bool is_enabled, const sdk::Model* model);

/// Reads the list `references` and writes it out into `resolved`. A reference to a sensor that is
/// switched off is checked and left out.
std::vector<ReferenceSpec> read_references(MapReader& top,
                                           const std::vector<SensorFigures>& sensors,
                                           Node& resolved, Diagnostics& diagnostics);

}  // namespace dust::scenario
