// SPDX-License-Identifier: Apache-2.0
#include "airborne/dust_class.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

using dust::test::approx;
using namespace dust::airborne;

namespace {
constexpr Gas k_air{1.2139, 1.8e-5};
}

TEST_CASE("dust shall settle with the terminal velocity of Schiller and Naumann") {
  // Sand of 2650 kg/m3 in air: 7.987 mm/s at 10 um without slip, which adds 1.7 %.
  const double weight = (1.0 - k_air.density / 2650) * 9.81;
  CHECK(terminal_velocity(10e-6, 2650, weight, k_air) / slip_correction(10e-6, k_air) ==
        approx(7.987e-3).epsilon(1e-3));
  CHECK(terminal_velocity(300e-6, 2650, weight, k_air) == approx(2.320).epsilon(2e-3));
}

TEST_CASE("slip and diffusivity of fine dust shall be those of the books") {
  // Hinds, Aerosol Technology (1999), table 3.1 and 7.1: 1 um in air at 20 C.
  CHECK(slip_correction(1e-6, k_air) == approx(1.166).epsilon(0.005));
  CHECK(brownian_diffusivity(1e-6, {1.2, 1.81e-5}) == approx(2.77e-11).epsilon(0.02));
}

TEST_CASE("fine dust shall settle in a liquid as Stokes says, without slip") {
  const Gas water{998.0, 1e-3};
  const double weight = (1.0 - water.density / 2650) * 9.81;
  CHECK(terminal_velocity(1e-6, 2650, weight, water) ==
        approx(2650 * 1e-12 * weight / (18 * water.viscosity)).epsilon(1e-4));
}

TEST_CASE("what is lighter than the gas shall rise") {
  CHECK(make_class(50e-6, 0.5, {0, 0, -9.81}, k_air).drift.z > 0.0);
  CHECK(make_class(50e-6, 500, {0, 0, -9.81}, k_air).drift.z < 0.0);
  CHECK(norm(make_class(50e-6, 500, {0, 0, 0}, k_air).drift) == 0.0);
}
