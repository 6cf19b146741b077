// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "particles/neighbours/search.hpp"
#include "particles/store/tile.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// What stands on the second side of a list's entries.
enum class PartnerKind : std::uint8_t {
  particles,
  surfaces,  ///< their numbers
  both       ///< particles, and surfaces as -1 - number
};

/// Contacts of one law, [begin, end) of a list.
struct LawRange {
  std::int32_t law = 0;
  std::int32_t surface = -1;
  std::int32_t begin = 0;
  std::int32_t end = 0;
  /// Of a contact list: [begin, persistent_end) touched when it was pruned, a multiple of eight.
  std::int32_t persistent_end = 0;
};

/// Who may meet whom, law by law: a part of an outer list.
class PairList {
 public:
  explicit PairList(PartnerKind partners) : partners_(partners) {}

  [[nodiscard]] PartnerKind partners() const { return partners_; }
  [[nodiscard]] std::size_t size() const { return a_.size(); }
  [[nodiscard]] std::span<const std::int32_t> a() const { return a_; }
  [[nodiscard]] std::span<const std::int32_t> b() const { return b_; }
  [[nodiscard]] std::span<const LawRange> ranges() const { return ranges_; }
  [[nodiscard]] bool has(std::int32_t i, std::int32_t j) const;

  void clear() { a_.clear(), b_.clear(), ranges_.clear(); }
  void push(std::int32_t i, std::int32_t j) { a_.push_back(i), b_.push_back(j); }
  /// The pairs of a tile by their earlier row, those of one row as they were found: the contacts of
  /// the same particles lie side by side.
  void assign_by_row(std::span<const RowPair> pairs, Tile tile);

  /// Sorts the entries by law and surface, else as they stand. `law`: of each entry, of `laws`.
  void group_by_law(std::span<const std::int32_t> law, std::int32_t laws);
  /// All entries are one range whatever their laws: the fine level finds those itself.
  void group_as_one();

  void set_ranges(std::vector<LawRange> ranges) { ranges_ = std::move(ranges); }
  void add_to(base::Digest& digest) const;

 private:
  PartnerKind partners_;
  std::vector<std::int32_t> a_;
  std::vector<std::int32_t> b_;
  std::vector<LawRange> ranges_;
};

/// Of entries of a list of either kind.
void add_entries(base::Digest& digest, std::span<const std::int32_t> a,
                 std::span<const std::int32_t> b, std::span<const LawRange> ranges);

}  // namespace dust::particles
