// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/neighbours/contact_list.hpp"
#include "particles/neighbours/pair_list.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace dust::particles {

/// Contacts in touch on their way from old lists to new ones, through a sort of the rows between:
/// a contact keeps its history whatever its particles' new rows are.
class ContactCarrier {
 public:
  /// `rows`: particles that the old lists name; `stride`: numbers of a history.
  ContactCarrier(std::size_t rows, std::size_t stride) : rows_(rows), stride_(stride) {}

  void take(ContactList&& list) { old_.push_back(std::move(list)); }
  /// After the last list: finds what they hold in touch.
  void arrange();
  /// The new rows: row n was row order[n].
  void renumber(std::span<const std::int32_t> order) {
    old_row_.assign(order.begin(), order.end());
  }

  /// The contacts of a new pair list that are known, in its order. Several threads may ask.
  void adopt(const PairList& list, ContactList& contacts) const;

 private:
  template <class Visit>
  void each(Visit&& visit) const;

  std::size_t rows_;
  std::size_t stride_;
  std::deque<ContactList> old_;
  std::vector<std::int32_t> old_row_;  ///< by new row; empty: rows are what they were
  // By the first particle's old row.
  std::vector<std::int32_t> begin_;
  std::vector<std::int32_t> partner_;
  std::vector<const double*> history_;
  std::vector<std::uint8_t> touching_;
};

}  // namespace dust::particles
