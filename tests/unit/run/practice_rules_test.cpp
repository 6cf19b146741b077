// SPDX-License-Identifier: Apache-2.0
#include "run/summary/practice_rules.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

using dust::test::approx;
using namespace dust::run;

TEST_CASE("AP-42's drop equation shall give the guideline's own example") {
  // 3 m/s, 0.7 %: 3.6 g/t, to two digits, finer than 10 um, of which k is 0.35; here k is 0.74.
  CHECK(drop_emission(3.0, 0.007) == approx(3.6 * 0.74 / 0.35).epsilon(0.02));
  CHECK(drop_emission(2.2, 0.02) == approx(1.184).epsilon(1e-12));
}

TEST_CASE("a drop of another height shall give off by the power 1.25 of VDI 3790-3") {
  CHECK(drop_height_factor(2.0) == approx(1.0));
  // 2^1.25 = 2 * 2^0.25 = 2 * 1.189207.
  CHECK(drop_height_factor(4.0) == approx(2.378414).epsilon(1e-6));
  CHECK(drop_height_factor(1.0) == approx(0.420448).epsilon(1e-6));
}

TEST_CASE("Anderson's rule shall give the air of a chute worked out by hand") {
  // 100 short tons an hour of 1 inch falling 10 ft through 2 ft2:
  // 10 * 2 * (100 * 100 / (1/12))^(1/3) = 20 * 120000^(1/3) = 20 * 49.32424 = 986.4848 ft3/min.
  const double load = 100.0 * 907.18474 / 3600.0, foot = 0.3048;
  const double cubic_feet_per_minute = foot * foot * foot / 60.0;
  CHECK(induced_air(load, 10.0 * foot, foot / 12.0, 2.0 * foot * foot) ==
        approx(986.4848 * cubic_feet_per_minute).epsilon(1e-6));
  // Twice the load, and eight times finer: 2^(1/3), and twice.
  const double usual = induced_air(10.0, 2.0, 0.02, 0.09);
  CHECK(usual == approx(0.13551).epsilon(1e-4));
  CHECK(induced_air(20.0, 2.0, 0.02, 0.09) == approx(1.259921 * usual).epsilon(1e-6));
  CHECK(induced_air(10.0, 2.0, 0.0025, 0.09) == approx(2.0 * usual).epsilon(1e-9));
}
