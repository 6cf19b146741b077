// SPDX-License-Identifier: Apache-2.0
#include "particles/work/dissipation.hpp"

#include "dust/sdk/contact_plane.hpp"
#include "dust/sdk/kernel.hpp"
#include "particles/energy/elastic_energy.hpp"
#include "particles/forces/force_buffer.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = BatchColumns;

/// Adds what the contacts have done to their sides in a step.
DUST_KERNEL void add_work(BatchColumns& columns, std::size_t count, double step, double* normal,
                          double* tangential) {
  const sdk::VectorColumns n = columns.vectors(B::normal_x);
  const sdk::VectorColumns force = columns.vectors(B::force_x);
  const sdk::VectorColumns velocity = columns.vectors(B::velocity_x);
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    normal[q] -= step * dot(force[q], n[q]) * dot(velocity[q], n[q]);
    tangential[q] -= step * dot(sdk::in_contact_plane(force[q], n[q]).part, velocity[q]);
  }
}

DUST_KERNEL void add_rolling_work(BatchColumns& columns, std::size_t count, double step,
                                  double* tangential) {
  const sdk::VectorColumns couple = columns.vectors(B::torque_x);
  const sdk::VectorColumns rotation = columns.vectors(B::rotation_x);
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) tangential[q] -= step * dot(couple[q], rotation[q]);
}

/// What of the work done so far cannot be given back any more.
DUST_KERNEL void hand_out(double* work, const double* stored, std::size_t count, double* given) {
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    given[q] = std::max(0.0, work[q] - stored[q]);
    work[q] -= given[q];
  }
}

}  // namespace

void find_dissipation(const PairLaws& law, BatchColumns& columns, std::size_t count, double step,
                      std::size_t first, Dissipation& out) {
  double* const normal_work = columns.history()[first];
  double* const tangential_work = columns.history()[first + 1];
  add_work(columns, count, step, normal_work, tangential_work);
  if (law.rolling) add_rolling_work(columns, count, step, tangential_work);
  ElasticEnergy stored;
  find_elastic_energy(law, columns, count, stored);
  hand_out(normal_work, stored.normal, count, out.normal);
  hand_out(tangential_work, stored.friction, count, out.tangential);
}

void scatter_dissipation(const Dissipation& out, const contact::Places* places,
                         const std::int32_t* contacts, std::size_t count, bool has_scales,
                         BatchColumns& columns, double* force) {
  const double* const scale_i = columns.column(B::scale_i);
  const double* const scale_j = columns.column(B::scale_j);
  const auto add = [&](std::int32_t side, std::size_t q, double half) {
    double* row = force + k_force_row * static_cast<std::size_t>(side);
    row[3] += half * out.normal[q];
    row[7] += half * out.tangential[q];
  };
  for (std::size_t q = 0; q < count; ++q) {
    const contact::Places& place = contacts == nullptr ? places[q] : places[contacts[q]];
    add(place.a, q, has_scales ? 0.5 * scale_i[q] : 0.5);
    add(place.b, q, has_scales ? 0.5 * scale_j[q] : 0.5);
  }
}

}  // namespace dust::particles
