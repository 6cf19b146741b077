// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/contact_carrier.hpp"

namespace dust::particles {

void ContactCarrier::take(ContactList&& list, bool has_surfaces) {
  old_.push_back({std::move(list), has_surfaces});
}

/// Calls `visit`(row, partner, history, touching) for each contact in touch.
template <class Visit>
void ContactCarrier::each(Visit&& visit) const {
  for (const auto& [list, has_surfaces] : old_) {
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.is_touching[q] == 0) continue;
      visit(static_cast<std::size_t>(list.a[q]), has_surfaces ? -1 - list.b[q] : list.b[q],
            list.history.data() + q * stride_, list.is_touching[q]);
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

void ContactCarrier::adopt(const OuterList& list, bool has_surfaces, ContactList& contacts) const {
  contacts.clear();
  if (partner_.empty()) return;
  const auto old_row = [&](std::int32_t row) {
    return old_row_.empty() ? row : old_row_[static_cast<std::size_t>(row)];
  };
  for (std::size_t q = 0; q < list.size(); ++q) {
    const auto a = static_cast<std::size_t>(old_row(list.a[q]));
    std::int32_t b = has_surfaces ? -1 - list.b[q] : list.b[q];
    if (b >= 0) b = old_row(b);
    if (a >= rows_) continue;  // it has just come
    for (auto m = static_cast<std::size_t>(begin_[a]); m < static_cast<std::size_t>(begin_[a + 1]);
         ++m) {
      if (partner_[m] != b) continue;
      contacts.push(list.a[q], list.b[q], history_[m], stride_);
      contacts.is_touching.back() = touching_[m];
      break;
    }
  }
}

}  // namespace dust::particles
