// SPDX-License-Identifier: Apache-2.0
#include "fluid_case.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>
#include <iterator>

using namespace dust;
using namespace dust::test;

namespace {

/// Ghia, Ghia and Shin (1982), tables I and II, Re = 100, 10.1016/0021-9991(82)90058-4:
/// place on the centre line, velocity.
constexpr double k_u[][2] = {{0.0547, -0.03717}, {0.0625, -0.04192}, {0.0703, -0.04775},
                             {0.1016, -0.06434}, {0.1719, -0.10150}, {0.2813, -0.15662},
                             {0.4531, -0.21090}, {0.5000, -0.20581}, {0.6172, -0.13641},
                             {0.7344, 0.00332},  {0.8516, 0.23151},  {0.9531, 0.68717},
                             {0.9609, 0.73722},  {0.9688, 0.78871},  {0.9766, 0.84123}};
constexpr double k_v[][2] = {{0.0625, 0.09233},  {0.0703, 0.10091},  {0.0781, 0.10890},
                             {0.0938, 0.12317},  {0.1563, 0.16077},  {0.2266, 0.17507},
                             {0.2344, 0.17527},  {0.5000, 0.05454},  {0.8047, -0.24533},
                             {0.8594, -0.22445}, {0.9063, -0.16914}, {0.9453, -0.10313},
                             {0.9531, -0.08864}, {0.9609, -0.07391}, {0.9688, -0.05906}};

}  // namespace

TEST_CASE("V-GHIA-100: the driven cavity at Re 100 shall meet the published centre lines") {
  constexpr int n = 64;
  constexpr double k_rms = 0.005;  // of the lid's speed, the catalogue's tolerance
  Case c;
  c.cells = {n, 1, n};
  c.fluid.density = 1;
  c.fluid.viscosity = 0.01;
  c.fluid.largest_cfl = 0.9;
  c.fluid.pressure_tolerance = 1e-3;
  c.sides[0] = wall();
  c.sides[1] = wall();
  c.sides[2] = slip();
  c.sides[3] = slip();
  c.sides[4] = wall();
  c.sides[5] = wall({1, 0, 0});
  c.start();
  c.advance_to(12, 0.25);
  // Along the line through the middle, straight between the points of the grid.
  const auto at = [&](double place, const auto& value) {
    const double s = place * n - 0.5;
    const int k = static_cast<int>(s);
    const double f = s - k;
    return (1 - f) * value(k) + f * value(k + 1);
  };
  const auto u_at = [&](double z) { return at(z, [&](int k) { return c.u(0, n / 2, 0, k); }); };
  const auto v_at = [&](double x) { return at(x, [&](int i) { return c.u(2, i, 0, n / 2); }); };
  double u_sum = 0.0;
  double v_sum = 0.0;
  for (const auto& row : k_u) u_sum += std::pow(u_at(row[0]) - row[1], 2);
  for (const auto& row : k_v) v_sum += std::pow(v_at(row[0]) - row[1], 2);
  const double u_rms = std::sqrt(u_sum / std::size(k_u));
  const double v_rms = std::sqrt(v_sum / std::size(k_v));
  MESSAGE("rms " << u_rms << " (u), " << v_rms << " (v), u(0.5) = " << u_at(0.5) << ", last step "
                 << c.solver->report().sub_steps << " sub-steps");
  CHECK(u_rms < k_rms);
  CHECK(v_rms < k_rms);
  CHECK(u_at(0.5) == test::approx(-0.20581).epsilon(0.02));
}
