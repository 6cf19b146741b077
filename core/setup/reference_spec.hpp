// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dust::scenario {

/// A published or measured number that a figure of a sensor is held against.
struct ReferenceSpec {
  std::string sensor;         ///< name of the sensor
  std::string figure;         ///< path of its figure, as in summary.json
  double value = 0.0;         ///< in `unit`
  std::string unit;           ///< that of the figure; "1" = none
  double uncertainty = -1.0;  ///< in `unit`; < 0: not known
  std::string source;
};

}  // namespace dust::scenario
