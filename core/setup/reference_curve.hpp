// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dust::scenario {

/// A curve that a sensor draws, as far as it is known before anything has run.
struct CurveAxes {
  std::string title;
  std::string x_label, y_label;  ///< with units: "time [s]"
};

/// A published or measured curve that is drawn behind a curve of a sensor.
struct ReferenceCurve {
  std::string sensor;
  CurveAxes axes;            ///< those of the sensor's curve
  std::vector<double> x, y;  ///< in the units of the axes
  std::string source;
};

}  // namespace dust::scenario
