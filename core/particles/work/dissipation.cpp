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

/// Of the work of a step at the power of now, how much has been done by now. While a contact loads,
/// half of it: with all of it the work would run ahead of what is stored, and what is handed out
/// does not come back. While it unloads nothing is handed out too early, and what the last step of
/// a contact costs is not left over.
enum class Part { done, ahead };
template <Part part>
inline __attribute__((always_inline)) double share_of(double loading) {
  const double done = loading < 0.0 ? 0.5 : 1.0;
  return part == Part::done ? done : 1.0 - done;
}

/// Adds what the contacts do to their sides in that part of a step.
template <Part part>
inline __attribute__((always_inline)) void add_work(BatchColumns& columns, std::size_t count,
                                                    double step, double* normal,
                                                    double* tangential) {
  const sdk::VectorColumns n = columns.vectors(B::normal_x);
  const sdk::VectorColumns force = columns.vectors(B::force_x);
  const sdk::VectorColumns velocity = columns.vectors(B::velocity_x);
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double approach = dot(velocity[q], n[q]);
    const double along = dot(force[q], n[q]) * approach;
    const double aside = dot(sdk::in_contact_plane(force[q], n[q]).part, velocity[q]);
    normal[q] -= step * share_of<part>(approach) * along;
    tangential[q] -= step * share_of<part>(aside) * aside;
  }
}

template <Part part>
inline __attribute__((always_inline)) void add_rolling_work(BatchColumns& columns,
                                                            std::size_t count, double step,
                                                            double* tangential) {
  const sdk::VectorColumns couple = columns.vectors(B::torque_x);
  const sdk::VectorColumns rotation = columns.vectors(B::rotation_x);
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double power = dot(couple[q], rotation[q]);
    tangential[q] -= step * share_of<part>(power) * power;
  }
}

DUST_KERNEL void add_done(BatchColumns& columns, std::size_t count, double step, bool is_rolling,
                          double* normal, double* tangential) {
  add_work<Part::done>(columns, count, step, normal, tangential);
  if (is_rolling) add_rolling_work<Part::done>(columns, count, step, tangential);
}
DUST_KERNEL void add_ahead(BatchColumns& columns, std::size_t count, double step, bool is_rolling,
                           double* normal, double* tangential) {
  add_work<Part::ahead>(columns, count, step, normal, tangential);
  if (is_rolling) add_rolling_work<Part::ahead>(columns, count, step, tangential);
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
  const bool is_rolling = law.rolling != nullptr;
  add_done(columns, count, step, is_rolling, normal_work, tangential_work);
  ElasticEnergy stored;
  find_elastic_energy(law, columns, count, stored);
  hand_out(normal_work, stored.normal, count, out.normal);
  hand_out(tangential_work, stored.friction, count, out.tangential);
  add_ahead(columns, count, step, is_rolling, normal_work, tangential_work);
}

void scatter_dissipation(const Dissipation& out, const PairBatch& batch,
                         std::span<const contact::Places> slots, bool has_scales, double* force) {
  const double* const scale_i = batch.columns.column(B::scale_i);
  const double* const scale_j = batch.columns.column(B::scale_j);
  const auto add = [&](std::int32_t side, std::size_t q, double half) {
    double* row = force + k_force_row * static_cast<std::size_t>(side);
    row[k_normal_work] += half * out.normal[q];
    row[k_tangential_work] += half * out.tangential[q];
  };
  for (std::size_t q = 0; q < batch.count; ++q) {
    const contact::Places& place = slots[batch.entry(q)];
    add(place.a, q, has_scales ? 0.5 * scale_i[q] : 0.5);
    add(place.b, q, has_scales ? 0.5 * scale_j[q] : 0.5);
  }
}

}  // namespace dust::particles
