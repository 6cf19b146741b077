// SPDX-License-Identifier: Apache-2.0
#include "particles/energy/elastic_energy.hpp"

#include "dust/sdk/vec3.hpp"

namespace dust::particles {

using contact::BatchColumns;
using sdk::Vec3;

ElasticEnergy elastic_energy(const PairLaws& law, BatchColumns& columns, std::size_t q) {
  using B = BatchColumns;
  const auto get = [&](int c) {
    return Vec3{columns.column(c)[q], columns.column(c + 1)[q], columns.column(c + 2)[q]};
  };
  const double overlap = columns.column(law.cohesion ? B::contact_overlap : B::overlap)[q];
  if (!(overlap > 0.0)) return {0.0, 0.0};
  const double normal = columns.column(B::normal_stiffness)[q] * overlap * overlap;
  const Vec3 n = get(B::normal_x);
  const Vec3 force = get(B::force_x);
  const Vec3 tangential = force - dot(force, n) * n;
  const double stiffness = columns.column(B::tangential_stiffness)[q];
  return {(law.contact->has_hertz_force() ? 0.4 : 0.5) * normal,  // 1 / (p + 1)
          stiffness > 0.0 ? 0.5 * dot(tangential, tangential) / stiffness : 0.0};
}

}  // namespace dust::particles
