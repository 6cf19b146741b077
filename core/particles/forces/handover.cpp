// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/handover.hpp"

#include <algorithm>

namespace dust::particles {

bool may_hand_over(const Surface& from, const Surface& to) {
  if (from.abutting == nullptr || from.material != to.material) return false;
  return std::any_of(from.abutting->begin(), from.abutting->end(),
                     [&](const AbuttingBody& other) { return other.body == to.body; });
}

void hand_over(const contact::PairView& list, std::size_t from, std::size_t to) {
  double* const history = list.history + from * list.history_stride;
  std::copy_n(history, list.history_stride, list.history + to * list.history_stride);
  std::fill_n(history, list.history_stride, 0.0);
  list.is_touching[to] = list.is_touching[from];
  list.is_touching[from] = 0;
}

}  // namespace dust::particles
