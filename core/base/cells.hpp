// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

/// Cells of a grid without bounds, for tables that hold only those with something in them.
namespace dust::base {

/// Index of a cell along one axis: `position` in edges of a cell from where the grid begins.
inline std::int64_t cell_index(double position) {
  return static_cast<std::int64_t>(std::floor(position));
}

/// The same cell of a periodic axis of `count` cells, 0 to count - 1; `count` 0 is an axis without
/// a period.
constexpr std::int64_t wrapped_cell(std::int64_t index, std::int64_t count) {
  if (count == 0) return index;
  const std::int64_t rest = index % count;
  return rest < 0 ? rest + count : rest;
}

inline constexpr int k_cell_bits = 21;

/// One number for a cell. Cells whose indices differ by multiples of 2^21 (2 million cells) share
/// it: whoever looks into a cell compares distances. Never all ones, which may stand for no cell.
constexpr std::uint64_t cell_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  constexpr std::uint64_t mask = (std::uint64_t{1} << k_cell_bits) - 1;
  return (static_cast<std::uint64_t>(k) & mask) << (2 * k_cell_bits) |
         (static_cast<std::uint64_t>(j) & mask) << k_cell_bits |
         (static_cast<std::uint64_t>(i) & mask);
}

/// Spreads keys over 64 bits; a table of 2^b slots takes the uppermost b. Source: multiplication by
/// the golden ratio, Knuth, The Art of Computer Programming 3 (1998), section 6.4.
constexpr std::uint64_t spread_key(std::uint64_t key) { return key * 0x9E3779B97F4A7C15ull; }

}  // namespace dust::base
