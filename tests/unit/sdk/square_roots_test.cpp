// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/square_roots.hpp"

#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

constexpr std::size_t k_count = 64;

/// How many of the roots have other bits than those of std::sqrt.
int wrong_roots(const std::array<double, k_count>& of) {
  alignas(64) double x[k_count];
  std::copy(of.begin(), of.end(), x);
  dust::sdk::take_square_roots(x, k_count);
  int wrong = 0;
  for (std::size_t q = 0; q < k_count; ++q) {
    const bool is_alike =
        std::bit_cast<std::uint64_t>(x[q]) == std::bit_cast<std::uint64_t>(std::sqrt(of[q]));
    wrong += is_alike || (std::isnan(x[q]) && std::isnan(std::sqrt(of[q]))) ? 0 : 1;
  }
  return wrong;
}

}  // namespace

TEST_CASE("square roots of any size shall have the bits of std::sqrt") {
  const dust::sdk::Random random(7, 1);
  int wrong = 0;
  for (std::uint64_t n = 0; n < 40000; ++n) {
    std::array<double, k_count> x;
    for (std::size_t q = 0; q < k_count; ++q) {
      // From the last normal numbers to the largest: beyond the range that is iterated on both
      // sides.
      const double exponent =
          -1022.0 + 2045.0 * random.uniform(n, 0, static_cast<std::uint32_t>(q));
      x[q] = std::ldexp(1.0 + random.uniform(n, 1, static_cast<std::uint32_t>(q)),
                        static_cast<int>(exponent));
    }
    wrong += wrong_roots(x);
  }
  CHECK(wrong == 0);
}

TEST_CASE(
    "square roots next to squares, where rounding is hardest, shall have the bits of std::sqrt") {
  const dust::sdk::Random random(7, 2);
  int wrong = 0;
  for (std::uint64_t n = 0; n < 40000; ++n) {
    std::array<double, k_count> x;
    for (std::size_t q = 0; q < k_count; q += 4) {
      const double root = 1.0 + random.uniform(n, 0, static_cast<std::uint32_t>(q));
      const double square = root * root;
      x[q] = square;
      x[q + 1] = std::nextafter(square, 0.0);
      x[q + 2] = std::nextafter(square, 10.0);
      // Halfway between two roots as near as it comes.
      x[q + 3] = root * std::nextafter(root, 10.0);
    }
    wrong += wrong_roots(x);
  }
  CHECK(wrong == 0);
}

TEST_CASE(
    "zero, infinity and what has no root shall be as std::sqrt has them, alone and among others") {
  constexpr double k_infinity = std::numeric_limits<double>::infinity();
  for (const double odd : {0.0, -0.0, std::numeric_limits<double>::denorm_min(), 1e-310,
                           std::numeric_limits<double>::max(), k_infinity, -1.0, -k_infinity,
                           std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(odd);
    std::array<double, k_count> x;
    x.fill(odd);
    CHECK(wrong_roots(x) == 0);
    for (std::size_t q = 0; q < k_count; ++q)
      x[q] = q % 5 == 2 ? odd : 0.3 * static_cast<double>(q);
    CHECK(wrong_roots(x) == 0);
  }
}
