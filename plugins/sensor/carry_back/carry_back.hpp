// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::carry_back {

/// Contribution of one grain to the mass flow through a box along a direction.
///
/// \f$ \dot m = \frac{1}{L} \sum_i w_i m_i \, \mathbf{v}_i \cdot \mathbf{d} \f$ : the momentum
/// along \f$ \mathbf{d} \f$ per length of the box is the mass flow averaged over its cross sections
/// (a grain of speed u needs L/u to pass, during which it contributes w m u / L).
/// @param weighted_mass  [kg] w m, >= 0
/// @param speed          [m/s] component of the velocity along d
/// @param length         [m] extent of the box along d, > 0
/// @return [kg/s]
/// Own derivation: the definition of a flux averaged over the length of a control volume.
inline double mass_flow(double weighted_mass, double speed, double length) {
  return weighted_mass * speed / length;
}

/// Extent along the unit vector d of a box of extents a, b, c whose faces follow the axes, where d
/// is one of the axes' directions.
inline double extent_along(double a, double b, double c, double dx, double dy, double dz) {
  return a * (dx < 0 ? -dx : dx) + b * (dy < 0 ? -dy : dy) + c * (dz < 0 ? -dz : dz);
}

}  // namespace dust::model::carry_back
