// SPDX-License-Identifier: Apache-2.0
#include "base/periodic.hpp"

#include "base/lanes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace dust::base;

TEST_CASE(
    "the nearest image shall lie within half a period, on the side it came from at the half") {
  CHECK(nearest_image(0.4, 1.0) == 0.4);
  CHECK(nearest_image(0.5, 1.0) == 0.5);
  CHECK(nearest_image(-0.5, 1.0) == -0.5);
  CHECK(nearest_image(0.75, 1.0) == -0.25);
  CHECK(nearest_image(-0.75, 1.0) == 0.25);
  CHECK(nearest_image_of_any(7.75, 1.0) == -0.25);
  CHECK(nearest_image_of_any(-3.25, 1.0) == -0.25);
}

TEST_CASE("a direction without a period shall move nothing") {
  CHECK(nearest_image(3.0, 0.0) == 3.0);
  CHECK(nearest_image(-3.0, 0.0) == -3.0);
  CHECK(nearest_image(1e9, 0.0, std::numeric_limits<double>::infinity()) == 1e9);
}

TEST_CASE("one number, four lanes and any distance shall agree") {
  const double length = 0.013;
  const dust::lanes::Lanes lengths{length, length, length, 0.0};
  const dust::lanes::Lanes halves{0.5 * length, 0.5 * length, 0.5 * length, HUGE_VAL};
  for (int n = -97; n <= 97; ++n) {
    const double apart = 0.0101 * length * n;  // within a period, never at the half
    dust::lanes::Lanes four{apart, -apart, 0.5 * apart, apart};
    dust::lanes::fold(four, lengths, halves);
    CHECK(four[0] == nearest_image(apart, length));
    CHECK(four[1] == nearest_image(-apart, length));
    CHECK(four[2] == nearest_image(0.5 * apart, length));
    CHECK(four[3] == apart);
    CHECK(nearest_image_of_any(apart, length) == nearest_image(apart, length));
  }
}
