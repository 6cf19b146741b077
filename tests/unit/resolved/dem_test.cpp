// SPDX-License-Identifier: Apache-2.0
#include "resolved_box.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace dust::test {

TEST_CASE(
    "resolved: a sphere of the DEM shall receive what the fluid gives, its momentum and spin") {
  DemRig rig;
  const int nylon = rig.material(2500.0, 5e6, 0.3);
  rig.law(nylon, nylon, 0.9, 0.3);
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {3, 3, 3};
  for (int axis = 0; axis < 3; ++axis) rig.periodic(axis);
  rig.diameters = {1.0};
  rig.has_fluid = true;
  rig.setup.time.fluid_step = 0.02;
  rig.setup.time.dem_step = 0.002;
  auto dem = rig.make();
  dem->insert(std::vector<particles::NewGrain>{{.position = {1.5, 1.45, 1.55},
                                                .velocity = {0.5, 0, 0},
                                                .rotation = {0, 1, 0},
                                                .diameter = 1.0}});

  auto box = cubic_array(24, 3.0);
  box->step = 0.02;
  box->fluid.density = 1000.0;
  box->fluid.viscosity = 100.0;
  box->begin();
  auto& spheres = *box->spheres;
  const auto total = [&] {
    const auto rows = dem->rows();
    const double* v = rows.velocity_of(0);
    return Vec3{v[0], v[1], v[2]} / v[3] + spheres.deferred() - spheres.inner_momentum() +
           box->fluid_momentum() - box->excess_momentum();
  };
  Vec3 before;
  double largest = 0.0;
  const int steps = static_cast<int>(std::lround(0.02 / dem->coarse_step()));
  for (int n = 0; n < 4; ++n) {
    dem->neighbours();
    spheres.begin_step(dem->rows(), box->solver->velocity());
    box->advance(box->step);
    spheres.evaluate(box->solver->velocity());
    const double speed = dem->rows().velocity_of(0)[0];
    spheres.act(dem->rows(), [&](std::size_t row, Vec3 change) { dem->turn(row, change); });
    dem->drag_relaxation_changed();
    for (int k = 0; k < steps; ++k) {
      dem->neighbours();
      dem->step_tiles(k * dem->coarse_step());
      dem->advance_fine();
    }
    dem->synchronise();
    const double received = (dem->rows().velocity_of(0)[0] - speed) / dem->rows().inverse_mass(0);
    spheres.end_step(dem->rows());
    const Vec3 now = total();
    CAPTURE(n);
    if (n == 0) CHECK(received < 0.0);
    largest = std::max(largest, std::abs(received));
    // Its velocity is the one predicted half a step ahead; that which moves it balances to
    // rounding.
    if (n > 0) CHECK(norm(now - before) < largest / steps);
    // One that has just come makes its first kick over half a step only.
    CHECK(norm(spheres.deferred()) < (n == 0 ? 0.6 / steps : 1e-3) * largest);
    before = now;
  }
  // The fluid turns against the spin.
  CHECK(dem->rows().rotation_of(0)[1] < 0.99);
  CHECK(dem->rows().rotation_of(0)[1] > 0.0);
}

}  // namespace dust::test
