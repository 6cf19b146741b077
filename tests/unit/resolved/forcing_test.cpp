// SPDX-License-Identifier: Apache-2.0
#include "resolved_box.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dust::test {
TEST_CASE("resolved: steady drag shall not depend on the fluid step, nor on the time to settle") {
  // 8 cells across, the fewest that are allowed. All markers stand still in the end, so what is
  // left is how steady "steady" is.
  const double drag = array_drag(16, 0.064);
  CAPTURE(drag);
  CHECK(drag == test::approx(2.810).epsilon(0.01));  // Zick and Homsy 1982
  for (const double ratio : {1.0, 0.1, 0.03}) {
    CAPTURE(ratio);
    CHECK(array_drag(16, 0.064, ratio) == test::approx(drag).epsilon(1e-3));
  }
}

TEST_CASE("resolved: sphere and fluid in a periodic box shall keep their momentum") {
  auto box = cubic_array(24, 3.0);
  box->step = 0.01;
  box->fluid.viscosity = 0.1;
  box->fluid.pressure_tolerance = 1e-8;
  box->grains.add({1.53, 1.41, 1.47}, 1.0, 2.5, {0.8, -0.2, 0.1});
  box->begin();
  const auto total = [&] {
    return box->grains.momentum() + box->spheres->deferred() - box->spheres->inner_momentum() +
           box->fluid_momentum() - box->excess_momentum();
  };
  const double scale = norm(box->grains.momentum());
  box->one_step();
  Vec3 before = total();
  const Vec3 first = before;
  for (int n = 0; n < 12; ++n) {
    box->one_step();
    const Vec3 now = total();
    CAPTURE(n);
    CHECK(norm(now - before) < 1e-10 * scale);
    before = now;
  }
  CHECK(norm(before - first) < 1e-9 * scale);
  // And the sphere has given a part of it away.
  CHECK(norm(box->grains.momentum()) < 0.9 * scale);
}

TEST_CASE(
    "resolved: the force on a sphere that is pushed through the grid shall not swing with its "
    "cells") {
  auto box = cubic_array(20, 2.5);  // 8 cells across
  box->step = 0.02;
  box->fluid.viscosity = 0.5;
  box->fluid.pressure_tolerance = 1e-6;
  box->grains.add({1.25, 1.25, 1.25}, 1.0, 1e15, {0.5, 0.0, 0.0});
  box->begin();
  std::vector<double> force;
  for (int n = 0; n < 90; ++n) {
    box->one_step();
    box->set_source({box->mean_force[0].x / std::pow(2.5, 3), 0.0, 0.0});
    force.push_back(box->mean_force[0].x);
  }
  // Four cells take 50 steps.
  const auto [least, most] = std::minmax_element(force.begin() + 40, force.end());
  CHECK(*most < 0.0);
  CHECK(*most - *least < 0.02 * std::abs(*most));
  CHECK(*most - *least > 1e-6 * std::abs(*most));  // it does feel the grid
}

TEST_CASE("resolved: the stream shall hold back a sphere that outruns it until that has left") {
  // 8 cells across, 1.2 times as fast as the fluid, out of a duct with an open end at z = 3.
  ResolvedBox box;
  box.max = {2.0, 2.0, 3.0};
  box.cells = {16, 16, 24};
  box.fluid.density = 1.0;
  box.fluid.viscosity = 1.0;
  box.fluid.pressure_tolerance = 1e-6;
  for (std::size_t side = 0; side < 4; ++side) box.sides[side] = slip();
  box.sides[4] = wall({0.0, 0.0, 1.0});
  box.sides[5] = open_side(0.0, false);
  box.step = 0.004;
  box.grains.add({1.01, 1.02, 2.2}, 1.0, 1e15, {0.0, 0.0, 1.2});
  box.begin();
  box.solver->set_velocity([](Vec3) { return Vec3{0.0, 0.0, 1.0}; });
  double inside = 0.0;
  while (box.grains.position(0).z < 3.4) {
    box.one_step();
    const double z = box.grains.position(0).z;
    if (z < 2.3) continue;  // until the flow is round it
    const double force = box.mean_force[0].z;
    CAPTURE(z);
    CHECK(force < 0.0);
    if (inside == 0.0) inside = force;
    CHECK(force > 1.3 * inside);
  }
}

TEST_CASE("resolved: one and two threads shall give the same bits") {
  const auto run = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    auto box = cubic_array(24, 3.0);
    box->step = 0.02;
    box->grains.add({0.9, 1.4, 1.5}, 1.0, 2.5, {0.8, -0.2, 0.1});
    box->grains.add({2.1, 1.6, 1.5}, 1.0, 2.5, {-0.8, 0.0, 0.1});
    box->begin();
    for (int n = 0; n < 5; ++n) box->one_step();
    return std::array<Vec3, 3>{box->grains.position(0), box->grains.velocity(1),
                               box->grains.rotation(1)};
  };
  const auto one = run(1);
  const auto two = run(2);
  CHECK(one == two);
  CHECK(norm(one[2]) > 0.0);
}

}  // namespace dust::test
