// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/surfaces.hpp"

#include <cstddef>

/// Contacts of grains with surfaces, as the laws see them: written once for coarse grains, for
/// sub-stepped ones and for sensors.
namespace dust::particles {

/// A grain at a surface.
struct GrainAtWall {
  sdk::Vec3 position, velocity, rotation;
  double radius = 0.0, inverse_mass = 0.0;
  sdk::Vec3 displacement, angle;  ///< [m], [rad] since the last look
  double since = 0.0;             ///< [s] that is so long ago

  static GrainAtWall from(const contact::RowView& rows, std::size_t row);
};

/// Puts the grain's side of contact q of a batch: geometry, motion, displacement. `near` is where
/// the surface is nearest.
void put_at_wall(const GrainAtWall& grain, const bodies::SurfacePoint& near, std::size_t q,
                 contact::BatchColumns& columns);

/// The surface's side of all contacts: takes its velocity at `time` [s] off the velocities of the
/// contact points, and its way since the last look, half of which was `since` / 2 [s] ago, off the
/// displacements. Columns are filled up to the padded count. The surface's own velocities are left
/// in the columns of the separation.
void derive_wall_columns(const Surface& surface, double time, double since, std::size_t count,
                         contact::BatchColumns& columns);

}  // namespace dust::particles
