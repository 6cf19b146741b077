// SPDX-License-Identifier: Apache-2.0
#include "contact/approach.hpp"
#include "contact/standing.hpp"
#include "particles/impl.hpp"

#include <algorithm>
#include <cstring>

/// Which entries of a list a watch looks at, and how their histories stand meanwhile.
namespace dust::particles {
namespace {

/// Entries [next, end) of a contact list.
struct Run {
  std::size_t next = 0;
  std::size_t end = 0;
};

/// The contacts of a list in the order of the outer list: of each segment two runs are.
class Known {
 public:
  explicit Known(const ContactList& contacts)
      : contacts_(contacts), rest_{0, contacts.segments.empty() ? contacts.size() : 0} {}

  /// To the contacts of another segment of the list. After a rebuild there is one run of all.
  void turn_to(const Segment& s) {
    if (contacts_.segments.empty()) return;
    standing_ = rest_ = {};
    for (const Segment& k : contacts_.segments) {
      if (k.law != s.law || k.surface != s.surface) continue;
      standing_ = {static_cast<std::size_t>(k.begin), static_cast<std::size_t>(k.standing)};
      rest_ = {static_cast<std::size_t>(k.standing), static_cast<std::size_t>(k.end)};
      return;
    }
  }
  /// The contact of the next entry of the segment, in touch, or -1.
  [[nodiscard]] std::int32_t find(std::int32_t a, std::int32_t b) {
    return std::max(find_in(standing_, a, b), find_in(rest_, a, b));
  }

 private:
  std::int32_t find_in(Run& run, std::int32_t a, std::int32_t b) const {
    if (run.next >= run.end) return -1;
    const std::size_t u = run.next;
    const bool is_it = (contacts_.a[u] == a) & (contacts_.b[u] == b);
    run.next += is_it ? 1 : 0;
    return is_it & (contacts_.is_touching[u] != 0) ? static_cast<std::int32_t>(u) : -1;
  }
  const ContactList& contacts_;
  Run standing_, rest_;
};

/// Visits the blocks of a list whose histories stand in columns: where one begins, how many rows.
template <class Visit>
void each_block(const ContactList& contacts, Visit&& visit) {
  for (const Segment& s : contacts.segments) {
    for (std::int32_t p = s.begin; p < s.standing;) {
      const std::int32_t count =
          std::min(s.standing - p, static_cast<std::int32_t>(contact::k_batch));
      visit(static_cast<std::size_t>(p), static_cast<std::size_t>(count));
      p += count;
    }
  }
}

}  // namespace

/// The contact list made new: who touches, with the history, and who may come to touch: `meets`,
/// one contact::Approach per entry of the list. Without branches on either, which nobody foretells.
/// Returns how many have overlapped for some steps, though no contact of theirs is known: the watch
/// before did not look at them.
std::int64_t Dem::Impl::choose_contacts(const OuterList& list, ContactList& contacts,
                                        const std::vector<std::uint8_t>& meets,
                                        bool may_stand) const {
  struct Choice {
    std::int32_t entry;    ///< of the list
    std::int32_t contact;  ///< before, or -1
  };
  thread_local std::vector<Choice> touching;
  thread_local std::vector<Choice> apart;
  thread_local std::vector<Choice> chosen;
  thread_local ContactList next;
  for (auto* v : {&touching, &apart, &chosen}) {
    if (v->size() <= list.size()) v->resize(list.size() + 1);
  }
  next.segments.clear();
  Choice* end = chosen.data();
  std::int64_t seen_late = 0;
  const auto number = [&] { return static_cast<std::int32_t>(end - chosen.data()); };
  Known known(contacts);
  for (const Segment& s : list.segments) {
    known.turn_to(s);
    Choice* touches = touching.data();
    Choice* approaches = apart.data();
    for (auto q = static_cast<std::size_t>(s.begin); q < static_cast<std::size_t>(s.end); ++q) {
      const std::int32_t contact = known.find(list.a[q], list.b[q]);
      *touches = *approaches = {static_cast<std::int32_t>(q), contact};
      touches += contact >= 0 ? 1 : 0;
      approaches += (contact < 0) & (meets[q] != 0) ? 1 : 0;
      if ((contact < 0) & (meets[q] > contact::k_may_meet)) [[unlikely]]
        seen_late += has_made_steps(list.a[q]) && has_made_steps(list.b[q]) ? 1 : 0;
    }
    Segment part{s.law, s.surface, number(), 0, 0};
    const std::ptrdiff_t stand = may_stand ? (touches - touching.data()) / 8 * 8 : 0;
    end = std::copy_n(touching.data(), stand, end);
    part.standing = number();
    end = std::merge(touching.data() + stand, touches, apart.data(), approaches, end,
                     [](const Choice& a, const Choice& b) { return a.entry < b.entry; });
    part.end = number();
    if (part.end > part.begin) next.segments.push_back(part);
  }
  const auto count = static_cast<std::size_t>(number());
  next.make_room(count, history_stride);
  alignas(32) static constexpr double k_new[contact::k_max_history] = {};
  const double* const history = contacts.history.data();
  const std::size_t stride = history_stride;
  double* to = next.history.data();
  for (std::size_t k = 0; k < count; ++k, to += stride) {
    const auto [q, contact] = chosen[k];
    next.a[k] = list.a[static_cast<std::size_t>(q)];
    next.b[k] = list.b[static_cast<std::size_t>(q)];
    next.is_touching[k] = contact < 0 ? 0 : contacts.is_touching[static_cast<std::size_t>(contact)];
    const double* from = contact < 0 ? k_new : history + static_cast<std::size_t>(contact) * stride;
    for (std::size_t h = 0; h < stride; h += 4) std::memcpy(to + h, from + h, 4 * sizeof(double));
  }
  contacts.take_exactly(next, count, history_stride);
  return seen_late;
}

/// The histories of the standing contacts into columns, block by block, where they are.
void Dem::Impl::stand(ContactList& contacts) const {
  if (contacts.is_standing) return;
  contacts.is_standing = true;
  each_block(contacts, [&](std::size_t first, std::size_t count) {
    contact::rows_to_columns(contacts.history.data() + first * history_stride, count,
                             history_stride);
  });
}

/// And back into rows, as everybody else knows them.
void Dem::Impl::fall_in(ContactList& contacts) const {
  if (!contacts.is_standing) return;
  contacts.is_standing = false;
  each_block(contacts, [&](std::size_t first, std::size_t count) {
    contact::columns_to_rows(contacts.history.data() + first * history_stride, count,
                             history_stride);
  });
}

}  // namespace dust::particles
