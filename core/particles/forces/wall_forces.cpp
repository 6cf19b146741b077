// SPDX-License-Identifier: Apache-2.0
#include "particles/energy/elastic_energy.hpp"
#include "particles/forces/contact_forces.hpp"
#include "particles/forces/handover.hpp"
#include "particles/forces/law_stages.hpp"
#include "particles/forces/wall_contacts.hpp"
#include "particles/work/dissipation.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

/// Contacts of a tile's particles with surfaces.
namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;

/// Where some particles are nearest to a surface.
struct SurfacePoints {
  double distance[k_batch];
  double normal[3][k_batch];

  [[nodiscard]] bodies::SurfacePoint point(std::size_t n) const {
    return {distance[n], {normal[0][n], normal[1][n], normal[2][n]}};
  }

  void find(const Surface& surface, const double* position, std::span<const std::int32_t> rows,
            double range, std::int32_t* nearest_triangles) {
    double centre[3][k_batch];
    double reach[k_batch];
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const double* p = position + 4 * static_cast<std::ptrdiff_t>(rows[n]);
      for (int d = 0; d < 3; ++d) centre[d][n] = p[d];
      reach[n] = p[3] + range;
    }
    surface.touch({.count = rows.size(),
                   .x = centre[0],
                   .y = centre[1],
                   .z = centre[2],
                   .reach = reach,
                   .hint = nearest_triangles,
                   .distance = distance,
                   .normal_x = normal[0],
                   .normal_y = normal[1],
                   .normal_z = normal[2]});
  }
};

/// Of a particle at a wall that has moved by `wall` and turned by `wall_angle`.
WorkingContact moved_at_wall(sdk::Vec3 displacement, sdk::Vec3 angle, sdk::Vec3 wall,
                             sdk::Vec3 wall_angle, sdk::Vec3 normal, double lever) {
  WorkingContact c{};
  c.normal = normal;
  c.approach = -dot(displacement - wall, normal);
  c.slip = displacement - wall - lever * cross(angle, normal);
  c.turn = angle - wall_angle;
  c.wall = wall;
  c.wall_angle = wall_angle;
  return c;
}

}  // namespace

/// Contacts with a surface until a batch is full.
struct ContactForces::WallBatch {
  /// Not an aggregate: its arrays are filled as they are needed, never cleared.
  WallBatch(const ContactScene& on, const LawRange& laws, const contact::PairView& entries,
            std::int32_t first, OfTile& sums, double* forces)
      : scene(on),
        surface(on.surfaces[static_cast<std::size_t>(laws.surface)]),
        law(on.laws[static_cast<std::size_t>(laws.law)]),
        list(entries),
        first_row(first),
        tile(sums),
        force(forces),
        columns(thread_columns()) {}

  const ContactScene& scene;
  const Surface& surface;
  const PairLaws& law;
  const contact::PairView& list;
  std::int32_t first_row;  ///< of the tile
  OfTile& tile;
  double* force;
  BatchColumns& columns;
  std::size_t count = 0;
  std::int32_t contacts[k_batch];
  std::int32_t rows[k_batch];
  std::int32_t local_rows[k_batch];
  bool is_new[k_batch];

  /// Entry `q` of the list, `overlap` [m] deep or within the law's range.
  void add(std::int32_t q, double overlap, const bodies::SurfacePoint& near) {
    const auto u = static_cast<std::size_t>(q);
    const std::int32_t row = list.a[u];
    is_new[count] = list.is_touching[u] == 0 && !is_handed_over(u);
    list.is_touching[u] = 1;
    contacts[count] = q;
    rows[count] = row;
    local_rows[count] = row - first_row;
    const auto grain = GrainAtWall::from(scene.rows(), static_cast<std::size_t>(row));
    put_at_wall(grain, near, count, columns);
    if (tile.energy != nullptr) {
      thread_motion().set_particle(count, grain.displacement, grain.angle);
    }
    if (surface.opening >= 0 && overlap > 0.0) {
      scene.opening_marks.note(surface, row, grain.position - near.distance * near.normal);
    }
    tile.largest_overlap = std::max(tile.largest_overlap, overlap / grain.radius);
    if (++count == k_batch) evaluate();
  }
  [[nodiscard]] bool reaches(const Surface& other, std::int32_t row) const;
  [[nodiscard]] bool is_handed_over(std::size_t entry) const;
  void record_work();
  void note_loads();
  void record_separated(std::size_t entry);
  void evaluate() {
    if (count == 0) return;
    const int groups = static_cast<int>(list.history_stride / 4);
    derive_wall_columns(surface, scene.time, scene.step, count, columns);
    for (std::size_t q = 0; law.range > 0.0 && q < count; ++q) is_new[q] = has_struck(columns, q);
    contact::load_history(list, contacts, count, groups, columns);
    if (tile.energy != nullptr) thread_motion().take_walls(columns, count, surface.is_turning);
    evaluate_laws(law, columns, count, scene.step);
    if (scene.work != nullptr) note_work();
    if (tile.energy != nullptr) record_work();
    contact::store_history(list, contacts, count, groups, columns);
    if (!tile.wall_sums.empty()) note_loads();
    contact::scatter_single(local_rows, count, columns, force);
    tile.contacts += law.cohesion ? in_touch(columns, count) : static_cast<std::int64_t>(count);
    count = 0;
  }
  void note_work() {
    Dissipation lost;
    find_dissipation(law, columns, count, scene.step, scene.laws.work_column(), lost);
    for (std::size_t q = 0; q < count; ++q) {
      scene.work->add_with_wall(static_cast<std::size_t>(rows[q]),
                                static_cast<std::size_t>(surface.wall), lost.normal[q],
                                lost.tangential[q]);
    }
  }
};

bool ContactForces::WallBatch::reaches(const Surface& other, std::int32_t row) const {
  const double* const p = scene.particles.position(static_cast<std::size_t>(row));
  const double reach = p[3] + law.range;
  return other.contact({p[0], p[1], p[2]}, reach).distance < reach;
}

/// With another surface that the same grain may touch.
bool ContactForces::WallBatch::is_handed_over(std::size_t entry) const {
  const std::int32_t row = list.a[entry];
  auto others = std::views::iota(std::size_t{0}, list.count) |
                std::views::filter([&](std::size_t e) { return list.a[e] == row; }) |
                std::views::transform([&](std::size_t e) {
                  return SurfaceContact{e, &scene.surfaces[static_cast<std::size_t>(list.b[e])]};
                });
  return join_handover(list, {entry, &surface}, others,
                       [&](const Surface& other) { return reaches(other, row); });
}

/// The energy account of the batch.
void ContactForces::WallBatch::record_work() {
  using B = BatchColumns;
  const ContactMotion& motion = thread_motion();
  double* const history = columns.history()[scene.laws.account_column()];
  const auto stride = static_cast<std::size_t>(columns.history()[1] - columns.history()[0]);
  ElasticEnergy elastic;
  find_elastic_energy(law, columns, count, elastic);
  for (std::size_t q = 0; q < count; ++q) {
    WorkingContact c = moved_at_wall(motion.displacement(q), motion.angle_i(q), motion.wall(q),
                                     motion.wall_angle(q), columns.vectors(B::normal_x)[q],
                                     columns.column(B::lever_i)[q]);
    c.weight = scene.particles.weight(static_cast<std::size_t>(rows[q]));
    c.force = columns.vectors(B::force_x)[q];
    if (law.rolling) c.couple = columns.vectors(B::torque_x)[q];
    tile.energy->elastic_normal += c.weight * elastic.normal[q];
    tile.energy->elastic_friction += c.weight * elastic.friction[q];
    add_work(c, history + q, stride, *tile.energy);
  }
}

/// One that has parted from the surface in this step: its history is about to be cleared.
void ContactForces::WallBatch::record_separated(std::size_t entry) {
  const auto row = static_cast<std::size_t>(list.a[entry]);
  const auto grain = GrainAtWall::from(scene.rows(), row);
  const bodies::SurfacePoint near = surface.contact(grain.position, 2.0 * grain.radius + law.range);
  if (!std::isfinite(near.distance)) return;
  WorkingContact c =
      moved_at_wall(grain.displacement, grain.angle, {}, {}, near.normal, grain.radius);
  c.weight = scene.particles.weight(row);
  add_work(c, list.history + entry * list.history_stride + scene.laws.account_column(), 1,
           *tile.energy);
}

void ContactForces::walls(const ContactScene& scene, Tile range, TileContacts& contacts,
                          OfTile& tile, double* force) {
  const contact::PairView list = contacts.walls.view();
  const double* const position = scene.rows().position;
  for (const LawRange& r : contacts.walls.ranges()) {
    SurfacePoints near;
    WallBatch batch(scene, r, list, range.begin, tile, force);
    const Surface& surface = batch.surface;
    const PairLaws& law = batch.law;
    for (std::int32_t q = r.begin; q < r.end; ++q) {
      const std::size_t n = static_cast<std::size_t>(q - r.begin) % k_batch;
      if (n == 0) {
        const auto count =
            static_cast<std::size_t>(std::min(r.end, q + static_cast<std::int32_t>(k_batch)) - q);
        near.find(surface, position, {list.a + q, count}, law.range,
                  contacts.nearest_triangles.data() + q);
      }
      const auto u = static_cast<std::size_t>(q);
      const double radius = position[4 * static_cast<std::size_t>(list.a[u]) + 3];
      const double overlap = radius - near.distance[n];
      if (overlap > -law.range) {
        batch.add(q, overlap, near.point(n));
      } else if (list.is_touching[u] != 0 && !batch.is_handed_over(u)) {
        if (tile.energy != nullptr) batch.record_separated(u);
        list.is_touching[u] = 0;
        std::fill_n(list.history + u * list.history_stride, list.history_stride, 0.0);
      }
    }
    batch.evaluate();
  }
}

/// Books what a batch did to a wall. The velocity columns hold the relative velocity of the contact
/// points, the separation columns that of the surface.
void ContactForces::WallBatch::note_loads() {
  using B = BatchColumns;
  double* sums = tile.wall_sums.data() + WallLoads::k_sums * static_cast<std::size_t>(surface.wall);
  for (std::size_t q = 0; q < count; ++q) {
    const auto get = [&](int column) {
      return sdk::Vec3{columns.column(column)[q], columns.column(column + 1)[q],
                       columns.column(column + 2)[q]};
    };
    const auto row = static_cast<std::size_t>(rows[q]);
    const double* p = scene.particles.position(row);
    const double weight = scene.particles.weight(row);
    add_load(sums, {p[0], p[1], p[2]}, get(B::force_x), get(B::torque_i_x),
             wall_power(surface, law.rolling != nullptr, q, columns), weight * scene.step);
    if (tile.keeps_sliding) {
      tile.slidings.add(sliding_contact(columns, q,
                                        {.particle = rows[q],
                                         .wall = surface.wall,
                                         .point = {p[0], p[1], p[2]},
                                         .weighted_time = weight * scene.step}));
    }
    if (!is_new[q]) continue;
    tile.wall_impacts.push_back(impact_of(surface.wall, 1.0 / scene.particles.inverse_mass(row),
                                          weight, get(B::velocity_x), get(B::normal_x)));
  }
}

}  // namespace dust::particles
