// SPDX-License-Identifier: Apache-2.0
#include "contact/standing.hpp"
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;

/// Forces and torques of a chunk's grains and, behind them, of its guests, eight numbers each: of
/// the calling thread, so that they stay in its cache. All zero: whoever takes a force out while it
/// is near leaves zeros.
double* empty_force(const Chunk& chunk) {
  thread_local contact::AlignedVector<double> force;
  const auto rows = static_cast<std::size_t>(chunk.end - chunk.begin);
  const std::size_t size = 8 * (rows + chunk.guest_rows.size());
  if (force.size() < size) force.resize(size, 0.0);
  return force.data();
}

}  // namespace

std::int64_t in_touch(BatchColumns& columns, std::size_t count) {
  const double* overlap = columns.column(BatchColumns::overlap);
  return std::count_if(overlap, overlap + count, [](double d) { return d > 0.0; });
}

contact::BatchColumns& thread_columns() {
  thread_local contact::BatchColumns columns;
  return columns;
}

void evaluate_laws(const PairLaws& law, BatchColumns& columns, std::size_t count,
                   double time_step) {
  sdk::ContactBatch batch = columns.view(count, time_step, 0);
  const int first_rolling = law.contact->history_size();
  if (law.cohesion) {
    const int first = first_rolling + (law.rolling ? law.rolling->history_size() : 0);
    contact::derive_normal_velocity(columns, count);
    law.cohesion->evaluate(columns.cohesion_view(count, time_step, first));
    batch.overlap = columns.column(BatchColumns::contact_overlap);
  }
  law.contact->evaluate(batch);
  if (law.cohesion) contact::subtract_attraction(columns, count);
  if (law.rolling) law.rolling->evaluate(columns.view(count, time_step, first_rolling));
  contact::derive_torques(columns, count, law.rolling != nullptr);
}

/// Adds what other chunks' contacts do to the grains that stand in their lists. `force`: eight
/// numbers of each row of the chunk, or of those that wait, by place.
void Dem::Impl::take_gifts(Chunk& chunk, double* force, ForceOrder order) {
  for (const Gift& gift : chunk.gifts) {
    const double* given = chunks[static_cast<std::size_t>(gift.chunk)].guest_force.data() +
                          8 * static_cast<std::ptrdiff_t>(gift.guest);
    const auto place = static_cast<std::size_t>(gift.place);
    const auto at = order == ForceOrder::by_row
                        ? static_cast<std::size_t>(chunk.awake.rows[place] - chunk.begin)
                        : place - chunk.moved;
    double* f = force + 8 * at;
    for (int d = 0; d < 8; ++d) f[d] += given[d];
    if (contact_force.empty()) continue;
    double* kept = contact_force.data() + 4 * static_cast<std::ptrdiff_t>(chunk.awake.rows[place]);
    for (int d = 0; d < 3; ++d) kept[d] += given[d];
  }
}

void Dem::Impl::contact(double now, bool keeps_force) {
  time = now;
  if (keeps_force) {
    contact_force.assign(4 * coarse_count, 0.0);
  } else {
    contact_force.clear();
  }
  ++contact_round;
  for (Surface& s : surfaces) s.move_to(now);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    double* force = empty_force(chunk);
    chunk.contacts = 0;
    chunk_pairs(chunk, force);
    chunk_surfaces(chunk, force);
    double* guests = force + 8 * (chunk.end - chunk.begin);
    double* guests_end = guests + 8 * static_cast<std::ptrdiff_t>(chunk.guest_rows.size());
    chunk.guest_force.assign(guests, guests_end);
    std::fill(guests, guests_end, 0.0);
    std::atomic_ref(given_in[c]).store(contact_round, std::memory_order_release);
    if (keeps_force) keep_force(chunk, force);
    if (has_all_gifts(chunk)) {
      move_all(chunk, force);
    } else {
      move_own(chunk, force);
    }
  });
}

/// Whether all earlier chunks that look at grains of this one have done so. One thread takes the
/// chunks in order and finds it always so.
bool Dem::Impl::has_all_gifts(const Chunk& chunk) const {
  return std::all_of(chunk.givers.begin(), chunk.givers.end(), [&](std::int32_t giver) {
    return std::atomic_ref(given_in[static_cast<std::size_t>(giver)])
               .load(std::memory_order_acquire) == contact_round;
  });
}

/// Everybody moves at once, while the rows and forces are in the cache.
void Dem::Impl::move_all(Chunk& chunk, double* force) {
  const std::span<const std::int32_t> rows = chunk.awake.rows;
  take_gifts(chunk, force, ForceOrder::by_row);
  resume_course(chunk, Movers::all);
  chunk.moved = rows.size();
  chunk.force.clear();
  if (static_cast<std::int32_t>(rows.size()) == chunk.end - chunk.begin) {
    integrate_all(static_cast<std::size_t>(chunk.begin), rows.size(), force);
  } else {
    integrate_awake(rows, static_cast<std::size_t>(chunk.begin), force, ForceOrder::by_row);
  }
  if (is_check_due()) check(chunk, since_watch + 1);
}

/// Grains nobody else looks at move at once; the others' forces are put aside.
void Dem::Impl::move_own(Chunk& chunk, double* force) {
  const std::span<const std::int32_t> rows = chunk.awake.rows;
  const auto first = static_cast<std::size_t>(chunk.begin);
  const std::size_t count = chunk.awake.own;
  resume_course(chunk, Movers::unshared);
  chunk.moved = count;
  integrate_awake(rows.first(count), first, force, ForceOrder::by_row);
  chunk.force.resize(8 * (rows.size() - count));
  for (std::size_t k = count; k < rows.size(); ++k) {
    double* waiting = force + 8 * (static_cast<std::size_t>(rows[k]) - first);
    std::copy_n(waiting, 8, chunk.force.data() + 8 * (k - count));
    std::fill_n(waiting, 8, 0.0);
  }
}

void Dem::Impl::keep_force(const Chunk& chunk, const double* force) {
  for (const std::int32_t row : chunk.awake.rows) {
    std::copy_n(force + 8 * (row - chunk.begin), 3,
                contact_force.data() + 4 * static_cast<std::ptrdiff_t>(row));
  }
}

/// Statistical weights of the sides of a batch, and the effective mass that a pair shows with them;
/// returns whether any two differ.
bool Dem::Impl::find_scales(const contact::PairView& pairs, const std::int32_t* contacts,
                            std::size_t first, std::size_t count, BatchColumns& columns) const {
  if (!has_weights) return false;
  bool has_scales = false;
  double* scale_i = columns.column(BatchColumns::scale_i);
  double* scale_j = columns.column(BatchColumns::scale_j);
  for (std::size_t q = 0; q < count; ++q) {
    const std::size_t entry =
        contacts == nullptr ? first + q : static_cast<std::size_t>(contacts[q]);
    const double wi = store.weight[static_cast<std::size_t>(pairs.a[entry])];
    const double wj = store.weight[static_cast<std::size_t>(pairs.b[entry])];
    scale_i[q] = felt_share(wi, wj);
    scale_j[q] = felt_share(wj, wi);
    if (wi == wj) continue;
    has_scales = true;
    const auto inverse_mass = [&](std::int32_t row) {
      return store.velocity(static_cast<std::size_t>(row))[3];
    };
    columns.column(BatchColumns::inverse_mass)[q] =
        scale_i[q] * inverse_mass(pairs.a[entry]) + scale_j[q] * inverse_mass(pairs.b[entry]);
  }
  return has_scales;
}

/// Contacts that touched when the watch began: nearly all still do, so that nobody is sorted out,
/// and their histories stand where the laws look for them.
void Dem::Impl::standing_pairs(const Segment& segment, Chunk& chunk, double* force) {
  const contact::PairView pairs = chunk.pairs.view(history_stride);
  const PairLaws& law = laws[static_cast<std::size_t>(segment.law)];
  auto& columns = thread_columns();
  const auto end = static_cast<std::size_t>(segment.standing);
  for (auto p = static_cast<std::size_t>(segment.begin); p < end; p += k_batch) {
    const std::size_t count = std::min(k_batch, end - p);
    const std::size_t near =
        contact::gather_standing(row_view(), images, pairs, p, count, law.range, columns);
    columns.keep_history_at(pairs.history + p * history_stride, count);
    const bool has_scales = find_scales(pairs, nullptr, p, count, columns);
    const double overlap = contact::derive_pair_columns(columns, count);
    chunk.largest_overlap = std::max(chunk.largest_overlap, overlap);
    if (near < count) contact::hold_apart(pairs.is_touching + p, count, columns);
    evaluate_laws(law, columns, count, steps.coarse_step);
    if (near < count) {
      contact::forget_apart(pairs.is_touching + p, count, history_stride, columns);
    }
    chunk.contacts += law.cohesion ? in_touch(columns, count) : static_cast<std::int64_t>(near);
    contact::scatter_pairs(chunk.places.data() + p, count, has_scales, columns, force);
  }
  columns.keep_history_here();
}

/// The others: found touching or not at each step.
void Dem::Impl::open_pairs(const Segment& segment, Chunk& chunk, double* force) {
  std::int32_t contacts[k_batch];
  auto& columns = thread_columns();
  const contact::PairView pairs = chunk.pairs.view(history_stride);
  const contact::RowView rows = row_view();
  const int groups = static_cast<int>(history_stride / 4);
  const PairLaws& law = laws[static_cast<std::size_t>(segment.law)];
  auto next = static_cast<std::size_t>(segment.standing);
  const auto end = static_cast<std::size_t>(segment.end);
  while (next < end) {
    const std::size_t count =
        contact::gather_touching(rows, images, pairs, next, end, law.range, contacts, columns);
    if (count == 0) continue;
    contact::load_history(pairs, contacts, count, groups, columns);
    const bool has_scales = find_scales(pairs, contacts, 0, count, columns);
    const double overlap = contact::derive_pair_columns(columns, count);
    chunk.largest_overlap = std::max(chunk.largest_overlap, overlap);
    evaluate_laws(law, columns, count, steps.coarse_step);
    chunk.contacts += law.cohesion ? in_touch(columns, count) : static_cast<std::int64_t>(count);
    contact::store_history(pairs, contacts, count, groups, columns);
    contact::scatter_pairs(chunk.places.data(), contacts, count, has_scales, columns, force);
  }
}

void Dem::Impl::chunk_pairs(Chunk& chunk, double* force) {
  stand(chunk.pairs);
  for (const Segment& segment : chunk.pairs.segments) {
    standing_pairs(segment, chunk, force);
    open_pairs(segment, chunk, force);
  }
}

/// The forces on grains that waited for other chunks' contacts.
void Dem::Impl::force() {
  each_waiting([&](Chunk& chunk) { take_gifts(chunk, chunk.force.data(), ForceOrder::by_place); });
}

}  // namespace dust::particles
