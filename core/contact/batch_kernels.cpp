// SPDX-License-Identifier: Apache-2.0
#include "contact/batch_kernels.hpp"

#include "dust/sdk/kernel.hpp"
#include "dust/sdk/square_roots.hpp"

#include <algorithm>

namespace dust::contact {

BatchColumns::BatchColumns() : data_(static_cast<std::size_t>(k_columns) * k_stride, 0.0) {
  keep_history_here();
  sdk::ContactBatch& b = batch_;
  b.overlap = column(overlap);
  b.normal.x = column(normal_x);
  b.normal.y = column(normal_y);
  b.normal.z = column(normal_z);
  b.velocity.x = column(velocity_x);
  b.velocity.y = column(velocity_y);
  b.velocity.z = column(velocity_z);
  b.angular_velocity.x = column(rotation_x);
  b.angular_velocity.y = column(rotation_y);
  b.angular_velocity.z = column(rotation_z);
  b.displacement.x = column(displacement_x);
  b.displacement.y = column(displacement_y);
  b.displacement.z = column(displacement_z);
  b.angle.x = column(angle_x);
  b.angle.y = column(angle_y);
  b.angle.z = column(angle_z);
  b.effective_radius = column(effective_radius);
  b.effective_mass = column(effective_mass);
  b.normal_force = column(normal_force);
  b.normal_stiffness = column(normal_stiffness);
  b.tangential_stiffness = column(tangential_stiffness);
  b.force.x = column(force_x);
  b.force.y = column(force_y);
  b.force.z = column(force_z);
  b.torque.x = column(torque_x);
  b.torque.y = column(torque_y);
  b.torque.z = column(torque_z);
  b.radius_i = column(radius_i);
  b.radius_j = column(radius_j);
  b.inverse_mass_i = column(inverse_mass_i);
  b.inverse_mass_j = column(inverse_mass_j);
}

sdk::ContactBatch BatchColumns::view(std::size_t count, double time_step) const {
  sdk::ContactBatch b = batch_;
  b.count = padded(count);
  b.time_step = time_step;
  b.history = history_.data();
  return b;
}

sdk::CohesionBatch BatchColumns::cohesion_view(std::size_t count, double time_step,
                                               int first_history_column) {
  sdk::CohesionBatch b;
  b.count = padded(count);
  b.time_step = time_step;
  b.overlap = column(overlap);
  b.effective_radius = column(effective_radius);
  b.effective_mass = column(effective_mass);
  b.normal_velocity = column(normal_velocity);
  b.contact_overlap = column(contact_overlap);
  b.attraction = column(attraction);
  b.history = history_.data() + first_history_column;
  return b;
}

void repeat_last(BatchColumns& columns, std::size_t count, int first, int last) {
  for (int c = first; c <= last; ++c) {
    double* column = columns.column(c);
    std::fill(column + count, column + padded(count), column[count - 1]);
  }
}

DUST_KERNEL void cut_first_displacements(BatchColumns& columns, std::size_t count) {
  using B = BatchColumns;
  const double* overlap = columns.column(B::overlap);
  const double* normal[3] = {columns.column(B::normal_x), columns.column(B::normal_y),
                             columns.column(B::normal_z)};
  double* way[3] = {columns.column(B::displacement_x), columns.column(B::displacement_y),
                    columns.column(B::displacement_z)};
  double* angle[3] = {columns.column(B::angle_x), columns.column(B::angle_y),
                      columns.column(B::angle_z)};
  const std::size_t n = padded(count);
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    const double parting =
        way[0][q] * normal[0][q] + way[1][q] * normal[1][q] + way[2][q] * normal[2][q];
    // They came in by -parting to the overlap; docs/theory/grains.md, eq. (5).
    const double inside = overlap[q] / std::max(-parting, 1e-300);
    const double share = overlap[q] > 0.0 && parting < 0.0 ? std::min(1.0, inside) : 1.0;
    for (int d = 0; d < 3; ++d) {
      way[d][q] *= share;
      angle[d][q] *= share;
    }
  }
}

DUST_KERNEL double derive_pair_columns(BatchColumns& columns, std::size_t count) {
  using B = BatchColumns;
  const std::size_t n = padded(count);
  double* distances = columns.column(B::distance);
  const auto [sx, sy, sz] = columns.vectors(B::separation_x);
  const double* ri = columns.column(B::radius_i);
  const double* rj = columns.column(B::radius_j);
  const double* inverse_i = columns.column(B::inverse_mass_i);
  const double* inverse_j = columns.column(B::inverse_mass_j);
  const auto [aix, aiy, aiz] = columns.vectors(B::rotation_i_x);
  const auto [ajx, ajy, ajz] = columns.vectors(B::rotation_j_x);
  const auto [tix, tiy, tiz] = columns.vectors(B::angle_i_x);
  const auto [tjx, tjy, tjz] = columns.vectors(B::angle_j_x);
  const auto [vx, vy, vz] = columns.mutable_vectors(B::velocity_x);
  const auto [ux, uy, uz] = columns.mutable_vectors(B::displacement_x);
  const auto [ax, ay, az] = columns.mutable_vectors(B::angle_x);
  double* overlap = columns.column(B::overlap);
  const auto [nx, ny, nz] = columns.mutable_vectors(B::normal_x);
  const auto [wx, wy, wz] = columns.mutable_vectors(B::rotation_x);
  double* radius = columns.column(B::effective_radius);
  double* mass = columns.column(B::effective_mass);
  double* li = columns.column(B::lever_i);
  double* lj = columns.column(B::lever_j);
  // Coincident centres would give no direction; the tiny floor makes the normal zero instead.
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    distances[q] = std::max(sx[q] * sx[q] + sy[q] * sy[q] + sz[q] * sz[q], 1e-300);
  }
  sdk::take_square_roots(distances, n);
  double largest = 0.0;
  double shallowest = 0.0;  // of those in touch, the overlap before the last step
#pragma omp simd reduction(max : largest) reduction(min : shallowest)
  for (std::size_t q = 0; q < n; ++q) {
    const double distance = distances[q];
    // Four reciprocals from one division; docs/theory/grains.md, eq. (1), (2).
    const double radii = ri[q] + rj[q];
    const double smaller = std::min(ri[q], rj[q]);
    const double by_radii = radii * distance;
    const double inverse_mass = inverse_i[q] + inverse_j[q];
    const double by_mass = inverse_mass * smaller;
    const double all = 1.0 / (by_radii * by_mass);
    const double inverse = all * by_mass * radii;
    const double d = radii - distance;
    const double x = sx[q] * inverse;
    const double y = sy[q] * inverse;
    const double z = sz[q] * inverse;
    // The contact point halves the overlap, so that the two levers add up to the distance.
    const double arm_i = ri[q] - 0.5 * d;
    const double arm_j = rj[q] - 0.5 * d;
    const double ox = arm_i * aix[q] + arm_j * ajx[q];
    const double oy = arm_i * aiy[q] + arm_j * ajy[q];
    const double oz = arm_i * aiz[q] + arm_j * ajz[q];
    vx[q] -= oy * z - oz * y;
    vy[q] -= oz * x - ox * z;
    vz[q] -= ox * y - oy * x;
    wx[q] = aix[q] - ajx[q];
    wy[q] = aiy[q] - ajy[q];
    wz[q] = aiz[q] - ajz[q];
    const double before = d + (ux[q] * x + uy[q] * y + uz[q] * z);
    shallowest = std::min(shallowest, d > 0.0 ? before : 0.0);
    const double px = arm_i * tix[q] + arm_j * tjx[q];
    const double py = arm_i * tiy[q] + arm_j * tjy[q];
    const double pz = arm_i * tiz[q] + arm_j * tjz[q];
    ux[q] -= py * z - pz * y;
    uy[q] -= pz * x - px * z;
    uz[q] -= px * y - py * x;
    ax[q] = tix[q] - tjx[q];
    ay[q] = tiy[q] - tjy[q];
    az[q] = tiz[q] - tjz[q];
    overlap[q] = d;
    nx[q] = x;
    ny[q] = y;
    nz[q] = z;
    li[q] = arm_i;
    lj[q] = arm_j;
    radius[q] = ri[q] * rj[q] * (all * by_mass * distance);
    mass[q] = all * by_radii * smaller;
    largest = std::max(largest, d * (all * by_radii * inverse_mass));
  }
  // Few batches have one.
  if (shallowest < 0.0) cut_first_displacements(columns, count);
  return largest;
}

DUST_KERNEL void derive_normal_velocity(BatchColumns& columns, std::size_t count) {
  using B = BatchColumns;
  const auto [nx, ny, nz] = columns.vectors(B::normal_x);
  const auto [vx, vy, vz] = columns.vectors(B::velocity_x);
  double* normal_velocity = columns.column(B::normal_velocity);
  const std::size_t n = padded(count);
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    normal_velocity[q] = vx[q] * nx[q] + vy[q] * ny[q] + vz[q] * nz[q];
  }
}

DUST_KERNEL void subtract_attraction(BatchColumns& columns, std::size_t count) {
  using B = BatchColumns;
  const auto [nx, ny, nz] = columns.vectors(B::normal_x);
  const double* attraction = columns.column(B::attraction);
  const auto [fx, fy, fz] = columns.mutable_vectors(B::force_x);
  const std::size_t n = padded(count);
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    fx[q] -= attraction[q] * nx[q];
    fy[q] -= attraction[q] * ny[q];
    fz[q] -= attraction[q] * nz[q];
  }
}

DUST_KERNEL void derive_torques(BatchColumns& columns, std::size_t count, bool has_couple) {
  using B = BatchColumns;
  const auto [nx, ny, nz] = columns.vectors(B::normal_x);
  const auto [fx, fy, fz] = columns.vectors(B::force_x);
  const double* li = columns.column(B::lever_i);
  const double* lj = columns.column(B::lever_j);
  const auto [mx, my, mz] = columns.vectors(B::torque_x);
  const auto [ix, iy, iz] = columns.mutable_vectors(B::torque_i_x);
  const auto [jx, jy, jz] = columns.mutable_vectors(B::torque_j_x);
  const std::size_t n = padded(count);
  const double couple = has_couple ? 1.0 : 0.0;
#pragma omp simd
  for (std::size_t q = 0; q < n; ++q) {
    // F at -lever_i n on i, -F at +lever_j n on j; docs/theory/grains.md, eq. (3).
    const double tx = ny[q] * fz[q] - nz[q] * fy[q];
    const double ty = nz[q] * fx[q] - nx[q] * fz[q];
    const double tz = nx[q] * fy[q] - ny[q] * fx[q];
    ix[q] = couple * mx[q] - li[q] * tx;
    iy[q] = couple * my[q] - li[q] * ty;
    iz[q] = couple * mz[q] - li[q] * tz;
    jx[q] = -couple * mx[q] - lj[q] * tx;
    jy[q] = -couple * my[q] - lj[q] * ty;
    jz[q] = -couple * mz[q] - lj[q] * tz;
  }
}

}  // namespace dust::contact
