// SPDX-License-Identifier: Apache-2.0
#include "contact/standing.hpp"
#include "particles/impl.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;

}  // namespace

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

}  // namespace dust::particles
