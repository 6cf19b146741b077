// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

#include <span>

namespace dust::sdk {

/// The dust field at the end of a fluid step, on the cells of WorldView::fluid.
struct DustColumns {
  std::span<const double> diameter;  ///< [m] of each class, ascending
  double density = 0.0;              ///< [kg/m3] of the dust itself
  /// [kg/m3] of gas, by class; 0 inside bodies.
  std::span<const std::span<const float>> concentration;
};

/// What a sensor of airborne dust is besides a Sensor. In a run with a dust field it is shown the
/// field after each observe(), of the same moment; without one never.
class DustObserver {
 public:
  virtual ~DustObserver() = default;
  virtual void observe_dust(const WorldView& world, const DustColumns& dust) = 0;
};

}  // namespace dust::sdk
