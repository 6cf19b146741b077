// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_round_off = 1e-9;  ///< relative; the pressure is solved to 1e-11

/// Drag coefficient of a bed per volume of fluid [kg/(m3 s)], Ergun (1952): pressure drop per
/// length = coefficient x interstitial velocity.
double ergun(double eps, double superficial, double diameter, double density, double viscosity) {
  const double s = 1 - eps;
  const double drop =
      150 * viscosity * s * s * superficial / (eps * eps * eps * diameter * diameter) +
      1.75 * density * s * superficial * superficial / (eps * eps * eps * diameter);
  return drop / (superficial / eps);
}

}  // namespace

namespace {

/// Pressure drop over Ergun's for plug flow through a bed of eps 0.45; checks u = U / eps. The
/// drag is that of air; `inertia` is the density the flow itself has.
double bed_drop_ratio(double inertia) {
  const double inlet = 0.5;
  const int n = 40;
  Case c;
  c.max = {0.01, 0.01, 0.1};
  c.cells = {2, 1, n};
  c.fluid.density = inertia;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-11;
  for (int s = 0; s < 4; ++s) c.sides[s] = slip();
  c.sides[4] = wall({0, 0, inlet});
  c.sides[5] = open_side(0.0, false);
  c.start();
  const int bed_begin = 10;
  const int bed_end = 30;
  for (int k = bed_begin; k < bed_end; ++k) {
    for (int i = 0; i < 2; ++i) c.eps[c.grid.index(i, 0, k)] = 0.45;
  }
  const auto cell_eps = [&](int k) { return k < bed_begin || k >= bed_end ? 1.0 : 0.45; };
  // A grain's drag lies half on each of its cell's faces: faces at the bed's ends carry half of it.
  double expected = 0.0;
  for (int k = 1; k < n; ++k) {
    const double face_eps = 0.5 * (cell_eps(k - 1) + cell_eps(k));
    const double share = 0.5 * ((cell_eps(k - 1) < 1) + (cell_eps(k) < 1));
    const double drop = ergun(0.45, inlet, 450e-6, 1.2139, 1.8e-5) * inlet / 0.45;
    for (int i = 0; i < 2; ++i) {
      c.exchange.coefficient.component[2][c.grid.index(i, 0, k)] =
          share * drop / (inlet / face_eps);
    }
    expected += share * drop * c.grid.spacing.z;
  }
  for (int step = 0; step < 300; ++step) c.advance(2e-3);
  for (int k = 1; k < n; ++k) {
    const double face_eps = 0.5 * (cell_eps(k - 1) + cell_eps(k));
    CHECK(c.u(2, 0, 0, k) == test::approx(inlet / face_eps).epsilon(k_round_off));
  }
  return (c.p(0, 0, 1) - c.p(0, 0, n - 2)) / expected;
}

}  // namespace

TEST_CASE("V-POROUS-1D: plug flow through a bed shall have u = U / eps and Ergun's pressure drop") {
  // Without inertia the drop is Ergun's to the solver's tolerance, at any cell size. With it, the
  // jump of velocity at the ends of the bed loses a little of rho u^2 / 2 in the upwind scheme.
  const double friction = bed_drop_ratio(1e-4 * 1.2139);
  const double with_inertia = bed_drop_ratio(1.2139);
  MESSAGE("pressure drop over Ergun's: " << friction - 1 << " off without, " << with_inertia - 1
                                         << " off with inertia");
  CHECK(friction == test::approx(1.0).epsilon(1e-7));
  CHECK(with_inertia == test::approx(1.0).epsilon(1e-3));
}

TEST_CASE("V-DIV: continuity shall hold with a void fraction that changes in place and time") {
  Case c;
  c.max = {0.02, 0.01, 0.02};
  c.cells = {16, 6, 12};
  c.fluid.density = 1.2139;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-4;
  c.sides[0] = open_side(0.0, true);
  c.sides[1] = open_side(0.0, true);
  for (int s = 2; s < 6; ++s) c.sides[s] = wall();
  c.start();
  const auto eps_at = [&](double t) {
    fluid::CellField e(c.grid.size, 1.0);
    for (int k = 0; k < 12; ++k) {
      for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 16; ++i) {
          e[c.grid.index(i, j, k)] =
              0.7 + 0.2 * std::sin(0.9 * i + 0.7 * j + 0.5 * k) * std::cos(200 * t);
        }
      }
    }
    return e;
  };
  for (int n = 0; n < 10; ++n) {
    const double t = n * 1e-3;
    c.solver->advance(t, 1e-3, eps_at(t), eps_at(t + 1e-3), c.exchange);
    // |d(eps)/dt| is about 40 1/s, and the flow it drives the same.
    CHECK(c.solver->report().divergence < 1e-4 * 10 * 40);
    CHECK(c.solver->report().largest_speed > 0.001);
  }
}

TEST_CASE("a closed box with more inflow than outflow shall be refused with the reason") {
  Case c;
  c.max = {0.02, 0.01, 0.02};
  c.cells = {8, 1, 8};
  c.fluid.density = 1;
  c.fluid.viscosity = 1e-5;
  for (auto& s : c.sides) s = wall();
  c.sides[0] = wall({1, 0, 0});
  c.start();
  CHECK_THROWS_WITH_AS(c.advance(1e-3), doctest::Contains("more air in than out"), sdk::ModelError);
}

TEST_CASE("a force beyond all reason shall end with place, time and cause") {
  Case c;
  c.max = {0.02, 0.01, 0.02};
  c.cells = {8, 1, 8};
  c.fluid.density = 1;
  c.fluid.viscosity = 1e-5;
  c.start();
  c.set_source({1e9, 0, 0});
  CHECK_THROWS_WITH_AS(c.advance(1e-3), doctest::Contains("the fluid diverged"), sdk::ModelError);
  Case d;
  d.max = {0.02, 0.01, 0.02};
  d.cells = {8, 1, 8};
  d.fluid = c.fluid;
  d.start();
  d.exchange.source.component[2][d.grid.index(3, 0, 3)] = std::nan("");
  CHECK_THROWS_AS(d.advance(1e-3), sdk::ModelError);
}
