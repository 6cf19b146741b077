// SPDX-License-Identifier: Apache-2.0
// Odar and Hamilton's coefficients: the printed ends, and what a motion of known A_c gives.
#include "fluid_force/acceleration_number.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using dust::test::approx;
using namespace dust::model;
using dust::sdk::Vec3;

TEST_CASE("Odar and Hamilton's coefficients shall go from Stokes's limit to their steady ends") {
  // C_A from 0.5 to 1.05, C_H from 6 to 2.88.
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(0.5 * virtual_mass_factor(0.0) == approx(0.5).epsilon(1e-12));
  CHECK(0.5 * virtual_mass_factor(infinite) == approx(1.05).epsilon(1e-12));
  CHECK(6.0 * history_factor(0.0) == approx(6.0).epsilon(1e-12));
  CHECK(6.0 * history_factor(infinite) == approx(2.88).epsilon(1e-12));
  // 1.05 - 0.066 / 1.12 and 2.88 + 3.12 / 8 at A_c = 1.
  CHECK(0.5 * virtual_mass_factor(1.0) == approx(0.99107143).epsilon(1e-8));
  CHECK(6.0 * history_factor(1.0) == approx(3.27).epsilon(1e-12));
}

TEST_CASE(
    "the acceleration number shall be that of the slip and its rate, whatever their directions") {
  CHECK(acceleration_number(2e-3, {0.3, 0, 0.4}, {0, 5.0, 0}) == approx(25.0).epsilon(1e-12));
  CHECK(acceleration_number(2e-3, {}, {1.0, 0, 0}) == 0.0);
  CHECK(std::isinf(acceleration_number(2e-3, {1.0, 0, 0}, {})));
}

TEST_CASE("a slip that grows evenly shall have the acceleration number a t^2 / D") {
  constexpr double k_rate = 3.0;
  constexpr double k_step = 1e-3;
  std::array<double, LastSlip::k_numbers> row{};
  for (int n = 0; n < 50; ++n) {
    // Steps of two lengths: the rate is that of the interval that has ended.
    const double time = k_step * (n + n / 2);
    const double interval = n % 2 == 0 ? k_step : 2.0 * k_step;
    const double got = LastSlip(row.data()).note(1e-3, {k_rate * time, 0, 0}, interval);
    CAPTURE(n);
    CHECK(got == approx(n == 0 ? 0.0 : k_rate * time * time / 1e-3).epsilon(1e-9));
  }
}

}  // namespace
