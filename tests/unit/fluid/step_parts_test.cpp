// SPDX-License-Identifier: Apache-2.0
#include "fluid/cached.hpp"
#include "fluid/cut_grid.hpp"
#include "fluid/drag_velocity.hpp"
#include "fluid/step_void_fraction.hpp"
#include "fluid_case.hpp"
#include "test_bodies.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;

namespace {

/// The parts of a solver in a box of 4 x 3 x 5 cells between slip walls.
struct Parts {
  Parts() {
    for (std::size_t n = 0; n < 6; ++n) {
      boundary[n] = slip();
      conditions[n] = boundary[n].get();
    }
    spec.density = 2.0;
    spec.viscosity = 1e-3;
  }
  std::array<std::unique_ptr<TestSide>, 6> boundary;
  std::array<const sdk::BoundaryCondition*, 6> conditions{};
  fluid::Grid grid = fluid::Grid::make({0, 0, 0}, {4, 3, 5}, {4, 3, 5}, {false, false, false});
  scenario::FluidSpec spec;
  bodies::BodySet bodies;
};

}  // namespace

TEST_CASE("a cached value shall be found once after each change, and only when it is asked for") {
  int found = 0;
  const auto find = [&found](int& value) { value = 10 * ++found; };
  fluid::Cached<int> cached;
  CHECK_FALSE(cached.is_valid());
  CHECK(cached.get(find) == 10);
  CHECK(cached.get(find) == 10);
  CHECK(found == 1);
  cached.invalidate();
  cached.invalidate();
  CHECK(found == 1);
  CHECK(cached.get(find) == 20);
  cached.invalidate();
  cached.write() = 7;
  CHECK(cached.get(find) == 7);
  CHECK(found == 2);
  fluid::Cached<int> known(3);
  CHECK(known.get(find) == 3);
}

TEST_CASE("the void fraction within a step shall lie on the line between its ends, halos too") {
  Parts parts;
  const fluid::Sides sides(parts.grid, parts.conditions);
  fluid::FaceProperties properties(parts.grid, parts.spec);
  const fluid::CellField before(parts.grid.size, 0.5);
  fluid::CellField after(parts.grid.size, 0.9);
  fluid::StepVoidFraction eps(parts.grid);
  CHECK(eps.field()[parts.grid.index(1, 1, 1)] == 1.0);
  eps.set(parts.grid, sides, before, after, 0.25, false, properties);
  CHECK(eps.field()[parts.grid.index(1, 1, 1)] == doctest::Approx(0.6).epsilon(1e-15));
  CHECK(eps.field()[parts.grid.index(-1, 1, 1)] == doctest::Approx(0.6).epsilon(1e-15));
  // Where no solids are, 1; and nothing is read again as long as that holds.
  const fluid::CellField ones(parts.grid.size, 1.0);
  eps.set(parts.grid, sides, ones, ones, 0.25, true, properties);
  CHECK(eps.field()[parts.grid.index(3, 2, 4)] == 1.0);
  after.assign(after.size(), -1.0);
  eps.set(parts.grid, sides, after, after, 0.5, true, properties);
  CHECK(eps.field()[parts.grid.index(3, 2, 4)] == 1.0);
  eps.set(parts.grid, sides, before, before, 1.0, false, properties);
  CHECK(eps.field()[parts.grid.index(3, 2, 4)] == 0.5);
}

TEST_CASE("in set III the inertia of the fluid shall follow the void fraction") {
  Parts parts;
  const fluid::Sides sides(parts.grid, parts.conditions);
  const fluid::CellField half(parts.grid.size, 0.5);
  const std::ptrdiff_t face = parts.grid.index(2, 1, 2);
  for (const char* set : {"I", "II", "III"}) {
    parts.spec.momentum_set = set;
    fluid::FaceProperties properties(parts.grid, parts.spec);
    fluid::StepVoidFraction eps(parts.grid);
    eps.set(parts.grid, sides, half, half, 0.0, false, properties);
    const double inertia = parts.spec.momentum_set == "III" ? 1.0 : 2.0;
    CHECK(properties.inverse_inertia_at(0, face) == doctest::Approx(1.0 / inertia).epsilon(1e-15));
  }
}

TEST_CASE("the velocity that drag acted on shall be the mean over the stages of a step") {
  Parts parts;
  const fluid::Sides sides(parts.grid, parts.conditions);
  const fluid::FaceProperties properties(parts.grid, parts.spec);
  const fluid::Geometry geometry =
      fluid::build_geometry(parts.grid, parts.bodies, sides.kinds(), properties, {}, nullptr);
  fluid::FaceField slow(parts.grid);
  fluid::FaceField fast(parts.grid);
  for (auto& component : slow.component) component.assign(component.size(), 1.0);
  for (auto& component : fast.component) component.assign(component.size(), 3.0);
  const std::ptrdiff_t face = parts.grid.index(1, 1, 1);
  fluid::DragVelocity drag(parts.grid);
  CHECK_FALSE(drag.is_set());
  for (int step = 0; step < 2; ++step) {  // nothing is left of the step before
    drag.begin(true);
    CHECK(drag.is_set());
    drag.add_stage(geometry, slow, 0.25);
    drag.add_stage(geometry, fast, 0.75);
    for (int d = 0; d < 3; ++d) CHECK(drag.field().component[d][face] == 2.5);
  }
  drag.begin(false);
  CHECK_FALSE(drag.is_set());
  for (int d = 0; d < 3; ++d) CHECK(drag.field().component[d][face] == 0.0);
}

TEST_CASE("a grid whose bodies stand shall be cut once, and its cells gain what grains lose") {
  Parts parts;
  const fluid::Sides sides(parts.grid, parts.conditions);
  const fluid::FaceProperties properties(parts.grid, parts.spec);
  // Solid below z = 1.5: the second layer of cells is half open.
  parts.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 1.5}, Vec3{0, 0, 1}), 0.0));
  fluid::CutGrid cut(parts.grid, parts.bodies, sides, properties);
  cut.complete(0.0);
  CHECK_FALSE(cut.has_movers());
  CHECK(cut.intervals(1e3) == 1);
  CHECK(cut.open_fraction()[parts.grid.index(1, 1, 0)] == 0.0);
  CHECK(cut.open_fraction()[parts.grid.index(1, 1, 1)] == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(cut.open_fraction()[parts.grid.index(1, 1, 2)] == 1.0);

  fluid::Momentum momentum(parts.grid, cut.geometry(), sides, properties);
  fluid::Continuity continuity(parts.grid, cut.geometry(), sides, properties, momentum);
  const fluid::CellField before(parts.grid.size, 0.6);
  const fluid::CellField after(parts.grid.size, 0.8);
  cut.set_rate(before, after, 0.0, 1.0, 0.1, continuity);
  CHECK(continuity.rate()[parts.grid.index(1, 1, 0)] == 0.0);
  CHECK(continuity.rate()[parts.grid.index(1, 1, 1)] == doctest::Approx(1.0).epsilon(1e-6));
  CHECK(continuity.rate()[parts.grid.index(1, 1, 2)] == doctest::Approx(2.0).epsilon(1e-12));
}
