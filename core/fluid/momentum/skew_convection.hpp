// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"

namespace dust::fluid {

/// u . grad u [m/s2] of component `d` in the plane across SkewFace::along, at a face beside a
/// surface that moves along itself askew to the grid; docs/theory/fluid.md, eq. (11):
///   u_t du/dt + u_n du/dn + k (|u_t| + |u_n|) (u - mean) / h ,
/// derivatives along and across the surface by weighted least squares (SkewNode). The last term is
/// the dissipation, of third order: `mean` is what the neighbours let expect, so a layer that does
/// not change along the surface hardly feels it. The sum never drives the velocity beyond its
/// neighbours' values (local extremum diminishing, Jameson 1995, 10.1080/10618569508904524).
/// Other flows than that layer keep the convection along the grid's lines, `along_grid`, and
/// between the two it passes over from one to the other.
double convection_along_surface(const Grid& grid, const Geometry& geometry, const SkewFace& face,
                                const FaceField& u, int d, double along_grid);

}  // namespace dust::fluid
