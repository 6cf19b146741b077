// SPDX-License-Identifier: Apache-2.0
#include "base/cells.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

using namespace dust::base;

TEST_CASE("cells below zero shall be cells of their own, and a period shall wrap them") {
  CHECK(cell_index(0.0) == 0);
  CHECK(cell_index(0.999) == 0);
  CHECK(cell_index(-1e-9) == -1);
  CHECK(wrapped_cell(-1, 5) == 4);
  CHECK(wrapped_cell(5, 5) == 0);
  CHECK(wrapped_cell(-11, 5) == 4);
  CHECK(wrapped_cell(-11, 0) == -11);
}

TEST_CASE("each cell shall have a key of its own, on both sides of zero, none of all ones") {
  std::set<std::uint64_t> keys;
  std::size_t cells = 0;
  const std::vector<std::int64_t> indices = {-1048576, -70000, -2, -1, 0, 1, 2, 70000, 1048575};
  for (const std::int64_t i : indices) {
    for (const std::int64_t j : indices) {
      for (const std::int64_t k : indices) {
        keys.insert(cell_key(i, j, k));
        ++cells;
      }
    }
  }
  CHECK(keys.size() == cells);
  CHECK(keys.count(~std::uint64_t{0}) == 0);
  CHECK(cell_key(1, 2, 3) == cell_key(1 + (std::int64_t{1} << k_cell_bits), 2, 3));
}

TEST_CASE("keys of a block of cells shall spread over a table: no slot takes more than a few") {
  constexpr int k_bits = 15;
  std::vector<int> taken(std::size_t{1} << k_bits, 0);
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      for (int k = 0; k < 16; ++k) ++taken[spread_key(cell_key(i, j, k)) >> (64 - k_bits)];
    }
  }
  int most = 0;
  for (const int n : taken) most = n > most ? n : most;
  // 4096 keys in 32768 slots; drawn at random the fullest slot has 3 to 5.
  CHECK(most <= 5);
}
