// SPDX-License-Identifier: Apache-2.0
// The weight of dust in the gas.
#include "dusty_case.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_density = 1.2;
constexpr double k_dust = 2650.0;

/// A closed box of air, 8 x 8 x 16 cells of 10 mm, that holds a cloud up to the height `top` [m].
DustyCase closed_box(double concentration, double top) {
  DustyCase c;
  c.air.max = {0.08, 0.08, 0.16};
  c.air.cells = {8, 8, 16};
  c.air.fluid.density = k_density;
  c.air.fluid.viscosity = 1.8e-5;
  for (auto& side : c.air.sides) side = wall();
  c.spec.diameters = {0.5e-6};  // sinks by 10 um/s
  c.spec.density = k_dust;
  scenario::DustCloudSpec cloud;
  cloud.name = "cloud";
  cloud.max = {0.08, 0.08, top};
  cloud.concentration = {concentration};
  c.spec.clouds = {cloud};
  return c;
}

double fastest(const DustyCase& c) {
  double speed = 0.0;
  for (int d = 0; d < 3; ++d) {
    c.air.each_face(d,
                    [&](int, int, int, Vec3, double v) { speed = std::max(speed, std::abs(v)); });
  }
  return speed;
}

}  // namespace

TEST_CASE("dusty air below clean air shall stay at rest, its pressure bearing the dust's weight") {
  constexpr double k_concentration = 0.6;  // kg/m3, half of what the air weighs
  DustyCase c = closed_box(k_concentration, 0.08);
  c.start();
  for (int n = 0; n < 10; ++n) c.advance(1e-3);
  // Over seven cells from middle to middle within the cloud.
  const double carried = c.air.p(4, 4, 0) - c.air.p(4, 4, 7);
  const double weighs =
      k_concentration * (1.0 - k_density / k_dust) * DustyCase::k_gravity * 7 * 0.01;
  CHECK(carried == test::approx(weighs).epsilon(1e-3));
  CHECK(std::abs(c.air.p(4, 4, 10) - c.air.p(4, 4, 15)) < 1e-6 * weighs);
  // Without the pressure it would fall at 50 mm/s by now.
  CHECK(fastest(c) < 1e-4);
}

TEST_CASE(
    "dusty air above clean air shall fall, the air's momentum being what its weight gave it") {
  DustyCase c = closed_box(0.012, 0.16);
  for (int d = 0; d < 2; ++d) {
    c.air.sides[static_cast<std::size_t>(2 * d)].reset();  // periodic: nothing holds it up
    c.air.sides[static_cast<std::size_t>(2 * d + 1)].reset();
  }
  c.air.sides[4].reset();
  c.air.sides[5].reset();
  c.start();
  constexpr double k_end = 0.02;
  for (int n = 0; n < 20; ++n) c.advance(1e-3);
  // A hundredth of the air's weight: everything falls by g / 100 and more slowly for nothing else.
  const double should = -0.01 * (1.0 - k_density / k_dust) * DustyCase::k_gravity * k_end;
  CHECK(c.air.u(2, 3, 3, 5) == test::approx(should).epsilon(1e-6));
}
