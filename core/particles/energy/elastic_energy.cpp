// SPDX-License-Identifier: Apache-2.0
#include "particles/energy/elastic_energy.hpp"

#include "dust/sdk/contact_plane.hpp"
#include "dust/sdk/kernel.hpp"

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = BatchColumns;

DUST_KERNEL void find(const double* overlap, double per_overlap_force, BatchColumns& columns,
                      std::size_t count, ElasticEnergy& out) {
  const sdk::VectorColumns n = columns.vectors(B::normal_x);
  const sdk::VectorColumns force = columns.vectors(B::force_x);
  const double* normal_stiffness = columns.column(B::normal_stiffness);
  const double* tangential_stiffness = columns.column(B::tangential_stiffness);
  double* normal = out.normal;
  double* friction = out.friction;
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) {
    const double square = sdk::in_contact_plane(force[q], n[q]).squared;
    const double stiffness = tangential_stiffness[q];
    const bool has_spring = stiffness > 0.0;
    const double of_spring = 0.5 * square / (has_spring ? stiffness : 1.0);
    const double depth = overlap[q];
    const bool is_touching = depth > 0.0;
    normal[q] = is_touching ? per_overlap_force * (normal_stiffness[q] * depth * depth) : 0.0;
    friction[q] = is_touching && has_spring ? of_spring : 0.0;
  }
}

}  // namespace

void find_elastic_energy(const PairLaws& law, BatchColumns& columns, std::size_t count,
                         ElasticEnergy& out) {
  const double* overlap = columns.column(law.cohesion ? B::contact_overlap : B::overlap);
  // 1 / (p + 1) of a force that grows with overlap^p
  find(overlap, law.contact->has_hertz_force() ? 0.4 : 0.5, columns, count, out);
}

}  // namespace dust::particles
