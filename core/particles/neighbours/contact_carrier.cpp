// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/contact_carrier.hpp"

namespace dust::particles {

namespace {

/// The second side of an entry: a particle, or -1 - surface.
std::int32_t partner_of(const auto& list, std::size_t entry) {
  const std::int32_t b = list.b()[entry];
  return list.partners() == PartnerKind::surfaces ? -1 - b : b;
}

}  // namespace

/// Calls `visit`(row, partner, history, touching) for each contact in touch.
template <class Visit>
void ContactCarrier::each(Visit&& visit) const {
  for (const ContactList& list : old_) {
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.touching()[q] == 0) continue;
      visit(static_cast<std::size_t>(list.a()[q]), partner_of(list, q), list.history(q),
            list.touching()[q]);
    }
  }
}

void ContactCarrier::arrange() {
  begin_.assign(rows_ + 1, 0);
  each([&](std::size_t a, std::int32_t, const double*, std::uint8_t) { ++begin_[a + 1]; });
  for (std::size_t n = 0; n < rows_; ++n) begin_[n + 1] += begin_[n];
  partner_.resize(static_cast<std::size_t>(begin_.back()));
  history_.resize(partner_.size());
  touching_.resize(partner_.size());
  std::vector<std::int32_t> fill(begin_.begin(), begin_.end() - 1);
  each([&](std::size_t a, std::int32_t b, const double* history, std::uint8_t touching) {
    const auto to = static_cast<std::size_t>(fill[a]++);
    partner_[to] = b;
    history_[to] = history;
    touching_[to] = touching;
  });
}

void ContactCarrier::adopt(const PairList& list, ContactList& contacts) const {
  contacts.clear();
  if (partner_.empty()) return;
  const auto old_row = [&](std::int32_t row) {
    return old_row_.empty() ? row : old_row_[static_cast<std::size_t>(row)];
  };
  for (std::size_t q = 0; q < list.size(); ++q) {
    const auto a = static_cast<std::size_t>(old_row(list.a()[q]));
    std::int32_t b = partner_of(list, q);
    if (b >= 0) b = old_row(b);
    if (a >= rows_) continue;  // it has just come
    for (auto m = static_cast<std::size_t>(begin_[a]); m < static_cast<std::size_t>(begin_[a + 1]);
         ++m) {
      if (partner_[m] != b) continue;
      contacts.push(list.a()[q], list.b()[q], history_[m], touching_[m]);
      break;
    }
  }
}

}  // namespace dust::particles
