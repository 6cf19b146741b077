// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_class.hpp"
#include "setup/dust_setup.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dust::airborne {

/// Dust that the gas takes off what lies on a surface: of each class the flux of
/// sdk::wind_erosion over the share of the layer's mass that it makes, never more than there is;
/// docs/theory/dust.md, eq. (20).
class Resuspension {
 public:
  /// `gravity` [m/s2] its size.
  Resuspension(const scenario::DustFieldSpec& dust, const Gas& gas, double gravity);

  /// [kg] of class `n` that comes off an area [m2] under `layer` [kg by class] in `step` [s].
  [[nodiscard]] double taken(std::span<const double> layer, std::size_t n, double friction_velocity,
                             double area, double step) const;

 private:
  double coefficient_;             ///< [1/m]
  double gas_density_;             ///< [kg/m3]
  double gravity_;                 ///< [m/s2]
  std::vector<double> threshold_;  ///< [m/s] by class
};

}  // namespace dust::airborne
