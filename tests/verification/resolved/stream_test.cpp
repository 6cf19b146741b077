// SPDX-License-Identifier: Apache-2.0
// One fixed sphere in a stream: its drag coefficient, and the eddy behind it.
#include "support/approx.hpp"
#include "unit/resolved/resolved_box.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::test {
namespace {

struct Stream {
  double drag = 0.0;  ///< [-] coefficient
  double eddy = 0.0;  ///< [-] length of the flow that comes back behind it, over its diameter
};

/// A sphere of diameter 1, `across` cells across, in a stream of 1 along z in a wide duct.
Stream stream_past(double reynolds, int across, double wide, double length) {
  ResolvedBox box;
  const int width = 2 * static_cast<int>(std::lround(0.5 * wide * across));
  const int height = 2 * static_cast<int>(std::lround(0.5 * length * across));
  const double h = 1.0 / across;
  box.max = {width * h, width * h, height * h};
  box.cells = {width, width, height};
  for (std::size_t side = 0; side < 4; ++side) box.sides[side] = slip();
  box.sides[4] = wall({0.0, 0.0, 1.0});
  box.sides[5] = open_side(0.0, false);
  box.fluid.density = 1.0;
  box.fluid.viscosity = 1.0 / reynolds;
  box.fluid.pressure_tolerance = 1e-4;
  box.step = std::min(0.3 * h, 0.9 * reynolds * h * h);
  box.is_held = true;
  const Vec3 centre{0.5 * width * h, 0.5 * width * h, 5.0};
  box.grains.add(centre, 1.0, 1e15);
  box.begin();
  box.solver->set_velocity([](Vec3) { return Vec3{0.0, 0.0, 1.0}; });
  Stream stream;
  double before = 0.0;
  const int pause = static_cast<int>(std::ceil(1.0 / box.step));
  do {
    before = stream.drag;
    for (int n = 0; n < pause; ++n) box.one_step();
    stream.drag = box.mean_force[0].z / (0.5 * 0.25 * std::numbers::pi);
  } while (std::abs(stream.drag - before) > 1e-3 * stream.drag && box.time < 30.0);
  // Along the axis, from the surface on.
  double last = 0.0;
  double last_place = 0.5;
  for (int k = static_cast<int>(std::lround((centre.z + 0.5) / h)) + 1; k < height; ++k) {
    const int m = width / 2;
    const double u = 0.25 * (box.u(2, m, m, k) + box.u(2, m - 1, m, k) + box.u(2, m, m - 1, k) +
                             box.u(2, m - 1, m - 1, k));
    const double place = k * h - centre.z;
    if (u < 0.0) stream.eddy = place - 0.5;
    if (u >= 0.0 && last < 0.0) {
      stream.eddy = last_place + (place - last_place) * last / (last - u) - 0.5;
      break;
    }
    last = u;
    last_place = place;
  }
  return stream;
}

}  // namespace

// Drag coefficients of an unbounded stream: Clift, Grace, Weber (1978), Bubbles, Drops, and
// Particles. The duct adds to them, less the wider it is and the farther before the sphere it
// begins.
TEST_CASE(
    "V-STREAM: drag of a fixed sphere in a stream, and the eddy that grows behind it, shall be the "
    "measured ones") {
  const Stream slow = stream_past(20.0, 8, 10.0, 13.0);
  const Stream middle = stream_past(50.0, 8, 10.0, 13.0);
  const Stream fast = stream_past(100.0, 12, 8.0, 11.0);
  MESSAGE("Re 20: C_d " << slow.drag << " of 2.7; no eddy");
  MESSAGE("Re 50: C_d " << middle.drag << " of 1.57; eddy " << middle.eddy);
  MESSAGE("Re 100: C_d " << fast.drag << " of 1.09; eddy " << fast.eddy << " of 0.87");
  CHECK(slow.drag == test::approx(2.7).epsilon(0.04));
  CHECK(middle.drag == test::approx(1.57).epsilon(0.04));
  CHECK(fast.drag == test::approx(1.09).epsilon(0.04));
  // The flow separates from a Reynolds number of about 24 on; the length at 100 is that of Johnson
  // and Patel (1999, 10.1017/S0022112098003206).
  CHECK(slow.eddy == 0.0);
  CHECK(middle.eddy > 0.15);
  CHECK(fast.eddy == test::approx(0.87).epsilon(0.15));
}

}  // namespace dust::test
