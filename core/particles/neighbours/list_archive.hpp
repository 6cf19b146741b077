// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "particles/neighbours/contact_list.hpp"
#include "particles/neighbours/pair_list.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dust::particles {

/// The lists of all tiles one after another, as they stand in a checkpoint.
class FlatLists {
 public:
  FlatLists() = default;
  FlatLists(sdk::ArchiveReader& archive, const std::string& name);

  void add(const ContactList& list);
  void add(const PairList& list);
  void save(sdk::ArchiveWriter& archive, const std::string& name) const;
  /// How many lists.
  [[nodiscard]] std::size_t count() const { return sizes_.size() / 2; }

  /// The next list in the order in which they were added.
  void take(ContactList& list, std::size_t history_stride);
  void take(PairList& list);

 private:
  void add(std::span<const std::int32_t> a, std::span<const std::int32_t> b,
           std::span<const LawRange> ranges);
  std::pair<std::size_t, std::size_t> next_sizes();
  std::vector<LawRange> next_ranges(std::size_t count);

  std::vector<std::int64_t> sizes_, a_, b_, ranges_;
  std::vector<std::int64_t> touching_;  ///< of contact lists
  std::vector<double> history_;         ///< of contact lists
  std::size_t next_ = 0, entry_ = 0, range_ = 0;
};

}  // namespace dust::particles
