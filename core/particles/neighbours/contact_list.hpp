// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "contact/aligned.hpp"
#include "contact/batch_kernels.hpp"
#include "particles/neighbours/pair_list.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// The entries of a pair list that may touch within the next steps, with the histories of those in
/// touch: a part of an inner list. In each law's range first persistent contacts, then the others,
/// both in the order of the pair list (docs/decisions/0019_persistent_contacts.md).
class ContactList {
 public:
  /// `history_stride`: numbers kept per contact, a multiple of four.
  ContactList(PartnerKind partners, std::size_t history_stride)
      : partners_(partners), stride_(history_stride) {}

  [[nodiscard]] PartnerKind partners() const { return partners_; }
  [[nodiscard]] std::size_t size() const { return a_.size(); }
  [[nodiscard]] std::span<const std::int32_t> a() const { return a_; }
  [[nodiscard]] std::span<const std::int32_t> b() const { return b_; }
  /// 0: not in touch; of the fine level: 1 + the level of the contact.
  [[nodiscard]] std::span<const std::uint8_t> touching() const { return is_touching_; }
  [[nodiscard]] std::span<const LawRange> ranges() const { return ranges_; }
  [[nodiscard]] const double* history(std::size_t entry) const {
    return history_.data() + entry * stride_;
  }
  [[nodiscard]] std::span<const double> histories() const { return history_; }
  /// For the laws.
  [[nodiscard]] contact::PairView view() {
    return {a_.data(), b_.data(), is_touching_.data(), history_.data(), stride_, size()};
  }

  void clear();
  /// `history` of a contact whose `touching` is not 0, else null.
  void push(std::int32_t i, std::int32_t j, const double* history, std::uint8_t touching);
  /// The entries of another list of the same kind behind these. Both without ranges.
  void append(const ContactList& other);
  void set_ranges(std::vector<LawRange> ranges) { ranges_ = std::move(ranges); }

  /// Becomes the entries of `outer` that are in touch, with their histories, and those that may
  /// come to touch: `approach`, one contact::Approach per entry. Between particles, contacts in
  /// touch come first in their range, in eights: the persistent ones. Returns the entries of
  /// `outer` that have overlapped for some steps though no contact of theirs is known: the list
  /// before did not hold them. Valid until the next call by this thread.
  std::span<const std::int32_t> prune(const PairList& outer,
                                      std::span<const std::uint8_t> approach);

  /// The histories of persistent contacts into columns, block by block, in the memory their rows
  /// had: there laws work on them. Nothing where they are so already.
  void histories_to_columns();
  /// And back into rows, as all others know them.
  void histories_to_rows();
  [[nodiscard]] bool has_histories_in_columns() const { return is_in_columns_; }

  /// Particle n becomes new_row[n]; a contact of one that is gone, where that is negative, ends.
  void renumber(std::span<const std::int32_t> new_row);

  void add_entries_to(base::Digest& digest) const { add_entries(digest, a_, b_, ranges_); }
  void add_histories_to(base::Digest& digest) const { digest.add(is_touching_).add(history_); }

 private:
  struct Scratch;
  struct Choice;
  enum class Look { at_marked, at_all };
  bool choose(const PairList& outer, std::span<const std::uint8_t> approach, Look look,
              Scratch& scratch) const;
  void take(const Scratch& scratch, std::size_t count);

  PartnerKind partners_;
  std::size_t stride_;
  std::vector<std::int32_t> a_;
  std::vector<std::int32_t> b_;
  std::vector<std::uint8_t> is_touching_;
  contact::AlignedVector<double> history_;
  std::vector<LawRange> ranges_;
  bool is_in_columns_ = false;  ///< histories of persistent contacts
};

}  // namespace dust::particles
