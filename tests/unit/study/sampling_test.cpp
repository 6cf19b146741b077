// SPDX-License-Identifier: Apache-2.0
#include "study/sampling.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace dust::study;

namespace {

/// Every interval of 1/count holds exactly one point, in every direction.
bool is_latin(const Sample& sample) {
  const std::size_t count = sample.size();
  for (std::size_t d = 0; d < sample.front().size(); ++d) {
    std::set<std::size_t> cells;
    for (const auto& point : sample) {
      cells.insert(static_cast<std::size_t>(point[d] * static_cast<double>(count)));
    }
    if (cells.size() != count) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a latin hypercube shall hold one point in every interval of every direction") {
  for (const std::size_t count : {1u, 7u, 32u}) {
    const Sample sample = latin_hypercube(count, 4, 3);
    REQUIRE(sample.size() == count);
    CHECK(is_latin(sample));
  }
  CHECK(latin_hypercube(9, 2, 1) == latin_hypercube(9, 2, 1));
  CHECK(latin_hypercube(9, 2, 1) != latin_hypercube(9, 2, 2));
}

TEST_CASE("powers of two Sobol points shall be latin in every direction, whatever the shift") {
  for (const std::uint64_t seed : {0u, 1u, 99u}) {
    for (const std::size_t count : {2u, 16u, 256u}) {
      CHECK(is_latin(sobol(count, k_max_sobol_dimensions, seed)));
    }
  }
}

TEST_CASE("the first two Sobol directions shall fill every elementary box of their plane") {
  // A (0, 2)-sequence: 64 points, one in each of the boxes of 2^-a by 2^-(6 - a).
  const Sample sample = sobol(64, 2, 5);
  for (int a = 0; a <= 6; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (const auto& point : sample) {
      boxes.insert(
          {static_cast<int>(point[0] * (1 << a)), static_cast<int>(point[1] * (1 << (6 - a)))});
    }
    CHECK(boxes.size() == 64);
  }
}

TEST_CASE("a longer Sobol sample shall begin with the shorter one") {
  const Sample few = sobol(10, 3, 1);
  const Sample many = sobol(25, 3, 1);
  CHECK(std::equal(few.begin(), few.end(), many.begin()));
}
