// SPDX-License-Identifier: Apache-2.0
#include "base/finite.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

using dust::base::first_not_finite;
using dust::base::is_finite;

namespace {
constexpr double k_infinite = std::numeric_limits<double>::infinity();
constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
constexpr double k_largest = std::numeric_limits<double>::max();
}  // namespace

TEST_CASE("the first number of a column that is none shall be found wherever it stands") {
  std::vector<double> column(37, 1.0);
  column[3] = k_largest;
  column[5] = -k_largest;
  column[6] = std::numeric_limits<double>::denorm_min();
  CHECK(first_not_finite(column.data(), column.size()) == column.size());
  for (const double bad : {k_infinite, -k_infinite, k_none}) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{17}, std::size_t{36}}) {
      std::vector<double> with = column;
      with[at] = bad;
      CHECK(first_not_finite(with.data(), with.size()) == at);
    }
  }
  CHECK(first_not_finite(nullptr, 0) == 0);
}

TEST_CASE("a vector shall be finite when its components are, however large their sum") {
  CHECK(is_finite({k_largest, k_largest, k_largest}));
  CHECK_FALSE(is_finite({0.0, k_none, 0.0}));
  CHECK_FALSE(is_finite({k_infinite, -k_infinite, 0.0}));
}
