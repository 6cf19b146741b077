// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"
#include "resolved/sphere.hpp"

namespace dust::resolved {

/// Momentum of the fluid inside a sphere that stands at `centre`, about it: the engine solves for
/// that fluid, too, and the sphere must not carry it (Kempe and Froehlich 2012,
/// 10.1016/j.jcp.2012.01.021); docs/theory/resolved.md, eq. (9), (10). Faces count with the share
/// of their control volume in the sphere; `velocity` with filled halo.
[[nodiscard]] Impulse inner_momentum(const fluid::Grid& grid, const fluid::FaceField& velocity,
                                     double density, const Sphere& sphere, sdk::Vec3 centre);

}  // namespace dust::resolved
