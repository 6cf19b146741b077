// SPDX-License-Identifier: Apache-2.0
#include "particles/wall_contacts.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = contact::BatchColumns;

/// Where a batch of walls keeps what has no second grain: the contact point, how long ago the last
/// look was, and the velocity of the surface in between.
constexpr int k_point = B::rotation_j_x;
constexpr int k_since = B::angle_j_x;
constexpr int k_mean_velocity = B::angle_i_x;

void repeat_last(BatchColumns& columns, std::size_t count, int first, int last) {
  for (int c = first; c <= last; ++c) {
    double* column = columns.column(c);
    for (std::size_t q = count; q < contact::padded(count); ++q) column[q] = column[count - 1];
  }
}

/// a - wall - lever w x n, with w x n the way a point at -n goes the other way round.
struct PointColumns {
  double* value[3];
  const double* turn[3];
  const double* wall[3];
};

void move_to_point(const PointColumns& p, std::size_t q, double wall_share, double lever,
                   const double* n) {
  const double w[3] = {p.turn[0][q], p.turn[1][q], p.turn[2][q]};
  p.value[0][q] -= wall_share * p.wall[0][q] + lever * (w[1] * n[2] - w[2] * n[1]);
  p.value[1][q] -= wall_share * p.wall[1][q] + lever * (w[2] * n[0] - w[0] * n[2]);
  p.value[2][q] -= wall_share * p.wall[2][q] + lever * (w[0] * n[1] - w[1] * n[0]);
}

}  // namespace

GrainAtWall GrainAtWall::from(const contact::RowView& rows, std::size_t row) {
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

void put_at_wall(const GrainAtWall& g, const bodies::SurfacePoint& near, std::size_t q,
                 BatchColumns& columns) {
  const auto put = [&](int name, double value) { columns.column(name)[q] = value; };
  const double overlap = g.radius - near.distance;
  put(B::overlap, overlap);
  // The contact point halves the overlap, as between two grains.
  put(B::lever_i, g.radius - 0.5 * overlap);
  put(B::lever_j, 0.0);
  put(B::effective_radius, g.radius);
  put(B::effective_mass, 1.0 / g.inverse_mass);
  put(k_since, g.since);
  for (int d = 0; d < 3; ++d) {
    put(B::normal_x + d, near.normal[d]);
    put(k_point + d, g.position[d] - near.distance * near.normal[d]);
    put(B::velocity_x + d, g.velocity[d]);
    put(B::rotation_x + d, g.rotation[d]);
    put(B::displacement_x + d, g.displacement[d]);
    put(B::angle_x + d, g.angle[d]);
  }
}

void derive_wall_columns(const Surface& surface, double time, double since, std::size_t count,
                         BatchColumns& columns) {
  const double* point[3];
  const double* normal[3];
  double* velocity[3];
  double* mean_velocity[3];
  PointColumns now{};
  PointColumns way{};
  for (int d = 0; d < 3; ++d) {
    point[d] = columns.column(k_point + d);
    normal[d] = columns.column(B::normal_x + d);
    velocity[d] = columns.column(B::separation_x + d);
    mean_velocity[d] = columns.column(k_mean_velocity + d);
    now.value[d] = columns.column(B::velocity_x + d);
    now.turn[d] = columns.column(B::rotation_x + d);
    now.wall[d] = velocity[d];
    way.value[d] = columns.column(B::displacement_x + d);
    way.turn[d] = columns.column(B::angle_x + d);
    way.wall[d] = mean_velocity[d];
  }
  surface_velocities(surface, time, count, point, normal, velocity);
  surface_velocities(surface, time - 0.5 * since, count, point, normal, mean_velocity);
  for (std::size_t q = 0; q < count; ++q) {
    const double lever = columns.column(B::lever_i)[q];
    const double n[3] = {normal[0][q], normal[1][q], normal[2][q]};
    move_to_point(now, q, 1.0, lever, n);
    move_to_point(way, q, columns.column(k_since)[q], lever, n);
  }
  repeat_last(columns, count, B::velocity_x, B::velocity_z);
  repeat_last(columns, count, B::displacement_x, B::displacement_z);
  repeat_last(columns, count, B::overlap, B::lever_j);
  contact::cut_first_displacements(columns, count);
}

}  // namespace dust::particles
