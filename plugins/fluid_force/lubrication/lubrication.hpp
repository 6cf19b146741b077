// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace dust::model::lubrication {

/// Drag of a sphere that moves straight to a plane wall over its Stokes drag, less 1 [-]; delta =
/// gap / radius > 0. A rational fit of Brenner's series, within 1 % of it: 1 / delta near touch,
/// 7 / (6 delta) far away.
/// Source: Bevan and Prieve (2000) 10.1063/1.481900, after Brenner (1961).
inline double excess(double delta) {
  return (7.0 * delta + 2.0) / (6.0 * delta * delta + 2.0 * delta);
}

/// Resistance to approaching and leaving a wall [kg/s],
/// \f$ K = 6 \pi \mu R\, (\lambda(\delta) - \lambda(\delta_{reach})) \f$, 0 beyond reach;
/// delta = max(gap, smallest) / R. Viscosity [Pa s], radius and gap [m], smallest and reach [-] in
/// radii.
inline double resistance(double viscosity, double radius, double gap, double smallest,
                         double reach) {
  double delta = gap / radius;
  if (!(delta < reach)) return 0.0;
  if (delta < smallest) delta = smallest;
  return 6.0 * std::numbers::pi * viscosity * radius * (excess(delta) - excess(reach));
}

}  // namespace dust::model::lubrication
