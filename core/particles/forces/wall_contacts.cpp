// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/wall_contacts.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = contact::BatchColumns;

/// Takes what the wall does, its velocity [m/s] or rotation [rad/s], times the share of the contact
/// [s] if given, off three columns. Contact by contact on purpose: the columns have just been
/// written one number at a time, and reading them four at a time would wait for that.
void take_off(BatchColumns& columns, std::size_t count, int value, int wall, const double* share) {
  for (int d = 0; d < 3; ++d) {
    double* x = columns.column(value + d);
    const double* u = columns.column(wall + d);
    for (std::size_t q = 0; q < count; ++q) x[q] -= (share == nullptr ? 1.0 : share[q]) * u[q];
  }
}

}  // namespace

void derive_wall_columns(const Surface& surface, double time, double since, std::size_t count,
                         BatchColumns& columns) {
  bodies::SurfaceMotion now{time, columns.mutable_vectors(B::separation_x), {}};
  bodies::SurfaceMotion half_way{
      time - 0.5 * since, columns.mutable_vectors(k_wall_mean_velocity), {}};
  if (surface.is_turning) {
    now.rotation = columns.mutable_vectors(B::surface_rotation_x);
    half_way.rotation = columns.mutable_vectors(k_wall_mean_rotation);
  }
  find_motion(surface, {count, columns.vectors(k_wall_point), columns.vectors(B::normal_x)}, now,
              half_way);
  const double* share = columns.column(k_wall_since);
  take_off(columns, count, B::velocity_x, B::separation_x, nullptr);
  take_off(columns, count, B::displacement_x, k_wall_mean_velocity, share);
  if (surface.is_turning) {
    take_off(columns, count, B::rotation_x, B::surface_rotation_x, nullptr);
    take_off(columns, count, B::angle_x, k_wall_mean_rotation, share);
  }
  contact::repeat_last(columns, count, B::radius_i, B::velocity_z);
  contact::repeat_last(columns, count, B::displacement_x, B::displacement_z);
  contact::repeat_last(columns, count, B::overlap, B::lever_j);
  contact::cut_first_displacements(columns, count);
}

}  // namespace dust::particles
