// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

namespace dust::test {

/// `x == approx(y).epsilon(e)`: |x - y| < e max(|x|, |y|), whatever the units are. doctest::Approx
/// adds 1 to the larger one, so that it finds all small numbers alike: micrometres in m, or grams
/// of dust in kg. Where 0 is expected, `scale(s)` says what is large: |x - y| < e (s + ...).
inline doctest::Approx approx(double expected) {
  constexpr double k_next_to_nothing = 1e-300;  // 0 is alike 0
  return doctest::Approx(expected).scale(k_next_to_nothing);
}

}  // namespace dust::test
