// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace dust::lanes {

/// Four doubles; the compiler lowers it to whatever the target has.
typedef double Lanes __attribute__((vector_size(32), may_alias));
/// The same where they need not stand at a multiple of 32 bytes. Not memcpy: GCC 12 copies it in
/// two halves by way of the stack, and reading them together again waits for both to be written.
typedef double LooseLanes __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long LaneMask __attribute__((vector_size(32)));

/// Rows of four become columns of four, and back.
__attribute__((always_inline)) inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

/// The lanes of `v` in the order of their numbers in `order`.
__attribute__((always_inline)) inline void permute(const Lanes& v, const LaneMask& order,
                                                   Lanes& result) {
#ifdef __clang__  // which has no shuffle by a mask that is known at run time only
  const Lanes from = v;
  for (int l = 0; l < 4; ++l) result[l] = from[order[l]];
#else
  result = __builtin_shuffle(v, order);
#endif
}

/// Row n of rows of four.
__attribute__((always_inline)) inline const Lanes& row(const double* rows, std::int32_t n) {
  return *reinterpret_cast<const Lanes*>(rows + 4 * static_cast<std::ptrdiff_t>(n));
}
/// The nearest image along periodic directions.
__attribute__((always_inline)) inline void fold(Lanes& d, const Lanes& length, const Lanes& half) {
  const LaneMask above = d > half;
  const LaneMask below = d < -half;
  d = above ? d - length : (below ? d + length : d);
}

__attribute__((always_inline)) inline void load(const double* column, Lanes& v) {
  v = *reinterpret_cast<const LooseLanes*>(column);
}
__attribute__((always_inline)) inline void store(double* column, const Lanes& v) {
  *reinterpret_cast<LooseLanes*>(column) = v;
}

/// Four rows as columns.
__attribute__((always_inline)) inline void columns_of(const double* r0, const double* r1,
                                                      const double* r2, const double* r3,
                                                      Lanes* column) {
  load(r0, column[0]), load(r1, column[1]), load(r2, column[2]), load(r3, column[3]);
  transpose(column[0], column[1], column[2], column[3]);
}

}  // namespace dust::lanes
