// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/resolved/resolved_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace dust::test {
namespace {

/// Torque on the spheres of a cubic array that turn with the same spin in Stokes flow, over that of
/// a lone one, 8 pi mu R^3 Omega; once it is steady.
double array_torque(int cells, double solids) {
  const double edge = std::cbrt(std::numbers::pi / 6.0 / solids);
  auto box = cubic_array(cells, edge);
  const double h = edge / cells;
  box->step = 0.5 * h * h;
  box->is_held = true;
  const double spin = 1e-3;
  box->grains.add({0.5 * edge, 0.5 * edge, 0.5 * edge}, 1.0, 1.0);
  box->grains.turn(0, {0.0, 0.0, spin});
  box->begin();
  const int pause = static_cast<int>(std::ceil(0.01 / box->step));
  double torque = 0.0;
  double before = 0.0;
  do {
    before = torque;
    for (int n = 0; n < pause; ++n) box->one_step();
    torque = -box->mean_torque[0].z / (std::numbers::pi * spin);  // R = 1/2
  } while (std::abs(torque - before) > 2e-5 * torque && box->time < 2.0);
  return torque;
}

}  // namespace

// Spheres that turn all alike meet the fluid as those of a rotating frame do: in a periodic flow
// its mean rotation is that of the spheres' share of the volume, turned the other way.
TEST_CASE(
    "V-SPIN: torque on a sphere that turns in a cubic array shall be right from 8 cells across "
    "on") {
  for (const double solids : {0.027, 0.125}) {
    const double known = 1.0 / (1.0 - solids);
    const double edge = std::cbrt(std::numbers::pi / 6.0 / solids);
    for (const int across : {8, 12, 16}) {
      // Even numbers of cells, which the multigrid halves.
      const int cells = 2 * static_cast<int>(std::ceil(0.5 * across * edge));
      const double torque = array_torque(cells, solids);
      MESSAGE(solids << ", " << cells / edge << " across: " << torque << " of " << known << ", "
                     << 100.0 * (torque / known - 1.0) << " %");
      CHECK(torque == test::approx(known).epsilon(0.01));
    }
  }
}

}  // namespace dust::test
