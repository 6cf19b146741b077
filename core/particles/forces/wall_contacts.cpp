// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/wall_contacts.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = contact::BatchColumns;

/// Takes the wall's velocity [m/s], times the share of the contact [s] if given, off three columns.
/// Contact by contact on purpose: the columns have just been written one number at a time, and
/// reading them four at a time would wait for that.
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
  const double* point[3];
  const double* normal[3];
  double* velocity[3];
  double* mean_velocity[3];
  for (int d = 0; d < 3; ++d) {
    point[d] = columns.column(k_wall_point + d);
    normal[d] = columns.column(B::normal_x + d);
    velocity[d] = columns.column(B::separation_x + d);
    mean_velocity[d] = columns.column(k_wall_mean_velocity + d);
  }
  surface_velocities(surface, count, point, normal, time, velocity, time - 0.5 * since,
                     mean_velocity);
  take_off(columns, count, B::velocity_x, B::separation_x, nullptr);
  take_off(columns, count, B::displacement_x, k_wall_mean_velocity, columns.column(k_wall_since));
  contact::repeat_last(columns, count, B::radius_i, B::velocity_z);
  contact::repeat_last(columns, count, B::displacement_x, B::displacement_z);
  contact::repeat_last(columns, count, B::overlap, B::lever_j);
  contact::cut_first_displacements(columns, count);
}

}  // namespace dust::particles
