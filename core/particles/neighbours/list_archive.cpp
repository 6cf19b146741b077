// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/list_archive.hpp"

namespace dust::particles {

FlatLists::FlatLists(sdk::ArchiveReader& archive, const std::string& name)
    : sizes_(archive.integers(name + "_sizes")),
      a_(archive.integers(name + "_a")),
      b_(archive.integers(name + "_b")),
      ranges_(archive.integers(name + "_segments")),
      touching_(archive.integers(name + "_touching")),
      history_(archive.numbers(name + "_history")) {}

void FlatLists::save(sdk::ArchiveWriter& archive, const std::string& name) const {
  archive.integers(name + "_sizes", sizes_);
  archive.integers(name + "_a", a_);
  archive.integers(name + "_b", b_);
  archive.integers(name + "_touching", touching_);
  archive.integers(name + "_segments", ranges_);
  archive.numbers(name + "_history", history_);
}

void FlatLists::add(std::span<const std::int32_t> a, std::span<const std::int32_t> b,
                    std::span<const LawRange> ranges) {
  sizes_.insert(sizes_.end(),
                {static_cast<std::int64_t>(a.size()), static_cast<std::int64_t>(ranges.size())});
  a_.insert(a_.end(), a.begin(), a.end());
  b_.insert(b_.end(), b.begin(), b.end());
  for (const LawRange& r : ranges) {
    ranges_.insert(ranges_.end(), {r.law, r.surface, r.begin, r.end, r.persistent_end});
  }
}

void FlatLists::add(const PairList& list) { add(list.a(), list.b(), list.ranges()); }

void FlatLists::add(const ContactList& list) {
  add(list.a(), list.b(), list.ranges());
  touching_.insert(touching_.end(), list.touching().begin(), list.touching().end());
  history_.insert(history_.end(), list.histories().begin(), list.histories().end());
}

void FlatLists::take(ContactList& list, std::size_t history_stride) {
  const auto [entries, ranges] = next_sizes();
  list.clear();
  for (std::size_t q = entry_; q < entry_ + entries; ++q) {
    const auto touching = static_cast<std::uint8_t>(touching_.at(q));
    list.push(static_cast<std::int32_t>(a_.at(q)), static_cast<std::int32_t>(b_.at(q)),
              touching != 0 ? history_.data() + q * history_stride : nullptr, touching);
  }
  list.set_ranges(next_ranges(ranges));
  entry_ += entries;
}

void FlatLists::take(PairList& list) {
  const auto [entries, ranges] = next_sizes();
  list.clear();
  for (std::size_t q = entry_; q < entry_ + entries; ++q) {
    list.push(static_cast<std::int32_t>(a_.at(q)), static_cast<std::int32_t>(b_.at(q)));
  }
  list.set_ranges(next_ranges(ranges));
  entry_ += entries;
}

std::pair<std::size_t, std::size_t> FlatLists::next_sizes() {
  const auto entries = static_cast<std::size_t>(sizes_.at(next_++));
  const auto ranges = static_cast<std::size_t>(sizes_.at(next_++));
  return {entries, ranges};
}

std::vector<LawRange> FlatLists::next_ranges(std::size_t count) {
  std::vector<LawRange> found;
  for (std::size_t r = range_; r < range_ + count; ++r) {
    const auto get = [&](std::size_t k) {
      return static_cast<std::int32_t>(ranges_.at(5 * r + k));
    };
    found.push_back({get(0), get(1), get(2), get(3), get(4)});
  }
  range_ += count;
  return found;
}

}  // namespace dust::particles
