// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <vector>

namespace dust::resolved {

/// Of a cell: how far inside the surface the markers stand in a sphere of so many `cells` across,
/// so that the fluid, which meets a layer as thick as the delta function, has the drag of the
/// sphere itself: docs/theory/resolved.md, eq. (2), found with cubic arrays.
[[nodiscard]] double retraction(double cells);

/// How much faster the markers turn than the sphere in fluid at rest, so that the torque is the
/// sphere's: they stand where drag is right, and a torque goes with the third power of the radius:
/// docs/theory/resolved.md, eq. (6), found with cubic arrays.
[[nodiscard]] double turning_gain(double cells);

/// Cells of the surface for each marker. Markers that see nearly the same faces can push them
/// against each other without moving the fluid: such forces would take hundreds of steps to settle,
/// and the drag with them.
inline constexpr double k_cells_per_marker = 2.5;

/// Markers of a sphere of so many `cells` across; docs/theory/resolved.md, eq. (3).
[[nodiscard]] int marker_count(double cells);

/// Markers on a sphere, spread so that each stands for the same area: the layer of the thickness of
/// a cell around it, cut into pieces of `k_cells_per_marker` cells.
struct MarkerLattice {
  std::vector<sdk::Vec3> direction;  ///< unit vectors, in the axes of the domain
  double radius = 0.0;               ///< [m] where they stand
  double volume = 0.0;               ///< [m3] of a piece
  double turning_gain = 1.0;         ///< [-] see there
};

/// Of a sphere of `diameter` [m] in cells of the edge `spacing` [m].
[[nodiscard]] MarkerLattice make_lattice(double diameter, double spacing);

}  // namespace dust::resolved
