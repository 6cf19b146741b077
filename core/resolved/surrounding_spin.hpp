// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"
#include "resolved/marker_lattice.hpp"
#include "resolved/sphere.hpp"

namespace dust::resolved {

/// [rad/s] Half the vorticity that the fluid would have at the sphere without its spin;
/// docs/theory/resolved.md, eq. (6). Seen on a shell two cells from the surface, where the spin of
/// the sphere itself has fallen with the third power of the distance, as it does in Stokes flow.
/// Pairs of opposite places of which one lies beyond a side of the domain are left out; `velocity`
/// with filled halo.
[[nodiscard]] sdk::Vec3 surrounding_spin(const fluid::Grid& grid, const fluid::FaceField& velocity,
                                         const MarkerLattice& markers, const Sphere& sphere);

}  // namespace dust::resolved
