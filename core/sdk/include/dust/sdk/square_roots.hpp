// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/kernel.hpp"

#include <cmath>
#include <cstddef>
#if DUST_HAS_CLONES
#include <immintrin.h>
#endif

namespace dust::sdk {

/// Square roots in place of `count` numbers, a multiple of eight, 64-byte aligned: the same bits as
/// std::sqrt on every processor.
///
/// The instruction for eight roots keeps the divider busy for some twenty cycles. Where a processor
/// has 512-bit registers they are iterated from its 14-bit estimate of 1/sqrt(x) instead, next to
/// whatever else is being divided. A kernel gains if it stops for them: one loop up to the
/// radicands, this, one loop from the roots on. Within one loop the chain of what waits for each
/// other would be longer than what the processor looks ahead.
#if DUST_HAS_CLONES
__attribute__((target("default"))) inline void take_square_roots(double* x, std::size_t count) {
  for (std::size_t q = 0; q < count; ++q) x[q] = std::sqrt(x[q]);
}
__attribute__((target("arch=x86-64-v3"))) inline void take_square_roots(double* x,
                                                                        std::size_t count) {
  for (std::size_t q = 0; q < count; q += 4) {
    _mm256_store_pd(x + q, _mm256_sqrt_pd(_mm256_load_pd(x + q)));
  }
}
/// g -> sqrt(x), h -> 1 / (2 sqrt(x)) (Goldschmidt); two corrections with the exact residual x - g
/// g round as the instruction does (Markstein, IBM J. Res. Dev. 34 (1990) 111,
/// doi:10.1147/rd.341.0111).
__attribute__((target("arch=x86-64-v4"))) inline void take_square_roots(double* x,
                                                                        std::size_t count) {
  // Between them neither the residual nor the estimate leaves the normal numbers.
  const __m512i least = _mm512_castpd_si512(_mm512_set1_pd(0x1p-900));
  const __m512i width = _mm512_sub_epi64(_mm512_castpd_si512(_mm512_set1_pd(0x1p900)), least);
  const __m512d half = _mm512_set1_pd(0.5);
  for (std::size_t q = 0; q < count; q += 8) {
    const __m512d v = _mm512_load_pd(x + q);
    const __m512i bits = _mm512_castpd_si512(v);
    const __mmask8 usual = _mm512_cmple_epu64_mask(_mm512_sub_epi64(bits, least), width);
    if (_mm512_mask_test_epi64_mask(static_cast<__mmask8>(~usual), bits, bits) != 0) [[unlikely]] {
      _mm512_store_pd(x + q, _mm512_sqrt_pd(v));
      continue;
    }
    const __m512d y = _mm512_rsqrt14_pd(v);
    __m512d g = _mm512_mul_pd(v, y);
    __m512d h = _mm512_mul_pd(half, y);
    const __m512d r = _mm512_fnmadd_pd(g, h, half);
    g = _mm512_fmadd_pd(g, r, g);
    h = _mm512_fmadd_pd(h, r, h);
    g = _mm512_fmadd_pd(_mm512_fnmadd_pd(g, g, v), h, g);
    g = _mm512_fmadd_pd(_mm512_fnmadd_pd(g, g, v), h, g);
    _mm512_store_pd(x + q, _mm512_maskz_mov_pd(usual, g));  // what is left is zero
  }
}
#else
inline void take_square_roots(double* x, std::size_t count) {
#pragma omp simd
  for (std::size_t q = 0; q < count; ++q) x[q] = std::sqrt(x[q]);
}
#endif

}  // namespace dust::sdk
