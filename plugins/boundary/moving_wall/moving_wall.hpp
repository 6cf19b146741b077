// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::moving_wall {

/// Component of a wall's velocity along the wall: w - (w . n) n.
/// `w`, `n`: component of the given velocity [m/s] and of the unit normal [-]; `through` = w . n
/// [m/s]. A wall that moves in its own plane lets nothing pass. Source: kinematics.
constexpr double along(double w, double n, double through) { return w - through * n; }

}  // namespace dust::model::moving_wall
