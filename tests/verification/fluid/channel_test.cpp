// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_order = 1.9;  ///< least observed order that still counts as second

/// Flow along x between plates at z = 0 and z = H, driven by a pressure gradient (as a source in
/// the periodic direction) and by the upper plate.
struct Plates {
  double largest_error = 0.0;  ///< against `exact`
  double centre = 0.0;         ///< speed half way up, between the two cells there
  double mean = 0.0;
};

Plates plates(int cells, double gap, double density, double viscosity, double gradient, double lid,
              const std::function<double(double)>& exact) {
  Case c;
  c.max = {gap, gap, gap};
  c.cells = {1, 1, cells};
  c.fluid.density = density;
  c.fluid.viscosity = viscosity;
  c.sides[4] = wall();
  c.sides[5] = wall({lid, 0, 0});
  c.start();
  c.set_source({gradient, 0, 0});
  const double viscous_time = gap * gap * density / viscosity;
  c.advance_to(4 * viscous_time, 0.1 * viscous_time);
  Plates result;
  for (int k = 0; k < cells; ++k) {
    const double u = c.u(0, 0, 0, k);
    result.largest_error =
        std::max(result.largest_error, std::abs(u - exact(c.grid.centre(0, 0, k).z)));
    result.mean += u / cells;
  }
  result.centre = 0.5 * (c.u(0, 0, 0, cells / 2 - 1) + c.u(0, 0, 0, cells / 2));
  return result;
}

}  // namespace

TEST_CASE("V-POIS: flow between plates shall reach the parabola, second order") {
  const double gap = 0.01;
  const double mu = 1e-3;
  const double gradient = 240 / 0.2;
  const auto exact = [&](double z) { return gradient * z * (gap - z) / (2 * mu); };
  double last = 0.0;
  for (const int n : {8, 16, 32, 64}) {
    const Plates p = plates(n, gap, 1, mu, gradient, 0, exact);
    const double e = p.largest_error;
    MESSAGE("cells " << n << " largest error " << e << " of 15 m/s, order "
                     << (last > 0 ? order(last, e) : 0.0));
    if (last > 0) CHECK(order(last, e) > k_order);
    last = e;
    if (n != 64) continue;
    MESSAGE("centre " << p.centre << " m/s, mean " << p.mean << " m/s");
    CHECK(p.centre == test::approx(15.0).epsilon(1e-3));  // (h / H)^2 = 2.4e-4
    CHECK(p.mean == test::approx(10.0).epsilon(1e-3));
  }
}

TEST_CASE(
    "V-COUE: flow between a resting and a moving plate with pressure gradient shall be the "
    "parabola") {
  const double gap = 0.01;
  const double mu = 5e-6;
  for (const double gradient : {-3.0, -1.5, 0.0, 1.5, 3.0}) {
    const auto exact = [&](double z) { return 10 * z / gap + gradient * z * (gap - z) / (2 * mu); };
    const double coarse = plates(16, gap, 1, mu, gradient, 10, exact).largest_error;
    const Plates fine = plates(32, gap, 1, mu, gradient, 10, exact);
    MESSAGE("gradient " << gradient << ": errors " << coarse << " " << fine.largest_error
                        << ", order " << order(coarse, fine.largest_error) << ", centre "
                        << fine.centre << " m/s");
    // 7.5 m/s more at 3 Pa/m; (h / H)^2 = 1e-3 of it is what 32 cells leave.
    CHECK(fine.centre == test::approx(5.0 + 7.5 * gradient / 3.0).epsilon(2e-3));
    if (gradient == 0.0) {
      CHECK(fine.largest_error < 1e-4);  // a straight line is exact; the rest is of the start
    } else {
      CHECK(order(coarse, fine.largest_error) > k_order);
    }
  }
}

namespace {

/// Largest error, as a share of the wall's speed, of air over a wall started at 0.8 m/s. The wall
/// is the bottom of the domain, or a body whose surface cuts the cells `cut` above it.
double started_wall_error(double h, double t, double cut = 0.0) {
  const int cells = static_cast<int>(std::lround(0.08 / h));
  Case c;
  c.max = {h, h, 0.08};
  c.cells = {1, 1, cells};
  c.fluid.density = 1.2139;
  c.fluid.viscosity = 1.8e-5;
  c.sides[4] = wall({cut > 0 ? 0.0 : 0.8, 0, 0});
  c.sides[5] = slip();
  if (cut > 0) {
    c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, cut}, Vec3{0, 0, 1}), 0.8));
  }
  c.start();
  const double nu = 1.8e-5 / 1.2139;
  c.advance_to(t, 1e-3);
  double error = 0.0;
  for (int k = 0; k < cells; ++k) {
    const double z = c.grid.centre(0, 0, k).z - cut;
    if (z <= 0) continue;
    error =
        std::max(error, std::abs(c.u(0, 0, 0, k) / 0.8 - std::erfc(z / (2 * std::sqrt(nu * t)))));
  }
  return error;
}

}  // namespace

TEST_CASE("V-RAYL: air over a wall started at 0.8 m/s shall follow the error function within 1 %") {
  // The layer is 4.4 mm thick at 0.1 s: with 1.25 mm cells it needs some time to be resolved.
  MESSAGE("1.25 mm cells: " << started_wall_error(1.25e-3, 0.1) << " at 0.1 s, "
                            << started_wall_error(1.25e-3, 0.4) << " at 0.4 s; 0.5 mm cells: "
                            << started_wall_error(0.5e-3, 0.1) << " at 0.1 s");
  CHECK(started_wall_error(1.25e-3, 0.4) < 0.01);
  CHECK(started_wall_error(0.5e-3, 0.1) < 0.01);
  // The same over a body, wherever its surface cuts the cells.
  for (const double cut : {0.01003, 0.01013, 0.0102, 0.01024, 0.0103, 0.01049}) {
    const double error = started_wall_error(0.5e-3, 0.1, cut);
    MESSAGE("surface at " << cut << ": " << error);
    CHECK(error < 0.01);
  }
}

TEST_CASE("total pressure shall drive a frictionless channel to sqrt(2 X / rho), from both sides") {
  for (const double start : {0.0, -0.5}) {
    Case c;
    c.max = {0.1, 0.01, 0.01};
    c.cells = {20, 1, 4};
    c.fluid.density = 1.2;
    c.fluid.viscosity = 1.8e-5;
    c.fluid.pressure_tolerance = 1e-8;
    c.sides[0] = open_side(0.6, true);
    c.sides[1] = open_side(0.0, true);
    for (int s = 2; s < 6; ++s) c.sides[s] = slip();
    c.start();
    c.solver->set_velocity([&](Vec3) { return Vec3{start, 0, 0}; });
    c.advance_to(3.0, 5e-3);
    MESSAGE("u = " << c.u(0, 10, 0, 2));
    CHECK(c.u(0, 10, 0, 2) == test::approx(1.0).epsilon(1e-6));
    CHECK(std::abs(c.p(10, 0, 2)) < 1e-6 * 0.6);
  }
}
