// SPDX-License-Identifier: Apache-2.0
#include "study/sampling.hpp"

#include "dust/sdk/random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <stdexcept>

namespace dust::study {
namespace {

constexpr std::size_t k_bits = 32;

/// A primitive polynomial and the first direction numbers of one direction, as Joe and Kuo list
/// them: degree, coefficients, m_1, m_2, ...
struct Direction {
  std::size_t degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 5> first;
};
constexpr std::array<Direction, k_max_sobol_dimensions - 1> k_directions = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
}};

std::array<std::uint32_t, k_bits> direction_numbers(std::size_t dimension) {
  std::array<std::uint32_t, k_bits> v{};
  if (dimension == 0) {
    for (std::size_t k = 0; k < k_bits; ++k) v[k] = 1u << (k_bits - 1 - k);
    return v;
  }
  const Direction& d = k_directions[dimension - 1];
  for (std::size_t k = 0; k < k_bits; ++k) {
    if (k < d.degree) {
      v[k] = d.first[k] << (k_bits - 1 - k);
      continue;
    }
    v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
    for (std::size_t j = 1; j < d.degree; ++j) {
      if ((d.coefficients >> (d.degree - 1 - j) & 1u) != 0) v[k] ^= v[k - j];
    }
  }
  return v;
}

}  // namespace

Sample latin_hypercube(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
  const sdk::Random random(seed, sdk::stream_of("latin_hypercube"));
  Sample sample(count, std::vector<double>(dimensions));
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto step = static_cast<std::uint32_t>(d);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return random.uniform(a, step, 0) < random.uniform(b, step, 0);
    });
    for (std::size_t n = 0; n < count; ++n) {
      sample[n][d] =
          (static_cast<double>(order[n]) + random.uniform(n, step, 1)) / static_cast<double>(count);
    }
  }
  return sample;
}

Sample sobol(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
  if (dimensions > k_max_sobol_dimensions) throw std::logic_error("too many Sobol directions");
  const sdk::Random random(seed, sdk::stream_of("sobol"));
  Sample sample(count, std::vector<double>(dimensions));
  for (std::size_t d = 0; d < dimensions; ++d) {
    const auto v = direction_numbers(d);
    auto x = static_cast<std::uint32_t>(random.uniform(d, 0) * 0x1.0p32);
    for (std::size_t n = 0; n < count; ++n) {
      sample[n][d] = static_cast<double>(x) * 0x1.0p-32;
      // Gray code: point n + 1 differs in the direction of the lowest zero bit of n.
      x ^= v[static_cast<std::size_t>(std::countr_one(n))];
    }
  }
  return sample;
}

}  // namespace dust::study
