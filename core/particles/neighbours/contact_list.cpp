// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/contact_list.hpp"

#include "contact/approach.hpp"
#include "contact/standing.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace dust::particles {
namespace {

/// Entries [next, end) of a contact list.
struct Run {
  std::size_t next = 0;
  std::size_t end = 0;
};

/// Contacts in touch of one run of a list, found in the order of the pair list it came from.
class KnownContacts {
 public:
  /// Those in touch among entries [begin, end), which are not looked at again.
  void take(const ContactList& contacts, std::size_t begin, std::size_t end) {
    if (entries_.size() <= end - begin) entries_.resize(end - begin + 1);
    std::size_t found = 0;
    for (std::size_t u = begin; u < end; ++u) {
      entries_[found] = static_cast<std::int32_t>(u);
      found += contacts.touching()[u] != 0 ? 1 : 0;
    }
    next_ = 0;
    count_ = found;
  }
  /// The contact between a and b, if it is the next, or -1.
  [[nodiscard]] std::int32_t find(const ContactList& contacts, std::int32_t a, std::int32_t b) {
    if (next_ >= count_) return -1;
    const std::int32_t entry = entries_[next_];
    const auto u = static_cast<std::size_t>(entry);
    const bool is_it = (contacts.a()[u] == a) & (contacts.b()[u] == b);
    next_ += is_it ? 1 : 0;
    return is_it ? entry : -1;
  }
  [[nodiscard]] bool is_used_up() const { return next_ >= count_; }

 private:
  std::vector<std::int32_t> entries_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

/// Finds the contacts of a list in the order of the pair list it came from: both runs of a range
/// stand in that order.
class HistoryCursor {
 public:
  void begin(const ContactList& contacts) {
    contacts_ = &contacts;
    persistent_.take(contacts, 0, 0);
    rest_.take(contacts, 0, contacts.ranges().empty() ? contacts.size() : 0);
    is_all_found_ = true;
  }
  /// To the contacts of another range. After a rebuild there is one run of all.
  void turn_to(const LawRange& range) {
    if (contacts_->ranges().empty()) return;
    is_all_found_ = is_all_found();
    persistent_.take(*contacts_, 0, 0), rest_.take(*contacts_, 0, 0);
    for (const LawRange& r : contacts_->ranges()) {
      if (r.law != range.law || r.surface != range.surface) continue;
      const auto middle = static_cast<std::size_t>(r.persistent_end);
      persistent_.take(*contacts_, static_cast<std::size_t>(r.begin), middle);
      rest_.take(*contacts_, middle, static_cast<std::size_t>(r.end));
      return;
    }
  }
  /// The contact in touch of a later entry of the range than that asked for before, or -1.
  [[nodiscard]] std::int32_t find(std::int32_t a, std::int32_t b) {
    return std::max(persistent_.find(*contacts_, a, b), rest_.find(*contacts_, a, b));
  }
  /// Whether each contact of the ranges turned to has been found.
  [[nodiscard]] bool is_all_found() const {
    return is_all_found_ && persistent_.is_used_up() && rest_.is_used_up();
  }

 private:
  const ContactList* contacts_ = nullptr;
  KnownContacts persistent_, rest_;
  bool is_all_found_ = true;
};

/// The entries of a range that are marked, in their order: nearly all are not.
std::size_t find_marked(std::span<const std::uint8_t> marks, std::size_t begin, std::size_t end,
                        std::int32_t* marked) {
  std::int32_t* to = marked;
  const auto take = [&](std::size_t q) {
    *to = static_cast<std::int32_t>(q);
    to += marks[q] != 0 ? 1 : 0;
  };
  std::size_t q = begin;
  for (std::uint64_t eight = 0; q + sizeof(eight) <= end; q += sizeof(eight)) {
    std::memcpy(&eight, marks.data() + q, sizeof(eight));
    if (eight == 0) continue;
    for (std::size_t k = 0; k < sizeof(eight); ++k) take(q + k);
  }
  for (; q < end; ++q) take(q);
  return static_cast<std::size_t>(to - marked);
}

/// Visits the blocks of a list whose histories stand in columns: where one begins, how many rows.
template <class Visit>
void each_block(std::span<const LawRange> ranges, Visit&& visit) {
  for (const LawRange& r : ranges) {
    for (std::int32_t p = r.begin; p < r.persistent_end;) {
      const std::int32_t count =
          std::min(r.persistent_end - p, static_cast<std::int32_t>(contact::k_batch));
      visit(static_cast<std::size_t>(p), static_cast<std::size_t>(count));
      p += count;
    }
  }
}

/// The first `count` of `from` in a block of just their size: lists are most of the memory.
template <class Vector>
void take_exactly(Vector& to, const Vector& from, std::size_t count) {
  const auto end = from.begin() + static_cast<std::ptrdiff_t>(count);
  if (to.capacity() < count || 4 * to.capacity() > 5 * count + 64) {
    Vector(from.begin(), end).swap(to);
  } else {
    to.assign(from.begin(), end);
  }
}

}  // namespace

struct ContactList::Choice {
  std::int32_t entry;    ///< of the pair list
  std::int32_t contact;  ///< before, or -1
};

/// Working space of a thread, never given back: for lists made again and again.
struct ContactList::Scratch {
  std::vector<Choice> touching, apart, chosen;
  std::size_t chosen_count = 0;
  HistoryCursor known;
  std::vector<std::int32_t> marked;
  std::vector<std::int32_t> a, b;
  std::vector<std::uint8_t> is_touching;
  contact::AlignedVector<double> history;
  std::vector<LawRange> ranges;
  std::vector<std::int32_t> unseen;

  void expect(std::size_t entries) {
    for (auto* v : {&touching, &apart, &chosen}) {
      if (v->size() <= entries) v->resize(entries + 1);
    }
    if (marked.size() <= entries) marked.resize(entries + 1);
    ranges.clear();
    unseen.clear();
  }
  void make_room(std::size_t count, std::size_t stride) {
    if (a.size() < count) a.resize(count), b.resize(count), is_touching.resize(count);
    if (history.size() < count * stride) history.resize(count * stride);
  }
};

void ContactList::clear() {
  a_.clear(), b_.clear(), is_touching_.clear(), history_.clear(), ranges_.clear();
}

void ContactList::push(std::int32_t i, std::int32_t j, const double* history,
                       std::uint8_t touching) {
  a_.push_back(i), b_.push_back(j), is_touching_.push_back(touching);
  if (history == nullptr) {
    history_.insert(history_.end(), stride_, 0.0);
  } else {
    history_.insert(history_.end(), history, history + stride_);
  }
}

void ContactList::append(const ContactList& other) {
  for (std::size_t q = 0; q < other.size(); ++q) {
    push(other.a_[q], other.b_[q], other.history(q), other.is_touching_[q]);
  }
}

/// Sorts entries of the pair list into those in touch and those that only approach, without
/// branches on either, which no processor foretells. Returns whether every contact in touch was
/// found.
bool ContactList::choose(const PairList& outer, std::span<const std::uint8_t> approach, Look look,
                         Scratch& scratch) const {
  const bool is_marked_only = look == Look::at_marked;
  scratch.expect(outer.size());
  const std::int32_t* const a = outer.a().data();
  const std::int32_t* const b = outer.b().data();
  Choice* end = scratch.chosen.data();
  const auto number = [&] { return static_cast<std::int32_t>(end - scratch.chosen.data()); };
  HistoryCursor& known = scratch.known;
  known.begin(*this);
  for (const LawRange& range : outer.ranges()) {
    known.turn_to(range);
    Choice* const touching = scratch.touching.data();
    Choice* touching_end = touching;
    Choice* approaches = scratch.apart.data();
    const auto first = static_cast<std::size_t>(range.begin);
    const auto last = static_cast<std::size_t>(range.end);
    std::size_t looked_at = last - first;
    if (is_marked_only) looked_at = find_marked(approach, first, last, scratch.marked.data());
    for (std::size_t k = 0; k < looked_at; ++k) {
      const std::int32_t entry =
          is_marked_only ? scratch.marked[k] : static_cast<std::int32_t>(first + k);
      const auto q = static_cast<std::size_t>(entry);
      const std::int32_t contact = known.find(a[q], b[q]);
      *touching_end = *approaches = {entry, contact};
      touching_end += contact >= 0 ? 1 : 0;
      approaches += (contact < 0) & (approach[q] != 0) ? 1 : 0;
      if ((contact < 0) & (approach[q] > contact::k_may_meet)) [[unlikely]] {
        scratch.unseen.push_back(entry);
      }
    }
    LawRange part{range.law, range.surface, number(), 0, 0};
    const std::ptrdiff_t persistent =
        partners_ == PartnerKind::particles ? (touching_end - touching) / 8 * 8 : 0;
    end = std::copy_n(touching, persistent, end);
    part.persistent_end = number();
    end = std::merge(touching + persistent, touching_end, scratch.apart.data(), approaches, end,
                     [](const Choice& x, const Choice& y) { return x.entry < y.entry; });
    part.end = number();
    if (part.end > part.begin) scratch.ranges.push_back(part);
  }
  scratch.chosen_count = static_cast<std::size_t>(number());
  return known.is_all_found();
}

/// Chooses first and copies then. What is in touch is near, and so has a mark; a law that holds on
/// farther than that (a bridge that is stretched) has every entry looked at.
std::span<const std::int32_t> ContactList::prune(const PairList& outer,
                                                 std::span<const std::uint8_t> approach) {
  thread_local Scratch scratch;
  if (!choose(outer, approach, Look::at_marked, scratch)) {
    choose(outer, approach, Look::at_all, scratch);
  }
  const std::int32_t* const a = outer.a().data();
  const std::int32_t* const b = outer.b().data();
  const std::size_t count = scratch.chosen_count;
  scratch.make_room(count, stride_);
  alignas(32) static constexpr double k_new[contact::k_max_history] = {};
  const double* const history = history_.data();
  double* to = scratch.history.data();
  for (std::size_t k = 0; k < count; ++k, to += stride_) {
    const auto [q, contact] = scratch.chosen[k];
    scratch.a[k] = a[static_cast<std::size_t>(q)];
    scratch.b[k] = b[static_cast<std::size_t>(q)];
    scratch.is_touching[k] = contact < 0 ? 0 : is_touching_[static_cast<std::size_t>(contact)];
    const double* from =
        contact < 0 ? k_new : history + static_cast<std::size_t>(contact) * stride_;
    for (std::size_t h = 0; h < stride_; h += 4) std::memcpy(to + h, from + h, 4 * sizeof(double));
  }
  take(scratch, count);
  return scratch.unseen;
}

void ContactList::take(const Scratch& scratch, std::size_t count) {
  take_exactly(a_, scratch.a, count);
  take_exactly(b_, scratch.b, count);
  take_exactly(is_touching_, scratch.is_touching, count);
  take_exactly(history_, scratch.history, count * stride_);
  ranges_ = scratch.ranges;
}

void ContactList::histories_to_columns() {
  if (is_in_columns_) return;
  is_in_columns_ = true;
  each_block(ranges_, [&](std::size_t first, std::size_t count) {
    contact::rows_to_columns(history_.data() + first * stride_, count, stride_);
  });
}

void ContactList::histories_to_rows() {
  if (!is_in_columns_) return;
  is_in_columns_ = false;
  each_block(ranges_, [&](std::size_t first, std::size_t count) {
    contact::columns_to_rows(history_.data() + first * stride_, count, stride_);
  });
}

void ContactList::renumber(std::span<const std::int32_t> new_row) {
  const auto row_of = [&](std::int32_t row) { return new_row[static_cast<std::size_t>(row)]; };
  for (std::size_t q = 0; q < size(); ++q) {
    a_[q] = row_of(a_[q]);
    const bool is_particle =
        partners_ == PartnerKind::particles || (partners_ == PartnerKind::both && b_[q] >= 0);
    const std::int32_t b = is_particle ? row_of(b_[q]) : 0;
    if (a_[q] < 0 || b < 0) {
      is_touching_[q] = 0;
      a_[q] = b_[q] = 0;
    } else if (is_particle) {
      b_[q] = b;
    }
  }
}

}  // namespace dust::particles
