// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/wind_erosion.hpp>

#include <algorithm>
#include <cmath>

namespace dust::model::shear {

using sdk::wind_erosion::flux;
using sdk::wind_erosion::threshold;

/// By what moisture raises it [-]: sqrt(1 + 1.21 (w - w')^0.68) above w', 1 below; w, w' in
/// percent. Fecan, Marticorena and Bergametti, Ann. Geophysicae 17 (1999) 149, eq. (14).
inline double raised_by_moisture(double moisture, double held_moisture) {
  const double above = 100.0 * std::max(0.0, moisture - held_moisture);
  return std::sqrt(1.0 + 1.21 * std::pow(above, 0.68));
}

/// Dust [kg] that comes off a load m [kg] of a class where the wind asks for x [kg] of a fresh
/// grain whose classes together carried m_0: each class gives by what is left of it,
///   dm = m (1 - exp(-x / m_0)).
inline double released(double load, double fresh_load, double asked) {
  return load > 0.0 ? -load * std::expm1(-asked / fresh_load) : 0.0;
}

}  // namespace dust::model::shear
