// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/pair_list.hpp"

#include <algorithm>

namespace dust::particles {

bool PairList::has(std::int32_t i, std::int32_t j) const {
  for (std::size_t q = 0; q < size(); ++q) {
    if (a_[q] == i && b_[q] == j) return true;
  }
  return false;
}

void PairList::assign_by_row(std::span<const RowPair> pairs, Tile tile) {
  std::vector<std::int32_t> next(tile.size() + 1, 0);
  const auto index_of = [&](const RowPair& pair) {
    return static_cast<std::size_t>(std::min(pair[0], pair[1]) - tile.begin);
  };
  for (const auto& pair : pairs) ++next[index_of(pair) + 1];
  for (std::size_t n = 1; n < next.size(); ++n) next[n] += next[n - 1];
  a_.resize(pairs.size());
  b_.resize(pairs.size());
  for (const auto& pair : pairs) {
    const auto to = static_cast<std::size_t>(next[index_of(pair)]++);
    a_[to] = pair[0];
    b_[to] = pair[1];
  }
}

void PairList::group_by_law(std::span<const std::int32_t> law, std::int32_t laws) {
  const std::size_t n = size();
  const bool has_surfaces = partners_ == PartnerKind::surfaces;
  const auto group_of = [&](std::size_t q) {
    return has_surfaces ? b_[q] * laws + law[q] : law[q];
  };
  std::int32_t groups = 0;
  for (std::size_t q = 0; q < n; ++q) groups = std::max(groups, group_of(q) + 1);
  std::vector<std::int32_t> begin(static_cast<std::size_t>(groups) + 1, 0);
  for (std::size_t q = 0; q < n; ++q) ++begin[static_cast<std::size_t>(group_of(q)) + 1];
  ranges_.clear();
  for (std::int32_t g = 0; g < groups; ++g) {
    const auto u = static_cast<std::size_t>(g);
    if (begin[u + 1] > 0) {
      ranges_.push_back({has_surfaces ? g % laws : g, has_surfaces ? g / laws : -1, begin[u],
                         begin[u] + begin[u + 1]});
    }
    begin[u + 1] += begin[u];
  }
  if (ranges_.size() <= 1) return;  // in order already
  std::vector<std::int32_t> a(n);
  std::vector<std::int32_t> b(n);
  for (std::size_t q = 0; q < n; ++q) {
    const auto to = static_cast<std::size_t>(begin[static_cast<std::size_t>(group_of(q))]++);
    a[to] = a_[q];
    b[to] = b_[q];
  }
  a_.swap(a);
  b_.swap(b);
}

void PairList::group_as_one() { ranges_ = {{0, -1, 0, static_cast<std::int32_t>(size())}}; }

void PairList::add_to(base::Digest& digest) const { add_entries(digest, a_, b_, ranges_); }

void add_entries(base::Digest& digest, std::span<const std::int32_t> a,
                 std::span<const std::int32_t> b, std::span<const LawRange> ranges) {
  digest.add(a.data(), a.size()).add(b.data(), b.size());
  for (const LawRange& r : ranges) {
    const std::int32_t numbers[] = {r.law, r.surface, r.begin, r.end, r.persistent_end};
    digest.add(numbers, 5);
  }
}

}  // namespace dust::particles
