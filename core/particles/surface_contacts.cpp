// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"
#include "particles/wall_contacts.hpp"

#include <algorithm>

/// Contacts of a chunk's grains with surfaces.
namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;

/// Where some grains are nearest to a surface.
struct SurfacePoints {
  double distance[k_batch];
  double normal[3][k_batch];

  [[nodiscard]] bodies::SurfacePoint point(std::size_t n) const {
    return {distance[n], {normal[0][n], normal[1][n], normal[2][n]}};
  }

  void find(const Surface& surface, const double* position, std::span<const std::int32_t> rows,
            double range, std::int32_t* hints) {
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
                   .hint = hints,
                   .distance = distance,
                   .normal_x = normal[0],
                   .normal_y = normal[1],
                   .normal_z = normal[2]});
  }
};

}  // namespace

void Dem::Impl::chunk_surfaces(Chunk& chunk, double* force) {
  ContactList& list = chunk.surfaces;
  auto& columns = thread_columns();
  const contact::PairView pairs = list.view(history_stride);
  const int groups = static_cast<int>(history_stride / 4);
  const contact::RowView grains = row_view();
  std::int32_t contacts[k_batch];
  std::int32_t local[k_batch];
  bool is_new[k_batch];
  for (const Segment& segment : list.segments) {
    const Surface& surface = surfaces[static_cast<std::size_t>(segment.surface)];
    const PairLaws& law = laws[static_cast<std::size_t>(segment.law)];
    const double range = law.range;
    SurfacePoints near;
    const auto look = [&](std::int32_t begin, std::int32_t end) {
      const std::span<const std::int32_t> rows(list.a.data() + begin,
                                               static_cast<std::size_t>(end - begin));
      near.find(surface, store.position.data(), rows, range, chunk.hints.data() + begin);
    };
    std::size_t count = 0;
    const auto flush = [&] {
      if (count == 0) return;
      derive_wall_columns(surface, time, steps.coarse_step, count, columns);
      contact::load_history(pairs, contacts, count, groups, columns);
      evaluate_laws(law, columns, count, steps.coarse_step);
      contact::store_history(pairs, contacts, count, groups, columns);
      if (wall_loads.is_on()) note_wall_loads(chunk, surface, contacts, is_new, count, columns);
      contact::scatter_single(local, count, columns, force);
      chunk.contacts += law.cohesion ? in_touch(columns, count) : static_cast<std::int64_t>(count);
      count = 0;
    };
    for (std::int32_t q = segment.begin; q < segment.end; ++q) {
      const std::size_t n = static_cast<std::size_t>(q - segment.begin) % k_batch;
      if (n == 0) look(q, std::min(segment.end, q + static_cast<std::int32_t>(k_batch)));
      const auto u = static_cast<std::size_t>(q);
      const std::int32_t i = list.a[u];
      const double radius = store.position[4 * static_cast<std::size_t>(i) + 3];
      const double overlap = radius - near.distance[n];
      if (!(overlap > -range)) {
        if (list.is_touching[u] != 0) {
          list.is_touching[u] = 0;
          std::fill_n(list.history.data() + u * history_stride, history_stride, 0.0);
        }
        continue;
      }
      is_new[count] = list.is_touching[u] == 0;
      list.is_touching[u] = 1;
      contacts[count] = q;
      local[count] = i - chunk.begin;
      put_at_wall(GrainAtWall::from(grains, static_cast<std::size_t>(i)), near.point(n), count,
                  columns);
      chunk.largest_overlap = std::max(chunk.largest_overlap, overlap / radius);
      if (++count == k_batch) flush();
    }
    flush();
  }
}

/// Books what a batch did to a wall. The velocity columns hold the relative velocity of the contact
/// points, the separation columns that of the surface.
void Dem::Impl::note_wall_loads(Chunk& chunk, const Surface& surface, const std::int32_t* contacts,
                                const bool* is_new, std::size_t count, BatchColumns& columns) {
  using B = BatchColumns;
  double* sums =
      chunk.wall_sums.data() + WallLoads::k_sums * static_cast<std::size_t>(surface.wall);
  for (std::size_t q = 0; q < count; ++q) {
    const auto get = [&](int column) {
      return sdk::Vec3{columns.column(column)[q], columns.column(column + 1)[q],
                       columns.column(column + 2)[q]};
    };
    const auto row =
        static_cast<std::size_t>(chunk.surfaces.a[static_cast<std::size_t>(contacts[q])]);
    const double* p = store.position.data() + 4 * row;
    const double weight = store.weight[row];
    add_load(sums, {p[0], p[1], p[2]}, get(B::force_x), get(B::torque_i_x), get(B::separation_x),
             weight * steps.coarse_step);
    if (!is_new[q]) continue;
    chunk.wall_impacts.push_back(impact_of(surface.wall, 1.0 / store.velocity(row)[3], weight,
                                           get(B::velocity_x), get(B::normal_x)));
  }
}

}  // namespace dust::particles
