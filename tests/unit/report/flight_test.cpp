// SPDX-License-Identifier: Apache-2.0
#include "report/facts/flight.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using dust::report::isolated_flight;
using dust::report::IsolatedGrain;
using dust::report::StillAir;
using dust::test::approx;

namespace {
constexpr double k_gravity = 9.81;
constexpr StillAir k_air{1.2139, 1.8e-5};
constexpr std::array k_drops{0.02, 0.05, 0.1, 0.14};
}  // namespace

TEST_CASE("without air the flight shall be the parabola") {
  const auto x = isolated_flight({600e-6, 2650.0, 0.8}, {}, k_gravity, k_drops);
  REQUIRE(x.size() == k_drops.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    // Between steps of 1 ms the path is taken as straight: off by g step^2 / 8 v / v_z, below 5 um.
    CHECK(x[k] == approx(0.8 * std::sqrt(2.0 * k_drops[k] / k_gravity)).epsilon(1e-4));
  }
}

TEST_CASE("in still air lone grains shall fall as far as an independent solution says") {
  // Integrated elsewhere with the same drag law: 140 mm below the start, at 0.8 m/s.
  struct Case {
    double diameter, density, forward;
  };
  for (const Case& c : {Case{600e-6, 2650.0, 0.128076}, Case{300e-6, 2650.0, 0.1147},
                        Case{100e-6, 2650.0, 0.0472915}, Case{600e-6, 1500.0, 0.122896},
                        Case{300e-6, 3000.0, 0.116928}}) {
    CAPTURE(c.diameter);
    CAPTURE(c.density);
    const auto x = isolated_flight({c.diameter, c.density, 0.8}, k_air, k_gravity, k_drops);
    // 0.1 %: the density and viscosity of the air there are those of the scenario to that order.
    CHECK(x.back() == approx(c.forward).epsilon(1e-3));
    CHECK(x[0] < x[1]);
  }
}

TEST_CASE("what does not sink shall have no path") {
  CHECK(isolated_flight({1e-3, 1.0, 0.8}, k_air, k_gravity, k_drops).empty());
  CHECK(isolated_flight({1e-3, 2650.0, 0.8}, k_air, 0.0, k_drops).empty());
}
