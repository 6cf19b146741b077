// SPDX-License-Identifier: Apache-2.0
// A sphere that starts at once: the fluid that has to come along.
#include "support/approx.hpp"
#include "unit/resolved/resolved_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace dust::test {
namespace {

/// Added mass of a sphere of diameter 1 over the mass that it displaces: the impulse that it has
/// given to fluid at rest after `steps` steps at a speed of 1, without that of the fluid inside it;
/// `ratio` is viscosity x step / (density cell^2).
double added_mass(int across, double ratio, int steps) {
  ResolvedBox box;
  const int width = 5 * across;
  const double h = 1.0 / across;
  box.cells = {width, width, width};
  box.max = {5.0, 5.0, 5.0};
  for (std::size_t side = 0; side < 4; ++side) box.sides[side] = slip();
  for (std::size_t side = 4; side < 6; ++side) box.sides[side] = open_side(0.0, false);
  box.fluid.density = 1.0;
  box.fluid.viscosity = ratio * h * h / 1e-3;
  box.fluid.pressure_tolerance = 1e-8;
  box.step = 1e-3;
  box.is_held = true;
  const double speed = 1e-3;
  box.grains.add({2.5, 2.5, 2.5}, 1.0, 1e15, {0.0, 0.0, speed});
  box.begin();
  double impulse = 0.0;
  for (int n = 0; n < steps; ++n) {
    box.one_step();
    impulse += box.step * box.mean_force[0].z;
  }
  const double inside = box.spheres->inner_momentum().z;
  return (-impulse - inside) / (speed * sdk::sphere_volume(1.0));
}

}  // namespace

// Stokes flow of a sudden start: 1/2, the viscous layer that has grown by then (Basset), and the
// steady drag since.
TEST_CASE(
    "V-START: the fluid that comes along with a sphere which starts at once shall be right once "
    "its layer is 1.4 cells thick") {
  for (const int across : {8, 16}) {
    const double layer = std::sqrt(2.0) / across;  // sqrt(nu t) of 1.4 cells, over the diameter
    const double known = 0.5 + 18.0 / std::sqrt(std::numbers::pi) * layer + 18.0 * layer * layer;
    const double viscous = added_mass(across, 0.1, 20);
    const double at_once = added_mass(across, 1e-4, 20);
    MESSAGE(across << " across: " << viscous << " of " << known << "; with hardly any viscosity "
                   << at_once << " of 0.5");
    CHECK(viscous == test::approx(known).epsilon(0.02));
    // The shell of fluid that the markers hold comes along: a limit that theory names.
    CHECK(at_once > 0.5);
    CHECK(at_once < (across == 8 ? 1.05 : 0.85));
  }
}

}  // namespace dust::test
