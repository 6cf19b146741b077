// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/forces/wall_sliding.hpp"
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

/// Where a batch of walls keeps what has no second grain: the contact point, and how long ago the
/// last look was.
inline constexpr int k_wall_point = contact::BatchColumns::rotation_j_x;
inline constexpr int k_wall_since = contact::BatchColumns::angle_j_x;

/// The velocity of the surface half way back to the last look, until the laws have been asked.
inline constexpr int k_wall_mean_velocity = contact::BatchColumns::angle_i_x;

/// The surface's angular velocity then, of one that turns, until the laws have been asked.
inline constexpr int k_wall_mean_rotation = contact::BatchColumns::rotation_i_x;

inline GrainAtWall GrainAtWall::from(const contact::RowView& rows, std::size_t row) {
  const auto vec = [](const double* p) { return sdk::Vec3{p[0], p[1], p[2]}; };
  const double* motion = rows.motion + contact::k_motion_stride * row;
  const double* spin = rows.spin + contact::k_motion_stride * row;
  GrainAtWall g;
  g.position = vec(rows.position + 4 * row);
  g.velocity = vec(motion);
  g.rotation = vec(spin);
  g.radius = rows.position[4 * row + 3];
  g.inverse_mass = motion[3];
  g.since = 2.0 * motion[7];
  g.displacement = g.since * vec(motion + 4);
  g.angle = g.since * vec(spin + 4);
  return g;
}

/// Puts the grain's side of contact q of a batch: geometry, motion of the contact point. `near` is
/// where the surface is nearest.
inline void put_at_wall(const GrainAtWall& g, const bodies::SurfacePoint& near, std::size_t q,
                        contact::BatchColumns& columns) {
  using B = contact::BatchColumns;
  const auto put = [&](int name, double value) { columns.column(name)[q] = value; };
  const double overlap = g.radius - near.distance;
  // The contact point halves the overlap, as between two grains.
  const double lever = g.radius - 0.5 * overlap;
  // w x -n is the way it goes round the centre.
  const sdk::Vec3 velocity = g.velocity - lever * cross(g.rotation, near.normal);
  const sdk::Vec3 displacement = g.displacement - lever * cross(g.angle, near.normal);
  put(B::overlap, overlap);
  put(B::lever_i, lever);
  put(B::lever_j, 0.0);
  put(B::radius_i, g.radius);
  put(B::radius_j, g.radius);
  put(B::inverse_mass_i, g.inverse_mass);
  put(B::inverse_mass_j, 0.0);
  put(B::effective_radius, g.radius);
  put(B::effective_mass, 1.0 / g.inverse_mass);
  put(k_wall_since, g.since);
  for (int d = 0; d < 3; ++d) {
    put(B::normal_x + d, near.normal[d]);
    put(k_wall_point + d, g.position[d] - near.distance * near.normal[d]);
    put(B::velocity_x + d, velocity[d]);
    put(B::rotation_x + d, g.rotation[d]);
    put(B::displacement_x + d, displacement[d]);
    put(B::angle_x + d, g.angle[d]);
  }
}

/// The surface's side of all contacts: takes its velocity at `time` [s] off the velocities of the
/// contact points, and its way since the last look, half of which was `since` / 2 [s] ago, off the
/// displacements; likewise its rotation, where it turns, off those of the grains. Columns are
/// filled up to the padded count. The surface's own velocities are left in the columns of the
/// separation.
void derive_wall_columns(const Surface& surface, double time, double since, std::size_t count,
                         contact::BatchColumns& columns);

/// Whether a grain has begun to touch the wall since the last look, by what derive_wall_columns has
/// derived: laws that reach farther look at it before.
inline bool has_struck(contact::BatchColumns& columns, std::size_t q) {
  using B = contact::BatchColumns;
  constexpr double k_rounding = 1e-9;
  const double overlap = columns.column(B::overlap)[q];
  double parting = 0.0;  // [m] since the last look, or since the touch
  for (int d = 0; d < 3; ++d) {
    parting += columns.column(B::displacement_x + d)[q] * columns.column(B::normal_x + d)[q];
  }
  return overlap > 0.0 && overlap + parting <= k_rounding * overlap;
}

/// The power [W] that a surface puts into contact q, per real particle, once the laws have been
/// asked: force times velocity and, where it turns, rolling couple times angular velocity.
inline double wall_power(const Surface& surface, bool has_couple, std::size_t q,
                         contact::BatchColumns& columns) {
  using B = contact::BatchColumns;
  const double linear = dot(columns.vectors(B::force_x)[q], columns.vectors(B::separation_x)[q]);
  if (!surface.is_turning || !has_couple) return linear;
  return linear + dot(columns.vectors(B::torque_x)[q], columns.vectors(B::surface_rotation_x)[q]);
}

/// Contact q as it slides, once the laws have been asked; `at` has the particle's centre for its
/// point.
inline SlidingContact sliding_contact(contact::BatchColumns& columns, std::size_t q,
                                      SlidingContact at) {
  using B = contact::BatchColumns;
  at.normal = columns.vectors(B::normal_x)[q];
  at.point -= columns.column(B::lever_i)[q] * at.normal;
  at.force = columns.vectors(B::force_x)[q];
  at.velocity = columns.vectors(B::velocity_x)[q];
  return at;
}

}  // namespace dust::particles
