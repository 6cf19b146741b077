// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dust::model::stream_section {

/// [-] Share of an opening that a stream would fill at its bulk density: \f$ \phi = \dot m /
/// (\rho_b v_n A) \f$. A chute chokes towards 1; designers keep it below some 0.3.
/// @param mass_flow     [kg/s]
/// @param bulk_density  [kg/m3] of the resting material
/// @param speed         [m/s] mean along the normal of the opening
/// @param area          [m2] of the opening
/// @return no number where the speed is none; 0 of a stream that does not go through
constexpr double fill_ratio(double mass_flow, double bulk_density, double speed, double area) {
  return speed <= 0.0 ? 0.0 : mass_flow / (bulk_density * speed * area);
}

/// [Pa] Mean pressure of a stream of bulk density that gives up its velocity along the normal:
/// \f$ p = \rho_b v_n^2 \f$, its momentum flow over its section.
constexpr double impact_pressure(double bulk_density, double speed) {
  return bulk_density * speed * speed;
}

/// [rad] Angle between a stream and the plane it meets; pi/2 = at right angles.
inline double angle(double normal_speed, double tangential_speed) {
  return normal_speed == 0.0 && tangential_speed == 0.0
             ? 0.0
             : std::atan2(normal_speed, tangential_speed);
}

}  // namespace dust::model::stream_section
