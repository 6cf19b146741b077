// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/contact_forces.hpp"

#include "contact/standing.hpp"
#include "particles/forces/law_stages.hpp"
#include "particles/forces/pair_work.hpp"
#include "particles/forces/weight_ratios.hpp"
#include "particles/work/dissipation.hpp"

#include <algorithm>

namespace dust::particles {

using contact::BatchColumns;
using contact::k_batch;

void ContactForces::restart(std::size_t tiles, const WallLoads& loads) {
  largest_before_ = largest_overlap();
  tiles_.assign(tiles, {});
  for (OfTile& t : tiles_) {
    t.wall_sums.assign(WallLoads::k_sums * loads.walls(), 0.0);
    t.keeps_sliding = loads.has_sliding();
  }
}

void ContactForces::evaluate(const ContactScene& scene, Tile range, TileContacts& contacts,
                             double* force) {
  OfTile& tile = tiles_[static_cast<std::size_t>(range.index)];
  tile.contacts = 0;
  tile.slidings.begin_step();
  tile.energy = scene.energy == nullptr
                    ? nullptr
                    : &scene.energy->tile(static_cast<std::size_t>(range.index));
  contacts.pairs.histories_to_columns();
  for (const LawRange& r : contacts.pairs.ranges()) {
    persistent_pairs(scene, r, contacts, tile, force);
    new_pairs(scene, r, contacts, tile, force);
  }
  walls(scene, range, contacts, tile, force);
}

/// What a batch dissipates, beside the forces that it brings; histories stand in the columns.
void ContactForces::note_work(const ContactScene& scene, const PairBatch& batch,
                              std::span<const contact::Places> slots, bool has_scales,
                              double* force) {
  Dissipation lost;
  find_dissipation(batch.law, batch.columns, batch.count, scene.step, scene.laws.work_column(),
                   lost);
  scatter_dissipation(lost, batch, slots, has_scales, force);
}

/// Contacts that touched when the list was pruned: nearly all still do, so that none is sorted out,
/// and their histories stand where the laws look for them.
void ContactForces::persistent_pairs(const ContactScene& scene, const LawRange& range,
                                     TileContacts& contacts, OfTile& tile, double* force) {
  const contact::PairView pairs = contacts.pairs.view();
  const contact::RowView rows = scene.rows();
  const std::size_t stride = pairs.history_stride;
  const PairLaws& law = scene.laws[static_cast<std::size_t>(range.law)];
  auto& columns = thread_columns();
  contact::HistoryElsewhere history(columns);
  const auto end = static_cast<std::size_t>(range.persistent_end);
  for (auto p = static_cast<std::size_t>(range.begin); p < end; p += k_batch) {
    const std::size_t count = std::min(k_batch, end - p);
    const std::size_t near =
        contact::gather_persistent({rows, scene.images, pairs, law.range}, p, count, columns);
    if (tile.energy != nullptr) thread_motion().take_pairs(columns, count);
    history.keep_at(pairs.history + p * stride, count);
    const PairBatch batch{law, pairs, columns, count, p};
    const bool has_scales = scene.has_weights && find_weight_ratios(scene.particles, batch);
    const double overlap = contact::derive_pair_columns(columns, count);
    tile.largest_overlap = std::max(tile.largest_overlap, overlap);
    if (near < count) contact::mask_separated(pairs.is_touching + p, count, columns);
    evaluate_laws(law, columns, count, scene.step);
    if (tile.energy != nullptr) record_work(scene, batch, *tile.energy);
    if (near < count) contact::clear_separated(pairs.is_touching + p, count, stride, columns);
    tile.contacts += law.cohesion ? in_touch(columns, count) : static_cast<std::int64_t>(near);
    if (scene.work != nullptr) note_work(scene, batch, contacts.slots, has_scales, force);
    contact::scatter_pairs(contacts.slots.data() + p, count, has_scales, columns, force);
  }
}

/// The others: found touching or not at each step.
void ContactForces::new_pairs(const ContactScene& scene, const LawRange& range,
                              TileContacts& contacts, OfTile& tile, double* force) {
  std::int32_t touching[k_batch];
  auto& columns = thread_columns();
  const contact::PairView pairs = contacts.pairs.view();
  const contact::RowView rows = scene.rows();
  const int groups = static_cast<int>(pairs.history_stride / 4);
  const PairLaws& law = scene.laws[static_cast<std::size_t>(range.law)];
  auto next = static_cast<std::size_t>(range.persistent_end);
  const auto end = static_cast<std::size_t>(range.end);
  if (tile.energy != nullptr) record_separated(scene, range, pairs, *tile.energy);
  while (next < end) {
    const std::size_t count = contact::gather_touching({rows, scene.images, pairs, law.range}, next,
                                                       end, touching, columns);
    if (count == 0) continue;
    if (tile.energy != nullptr) thread_motion().take_pairs(columns, count);
    contact::load_history(pairs, touching, count, groups, columns);
    const PairBatch batch{law, pairs, columns, count, 0, touching};
    const bool has_scales = scene.has_weights && find_weight_ratios(scene.particles, batch);
    const double overlap = contact::derive_pair_columns(columns, count);
    tile.largest_overlap = std::max(tile.largest_overlap, overlap);
    evaluate_laws(law, columns, count, scene.step);
    tile.contacts += law.cohesion ? in_touch(columns, count) : static_cast<std::int64_t>(count);
    if (tile.energy != nullptr) record_work(scene, batch, *tile.energy);
    if (scene.work != nullptr) note_work(scene, batch, contacts.slots, has_scales, force);
    contact::store_history(pairs, touching, count, groups, columns);
    contact::scatter_pairs(contacts.slots.data(), touching, count, has_scales, columns, force);
  }
}

std::int64_t ContactForces::contacts() const {
  std::int64_t sum = 0;
  for (const OfTile& t : tiles_) sum += t.contacts;
  return sum;
}

double ContactForces::largest_overlap() const {
  double largest = largest_before_;
  for (const OfTile& t : tiles_) largest = std::max(largest, t.largest_overlap);
  return largest;
}

void ContactForces::give_wall_loads(WallLoads& loads) {
  for (OfTile& t : tiles_) loads.take(t.wall_sums, t.wall_impacts, t.slidings);
}

}  // namespace dust::particles
