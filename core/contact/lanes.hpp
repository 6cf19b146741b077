// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::contact {

/// Four doubles; the compiler lowers it to whatever the target has.
typedef double Lanes __attribute__((vector_size(32), may_alias));
typedef long long LaneMask __attribute__((vector_size(32)));

/// Rows of four become columns of four, and back.
__attribute__((always_inline)) inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_even = __builtin_shuffle(a, b, LaneMask{0, 4, 2, 6});
  const Lanes ab_odd = __builtin_shuffle(a, b, LaneMask{1, 5, 3, 7});
  const Lanes cd_even = __builtin_shuffle(c, d, LaneMask{0, 4, 2, 6});
  const Lanes cd_odd = __builtin_shuffle(c, d, LaneMask{1, 5, 3, 7});
  a = __builtin_shuffle(ab_even, cd_even, LaneMask{0, 1, 4, 5});
  b = __builtin_shuffle(ab_odd, cd_odd, LaneMask{0, 1, 4, 5});
  c = __builtin_shuffle(ab_even, cd_even, LaneMask{2, 3, 6, 7});
  d = __builtin_shuffle(ab_odd, cd_odd, LaneMask{2, 3, 6, 7});
}

}  // namespace dust::contact
