// SPDX-License-Identifier: Apache-2.0
#include "particles/work/dissipation.hpp"

#include "dust/sdk/vec3.hpp"
#include "particles/energy/elastic_energy.hpp"
#include "particles/forces/force_buffer.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using sdk::Vec3;

/// What of the work done so far cannot be given back any more.
double hand_out(double& work, double stored) {
  const double given = std::max(0.0, work - stored);
  work -= given;
  return given;
}

}  // namespace

void find_dissipation(const PairLaws& law, BatchColumns& columns, std::size_t count, double step,
                      std::size_t first, Dissipation& out) {
  using B = BatchColumns;
  double* const normal_work = columns.history()[first];
  double* const tangential_work = columns.history()[first + 1];
  for (std::size_t q = 0; q < count; ++q) {
    const auto get = [&](int c) {
      return Vec3{columns.column(c)[q], columns.column(c + 1)[q], columns.column(c + 2)[q]};
    };
    const Vec3 n = get(B::normal_x);
    const Vec3 force = get(B::force_x);
    const Vec3 velocity = get(B::velocity_x);
    const double normal_force = dot(force, n);
    const Vec3 friction = force - normal_force * n;
    normal_work[q] -= step * normal_force * dot(velocity, n);
    tangential_work[q] -= step * dot(friction, velocity);
    if (law.rolling) tangential_work[q] -= step * dot(get(B::torque_x), get(B::rotation_x));
    const ElasticEnergy stored = elastic_energy(law, columns, q);
    out.normal[q] = hand_out(normal_work[q], stored.normal);
    out.tangential[q] = hand_out(tangential_work[q], stored.friction);
  }
}

void scatter_dissipation(const Dissipation& out, const contact::Places* places,
                         const std::int32_t* contacts, std::size_t count, double* force) {
  for (std::size_t q = 0; q < count; ++q) {
    const contact::Places& place = contacts == nullptr ? places[q] : places[contacts[q]];
    for (const std::int32_t side : {place.a, place.b}) {
      double* row = force + k_force_row * static_cast<std::size_t>(side);
      row[3] += 0.5 * out.normal[q];
      row[7] += 0.5 * out.tangential[q];
    }
  }
}

}  // namespace dust::particles
