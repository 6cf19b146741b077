// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::wall_shear {

/// Stress of the air on a wall [Pa] by the velocity half a cell away: viscosity [Pa s], velocity of
/// the air along the wall less the wall's [m/s], height of the cell [m].
constexpr double stress(double viscosity, double slip, double cell) {
  return viscosity * slip / (0.5 * cell);
}

}  // namespace dust::model::wall_shear
