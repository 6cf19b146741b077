// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include <memory>

namespace dust::test {

/// A cylinder of 16 mm that goes 1.3 cells of 2.5 mm along x in a step [s], which is three cuts; in
/// a slice of air between slippery sides, open at the top.
inline Case crossing_cylinder(double step) {
  Case c;
  c.max = {0.06, 0.005, 0.06};
  c.cells = {24, 1, 24};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-10;
  for (auto& s : c.sides) s = slip();
  c.sides[5] = open_side(0.0, false);
  c.bodies.push_back(moving(std::make_unique<Cylinder>(Vec3{0.0203, 0, 0.0311}, 0.008, false),
                            Shift::steady({1.3 * 0.0025 / step, 0, 0})));
  return c;
}

}  // namespace dust::test
