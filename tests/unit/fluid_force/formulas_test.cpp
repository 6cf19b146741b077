// SPDX-License-Identifier: Apache-2.0
// The formulas of the fluid forces by hand, by their limits and by series summed here.
#include "fluid_force/archimedes/archimedes.hpp"
#include "fluid_force/lubrication/lubrication.hpp"
#include "fluid_force/magnus/magnus.hpp"
#include "fluid_force/pressure_gradient/pressure_gradient.hpp"
#include "fluid_force/saffman/saffman.hpp"
#include "fluid_force/virtual_mass/virtual_mass.hpp"
#include "fluid_force/viscous/viscous.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using dust::test::approx;
using namespace dust::model;
using dust::sdk::Vec3;

constexpr double k_volume = std::numbers::pi / 6.0 * 1e-9;  // of a sphere of 1 mm [m3]

TEST_CASE("forces on the volume shall be the volume times the density of force") {
  const Vec3 lift = archimedes::force(1000.0, 1e-3, {0, 3.0, -9.81});
  CHECK(lift.x == 0.0);
  CHECK(lift.y == approx(-1000.0 * k_volume * 3.0).epsilon(1e-12));
  CHECK(lift.z == approx(1000.0 * k_volume * 9.81).epsilon(1e-12));
  CHECK(pressure_gradient::force(1e-3, {200.0, 0, 0}).x ==
        approx(-200.0 * k_volume).epsilon(1e-12));
  // The whole pressure of a fluid at rest pushes as Archimedes says.
  const Vec3 gravity{1.0, 2.0, -9.81};
  const Vec3 hydrostatic =
      pressure_gradient::force(1e-3, pressure_gradient::hydrostatic_gradient(1000.0, gravity));
  CHECK(norm(hydrostatic - archimedes::force(1000.0, 1e-3, gravity)) < 1e-20);
  CHECK(viscous::force(1e-3, {0, 7.0, 0}).y == approx(7.0 * k_volume).epsilon(1e-12));
  CHECK(virtual_mass::added_mass(0.5, 1000.0, 1e-3) == approx(500.0 * k_volume).epsilon(1e-12));
}

TEST_CASE("a grain that lags behind a shear shall be lifted towards the faster fluid") {
  // u_x = 100 z: vorticity (0, 100, 0). Water, 0.1 mm, slip 0.01 m/s:
  // 1.615 * 1e-8 * sqrt(1000 * 1e-3 / 100) * 0.01 * 100 = 1.615e-9 N.
  const Vec3 f = saffman::force(1e-4, 1000.0, 1e-3, {0.01, 0, 0}, {0, 100.0, 0});
  CHECK(f.x == 0.0);
  CHECK(f.y == 0.0);
  CHECK(f.z == approx(1.615e-9).epsilon(1e-12));
  CHECK(norm(saffman::force(1e-4, 1000.0, 1e-3, {0.01, 0, 0}, {})) == 0.0);
}

TEST_CASE("Mei's factor shall be 1 for slow grains and fall as printed") {
  CHECK(saffman::mei_factor(0.0, 0.1) == approx(1.0).epsilon(1e-12));
  // (1 - 0.3314 sqrt(0.1)) exp(-1) + 0.3314 sqrt(0.1) = 0.43412
  CHECK(saffman::mei_factor(10.0, 0.1) == approx(0.434123).epsilon(1e-5));
  // 0.0524 sqrt(0.1 * 100) = 0.16570
  CHECK(saffman::mei_factor(100.0, 0.1) == approx(0.165703).epsilon(1e-5));
  // The end of the first branch; the second begins at 0.1048.
  CHECK(saffman::mei_factor(40.0, 0.1) == approx(0.121194).epsilon(1e-4));
}

TEST_CASE("a spinning grain shall be lifted as Rubinow and Keller say") {
  // Stream along x, fluid at rest in itself, grain turning with 50 rad/s about y:
  // Omega x w = (0, -50, 0) x (2, 0, 0) = (0, 0, 100).
  const Vec3 f = magnus::force(1e-3, 1.2, {0, -50.0, 0}, {2.0, 0, 0});
  CHECK(f.z == approx(std::numbers::pi / 8.0 * 1e-9 * 1.2 * 100.0).epsilon(1e-12));
  CHECK(f.x == 0.0);
  CHECK(f.y == 0.0);
}

TEST_CASE("the fitted spin lift shall tend to Rubinow and Keller's and to its own plateau") {
  CHECK(magnus::oesterle_factor(1e-6, 1e-6) == approx(1.0).epsilon(1e-4));
  // Fast: C_L = 0.45, so the factor is 0.45 Re / Re_R.
  CHECK(magnus::oesterle_factor(1e5, 3e5) == approx(0.15).epsilon(1e-6));
  // Re 50, Re_R 100: 0.45 + 1.55 exp(-0.05684 * 6.3096 * 3.2336) = 0.9361
  CHECK(2.0 * magnus::oesterle_factor(50.0, 100.0) == approx(0.9361).epsilon(1e-3));
}

/// Brenner's series (1961, equation 2.19): drag of a sphere that moves straight to a rigid plane
/// over its Stokes drag, cosh(alpha) = 1 + delta.
double brenner(double delta) {
  const double alpha = std::acosh(1.0 + delta);
  double sum = 0.0;
  for (int n = 1; n < 4000; ++n) {
    const double a = (2 * n + 1) * alpha;
    if (a > 300.0) break;  // the terms are far below rounding
    const double top = 2.0 * std::sinh(a) + (2 * n + 1) * std::sinh(2.0 * alpha);
    const double half = std::sinh((n + 0.5) * alpha);
    const double bottom =
        4.0 * half * half - (2 * n + 1) * (2 * n + 1) * std::sinh(alpha) * std::sinh(alpha);
    sum += n * (n + 1.0) / ((2.0 * n - 1) * (2.0 * n + 3)) * (top / bottom - 1.0);
  }
  return 4.0 / 3.0 * std::sinh(alpha) * sum;
}

TEST_CASE("the lubrication fit shall follow Brenner's series") {
  CHECK(brenner(std::cosh(1.0) - 1.0) == approx(3.0361).epsilon(1e-4));  // his table
  for (const double delta : {0.005, 0.01, 0.05, 0.1, 0.5, 1.0, 3.0}) {
    CAPTURE(delta);
    CHECK(1.0 + lubrication::excess(delta) == approx(brenner(delta)).epsilon(0.01));
  }
}

TEST_CASE("lubrication shall grow from zero at its reach to its end at the smallest gap") {
  const auto at = [](double delta) {
    return lubrication::resistance(1e-3, 1e-3, delta * 1e-3, 0.01, 1.0);
  };
  CHECK(at(1.0) == 0.0);
  CHECK(at(5.0) == 0.0);
  CHECK(at(0.999) > 0.0);
  CHECK(at(0.999) < 1e-2 * at(0.1));
  CHECK(at(0.001) == at(0.01));
  const double stokes = 6.0 * std::numbers::pi * 1e-3 * 1e-3;
  // (7 * 0.01 + 2) / (6e-4 + 0.02) - 9 / 8
  CHECK(at(0.01) == approx(stokes * (2.07 / 0.0206 - 1.125)).epsilon(1e-12));
}

}  // namespace
