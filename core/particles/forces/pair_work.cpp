// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/pair_work.hpp"
#include "particles/energy/elastic_energy.hpp"

#include "contact/nearest_image.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = BatchColumns;
using sdk::Vec3;

/// Of a pair whose centres are `separation` apart and have moved by `displacement` relative to each
/// other, each having turned by its angle.
WorkingContact moved_pair(Vec3 separation, Vec3 displacement, Vec3 angle_i, Vec3 angle_j,
                          double lever_i, double lever_j) {
  WorkingContact c{};
  const double distance = norm(separation);
  c.normal = separation / distance;
  c.approach = norm(separation - displacement) - distance;
  c.slip = displacement - cross(lever_i * angle_i + lever_j * angle_j, c.normal);
  c.turn = angle_i - angle_j;
  return c;
}

}  // namespace

void record_work(const ContactScene& scene, const PairBatch& batch, EnergySums& sums) {
  BatchColumns& columns = batch.columns;
  const contact::PairView& pairs = batch.pairs;
  const ContactMotion& motion = thread_motion();
  double* const* history = columns.history() + scene.laws.account_column();
  const std::ptrdiff_t stride = columns.history()[1] - columns.history()[0];
  ElasticEnergy elastic;
  find_elastic_energy(batch.law, columns, batch.count, elastic);
  for (std::size_t q = 0; q < batch.count; ++q) {
    const std::size_t entry = batch.entry(q);
    WorkingContact c =
        moved_pair(columns.vectors(B::separation_x)[q], motion.displacement(q), motion.angle_i(q),
                   motion.angle_j(q), columns.column(B::lever_i)[q], columns.column(B::lever_j)[q]);
    c.weight = std::min(scene.particles.weight(static_cast<std::size_t>(pairs.a[entry])),
                        scene.particles.weight(static_cast<std::size_t>(pairs.b[entry])));
    if (pairs.is_touching[entry] != 0) {
      c.force = columns.vectors(B::force_x)[q];
      if (batch.law.rolling) c.couple = columns.vectors(B::torque_x)[q];
      sums.elastic_normal += c.weight * elastic.normal[q];
      sums.elastic_friction += c.weight * elastic.friction[q];
    }
    add_work(c, history[0] + q, static_cast<std::size_t>(stride), sums);
  }
}

void record_separated(const ContactScene& scene, const LawRange& range,
                      const contact::PairView& pairs, EnergySums& sums) {
  const ParticleStore& particles = scene.particles;
  const double reach = scene.laws[static_cast<std::size_t>(range.law)].range;
  for (auto p = static_cast<std::size_t>(range.persistent_end);
       p < static_cast<std::size_t>(range.end); ++p) {
    if (pairs.is_touching[p] == 0) continue;
    const auto i = static_cast<std::size_t>(pairs.a[p]);
    const auto j = static_cast<std::size_t>(pairs.b[p]);
    const Vec3 separation =
        contact::nearest_image(scene.images, particles.position(j), particles.position(i));
    const double radii = particles.radius(i) + particles.radius(j) + reach;
    if (dot(separation, separation) < radii * radii) continue;
    const auto displaced = [](const double* half, double since) {
      return (2.0 * since) * Vec3{half[0], half[1], half[2]};
    };
    const double since_i = particles.time_since_kick(i);
    const double since_j = particles.time_since_kick(j);
    WorkingContact c = moved_pair(separation,
                                  displaced(particles.half_velocity(i), since_i) -
                                      displaced(particles.half_velocity(j), since_j),
                                  displaced(particles.half_rotation(i), since_i),
                                  displaced(particles.half_rotation(j), since_j),
                                  particles.radius(i), particles.radius(j));
    c.weight = std::min(particles.weight(i), particles.weight(j));
    add_work(c, pairs.history + p * pairs.history_stride + scene.laws.account_column(), 1, sums);
  }
}

}  // namespace dust::particles
