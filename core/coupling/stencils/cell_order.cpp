// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/cell_order.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace dust::coupling {
namespace {

constexpr int k_row_bits = 32;
constexpr int k_max_digit_bits = 11;  // a table of counts that stays in the innermost cache

/// Number of half cells along an axis, and which one a point lies in; points beyond the sides are
/// wrapped or counted to the last one.
struct Halves {
  double origin, per_length;
  double count;
  bool is_periodic;
};
std::uint64_t half_of(const Halves& h, double x) {
  double s = (x - h.origin) * h.per_length;
  if (h.is_periodic) s -= h.count * std::floor(s / h.count);
  return static_cast<std::uint64_t>(std::clamp(s, 0.0, h.count - 1.0));
}

}  // namespace

void CellOrder::sort(const fluid::Grid& grid, const double* position, std::size_t count) {
  std::array<Halves, 3> halves;
  std::uint64_t eighths = 1;
  for (int d = 0; d < 3; ++d) {
    halves[static_cast<std::size_t>(d)] = {grid.origin[d], 2.0 / grid.spacing[d],
                                           2.0 * grid.count[d], grid.is_periodic[d]};
    eighths *= 2 * static_cast<std::uint64_t>(grid.count[d]);
  }
  items_.resize(count);
  other_.resize(count);
  rows_.resize(count);
  const auto per_row = 2 * static_cast<std::uint64_t>(grid.count[0]);
  const auto per_layer = per_row * 2 * static_cast<std::uint64_t>(grid.count[1]);
  constexpr std::size_t k_block = 4096;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, k_block), [&](const auto& range) {
    for (std::size_t row = range.begin(); row < range.end(); ++row) {
      const double* x = position + 4 * row;
      const std::uint64_t eighth = half_of(halves[0], x[0]) + per_row * half_of(halves[1], x[1]) +
                                   per_layer * half_of(halves[2], x[2]);
      items_[row] = eighth << k_row_bits | row;
    }
  });
  // Digit by digit from the lowest: every pass keeps the order of the one before.
  const int bits = std::bit_width(eighths - 1);
  const int passes = (bits + k_max_digit_bits - 1) / k_max_digit_bits;
  for (int pass = 0; pass < passes; ++pass) {
    const int low = k_row_bits + pass * bits / passes;
    const int width = k_row_bits + (pass + 1) * bits / passes - low;
    const auto digit = [&](std::uint64_t item) {
      return static_cast<std::size_t>(item >> low & ((1u << width) - 1u));
    };
    std::array<std::uint32_t, (1u << k_max_digit_bits) + 1> next{};
    for (const std::uint64_t item : items_) ++next[digit(item) + 1];
    for (std::size_t n = 1; n < next.size(); ++n) next[n] += next[n - 1];
    for (const std::uint64_t item : items_) other_[next[digit(item)]++] = item;
    items_.swap(other_);
  }
  for (std::size_t n = 0; n < count; ++n) rows_[n] = static_cast<std::int32_t>(items_[n]);
}

}  // namespace dust::coupling
