// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/error.hpp"
#include "fluid/cached.hpp"
#include "fluid/cut_grid.hpp"
#include "fluid/pressure/projection.hpp"
#include "fluid/step/drag_velocity.hpp"
#include "fluid/step/flow_limits.hpp"
#include "fluid/step/step_balance.hpp"
#include "fluid/step/step_void_fraction.hpp"
#include "fluid/step/stress_field.hpp"
#include "fluid/step/two_stages.hpp"
#include "fluid_case.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "test_bodies.hpp"
#include "unit/bodies/shapes.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>

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
  CHECK(eps.field()[parts.grid.index(1, 1, 1)] == test::approx(0.6).epsilon(1e-15));
  CHECK(eps.field()[parts.grid.index(-1, 1, 1)] == test::approx(0.6).epsilon(1e-15));
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
    CHECK(properties.inverse_inertia_at(0, face) == test::approx(1.0 / inertia).epsilon(1e-15));
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
  CHECK_FALSE(cut.has_moving_bodies());
  CHECK(cut.intervals(1e3) == 1);
  CHECK(cut.open_fraction()[parts.grid.index(1, 1, 0)] == 0.0);
  CHECK(cut.open_fraction()[parts.grid.index(1, 1, 1)] == test::approx(0.5).epsilon(1e-6));
  CHECK(cut.open_fraction()[parts.grid.index(1, 1, 2)] == 1.0);

  fluid::Momentum momentum(parts.grid, cut.geometry(), sides, properties);
  fluid::Continuity continuity(parts.grid, cut.geometry(), sides, properties, momentum);
  const fluid::CellField before(parts.grid.size, 0.6);
  const fluid::CellField after(parts.grid.size, 0.8);
  cut.set_rate(before, after, 0.0, 1.0, 0.1, continuity);
  CHECK(continuity.rate()[parts.grid.index(1, 1, 0)] == 0.0);
  CHECK(continuity.rate()[parts.grid.index(1, 1, 1)] == test::approx(1.0).epsilon(1e-6));
  CHECK(continuity.rate()[parts.grid.index(1, 1, 2)] == test::approx(2.0).epsilon(1e-12));
}

namespace {

/// What the parts of a step refer to: a fluid of density 2 between slip walls, without bodies.
struct Flow {
  explicit Flow(Parts& p)
      : parts(p),
        sides(p.grid, p.conditions),
        properties(p.grid, p.spec),
        cut(p.grid, p.bodies, sides, properties),
        momentum(p.grid, cut.geometry(), sides, properties) {
    cut.complete(0.0);
    sides.set_flow_data(cut.geometry().open_area, properties.by_place());
    sides.evaluate_velocity(0.0, eps);
    sides.evaluate_pressure(0.0);
  }
  /// Sets component d of a field to a function of place, halos included.
  void set(fluid::FaceField& field, int d, const std::function<double(Vec3)>& value) const {
    const auto& n = parts.grid.count;
    for (int k = -2; k < n[2] + 2; ++k) {
      for (int j = -2; j < n[1] + 2; ++j) {
        for (int i = -2; i < n[0] + 2; ++i) {
          field.component[d][parts.grid.index(i, j, k)] = value(parts.grid.face(d, i, j, k));
        }
      }
    }
  }

  Parts& parts;
  fluid::Sides sides;
  fluid::FaceProperties properties;
  fluid::CutGrid cut;
  fluid::Momentum momentum;
  fluid::CellField eps = fluid::CellField(parts.grid.size, 1.0);
};

}  // namespace

TEST_CASE("sub-steps shall follow the Courant number, and a flow without bounds be told") {
  Parts parts;
  Flow flow(parts);
  fluid::FlowLimits limits(parts.grid, flow.cut.geometry(), flow.momentum, 0.5);
  fluid::FaceField u(parts.grid);
  flow.set(u, 0, [](Vec3) { return 3.0; });
  const fluid::Momentum::Rates rates = limits.find(u, 0.0);
  CHECK(rates.speed == 3.0);
  CHECK(rates.courant == test::approx(3.0));  // cells of 1 m
  CHECK(limits.sub_steps(u, 0.1, rates, 0.0, 0, 0.0) == 1);
  CHECK(limits.sub_steps(u, 1.0, rates, 0.0, 0, 0.0) == 6);
  // What is diffused explicitly asks for more.
  CHECK(limits.sub_steps(u, 1.0, rates, 18.0, 0, 0.0) == 10);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(limits.sub_steps(u, 1.0, rates, 0.0, 195, 0.25)),
      "the fluid needs more than 200 sub-steps in the step from t = 0.25 s: "
      "largest speed 3 m/s at [0, 0.5, 0.5] m; it is diverging, or time.fluid_step is "
      "far too long",
      sdk::ModelError);
  // Asked again it is the same, until it is told of a change.
  flow.set(u, 0, [](Vec3) { return std::numeric_limits<double>::quiet_NaN(); });
  CHECK(limits.find(u, 0.0).speed == 3.0);
  limits.velocity_changed();
  CHECK_THROWS_WITH_AS(limits.find(u, 0.0),
                       doctest::Contains("velocity component x is not a number at [0, 0.5, 0.5] m"),
                       sdk::ModelError);
}

TEST_CASE("what is not a number shall be told with its place inside bodies, too") {
  Parts parts;
  parts.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 1.5}, Vec3{0, 0, 1}), 0.0));
  Flow flow(parts);
  fluid::FlowLimits limits(parts.grid, flow.cut.geometry(), flow.momentum, 0.5);
  fluid::FaceField u(parts.grid);
  const std::ptrdiff_t inside = parts.grid.index(1, 1, 0);
  REQUIRE(flow.cut.geometry().kind[0][inside] == fluid::FaceKind::inside);
  u.component[0][inside] = 1e5;  // what bodies hold is no flow
  CHECK(limits.find(u, 0.0).speed == 0.0);
  u.component[0][inside] = std::numeric_limits<double>::quiet_NaN();
  limits.velocity_changed();
  CHECK_THROWS_WITH_AS(limits.find(u, 0.0),
                       doctest::Contains("velocity component x is not a number at [1, 1.5, 0.5] m"),
                       sdk::ModelError);
}

TEST_CASE("a projection shall take the divergence, and the pressure gain what did it") {
  Parts parts;
  Flow flow(parts);
  fluid::Projection projection(parts.grid, flow.cut, flow.sides, flow.properties, flow.momentum,
                               1e-12);
  fluid::FaceField u(parts.grid);
  flow.set(u, 2, [](Vec3 p) { return p.z * (5.0 - p.z); });
  const fluid::FaceField none(parts.grid);
  const double before = projection.continuity().largest_divergence(u, flow.eps);
  projection.begin_step({0.0, 0.1});
  projection.project(u, flow.eps, none, true, 0.1, 0.1);
  CHECK(projection.iterations() > 0);
  CHECK(before > 1.0);
  CHECK(projection.continuity().largest_divergence(u, flow.eps) < 1e-9 * before);
  // Between walls all of it was a gradient: rho u = step dp.
  const auto p = [&](int k) { return projection.pressure()[parts.grid.index(1, 1, k)]; };
  for (int k = 1; k < 5; ++k) {
    CHECK(p(k) - p(k - 1) == test::approx(2.0 * k * (5.0 - k) / 0.1).epsilon(1e-9));
  }
}

TEST_CASE("the first pressure shall hold a source that acts on a fluid at rest") {
  Parts parts;
  Flow flow(parts);
  fluid::Projection projection(parts.grid, flow.cut, flow.sides, flow.properties, flow.momentum,
                               1e-12);
  fluid::FaceField u(parts.grid);
  fluid::FaceField scratch(parts.grid);
  fluid::FaceField source(parts.grid);
  flow.set(source, 2, [](Vec3) { return -20.0; });
  CHECK_FALSE(projection.is_consistent());
  projection.make_consistent(u, scratch, flow.eps, source, 0.1, 0.0);
  CHECK(projection.is_consistent());
  for (int k = 1; k < 5; ++k) {
    const double* p = projection.pressure().data();
    CHECK(p[parts.grid.index(1, 1, k)] - p[parts.grid.index(1, 1, k - 1)] ==
          test::approx(-20.0).epsilon(1e-9));
    CHECK(u.component[2][parts.grid.index(1, 1, k)] == 0.0);
  }
}

TEST_CASE("two stages shall give a free stream its force, and drag what it takes in the mean") {
  Parts parts;
  parts.grid = fluid::Grid::make({0, 0, 0}, {4, 3, 5}, {4, 3, 5}, {true, true, true});
  parts.conditions = {};
  parts.spec.viscosity = 1e-9;  // else the sweeps of the implicit solve leave more than rounding
  Flow flow(parts);
  fluid::TwoStages stages(parts.grid, flow.cut.geometry(), flow.sides, flow.properties,
                          flow.momentum);
  fluid::CellField pressure(parts.grid.size, 0.0);
  fluid::FaceField source(parts.grid);
  fluid::FaceField drag(parts.grid);
  flow.set(source, 0, [](Vec3) { return 6.0; });
  fluid::FaceField u(parts.grid);
  flow.set(u, 0, [](Vec3) { return 1.0; });
  const double step = 0.1;
  const std::ptrdiff_t face = parts.grid.index(2, 1, 2);
  stages.advance({0.0, step, 1.0, 1e-30, source, drag, false, nullptr, nullptr}, flow.eps, false,
                 pressure, u);
  CHECK(u.component[0][face] == test::approx(1.0 + step * 6.0 / 2.0).epsilon(1e-10));

  flow.set(drag, 0, [](Vec3) { return 5.0; });
  fluid::DragVelocity taken(parts.grid);
  taken.begin(true);
  const double before = u.component[0][face];
  stages.advance({step, step, 1.0, 1e-30, source, drag, true, &taken, nullptr}, flow.eps, false,
                 pressure, u);
  const double mean = taken.field().component[0][face];
  CHECK(mean < before);  // it comes to 6 / 5
  CHECK(mean > 1.2);
  CHECK(2.0 * (u.component[0][face] - before) ==
        test::approx(step * (6.0 - 5.0 * mean)).epsilon(1e-9));
}

TEST_CASE("the mean pressure shall weigh the sub-steps of one step, and no other") {
  Parts parts;
  Flow flow(parts);
  fluid::StepBalance balance(parts.grid, flow.cut.geometry(), flow.properties);
  CHECK_FALSE(balance.is_kept());
  CHECK(balance.kept() == nullptr);
  fluid::StepVoidFraction eps(parts.grid);
  const fluid::FaceField rest(parts.grid);
  for (int step = 0; step < 2; ++step) {
    balance.begin_step(true);
    balance.begin(rest, eps, rest, 0.1);
    CHECK(balance.kept() != nullptr);
    balance.add_pressure(fluid::CellField(parts.grid.size, 8.0), 0.25, true);
    balance.add_pressure(fluid::CellField(parts.grid.size, 4.0), 0.75, false);
    CHECK(balance.mean_pressure()[parts.grid.index(1, 1, 1)] == 5.0);
  }
  balance.begin_step(false);
  CHECK(balance.kept() == nullptr);
  MemoryArchive archive;
  balance.save(archive);
  fluid::StepBalance loaded(parts.grid, flow.cut.geometry(), flow.properties);
  loaded.load(archive);
  CHECK(loaded.mean_pressure().size() == parts.grid.size);
}

TEST_CASE("the force of the stress shall be found once for a flow, and follow the pressure") {
  Parts parts;
  Flow flow(parts);
  fluid::StressField stress(parts.grid, flow.cut.geometry(), flow.sides, flow.momentum);
  const fluid::FaceField rest(parts.grid);
  fluid::CellField pressure(parts.grid.size, 0.0);
  const auto set_gradient = [&](double gradient) {
    for (int k = 0; k < 5; ++k) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 4; ++i) pressure[parts.grid.index(i, j, k)] = gradient * k;
      }
    }
  };
  const std::ptrdiff_t face = parts.grid.index(1, 1, 2);
  const auto force = [&] { return stress.of_flow(rest, pressure, nullptr).component[2][face]; };
  stress.flow_changed();
  set_gradient(3.0);
  CHECK(force() == -3.0);
  set_gradient(7.0);
  CHECK(force() == -3.0);
  stress.flow_changed();
  CHECK(force() == -7.0);
  fluid::CellField mean(parts.grid.size, 1.0);
  CHECK(stress.of_mean(rest, mean, nullptr).component[2][face] == 0.0);
  CHECK(force() == 0.0);
}

TEST_CASE("a belt whose cleats alone are cut anew shall be as one that is cut in whole") {
  for (const double trough_angle : {0.0, 0.6}) {
    CAPTURE(trough_angle);
    Parts parts;
    parts.grid = fluid::Grid::make({-0.8, -0.3, 0}, {0.6, 0.3, 0.5}, {28, 12, 10}, {});
    parts.bodies.emplace_back();
    parts.bodies[0].shape = make_shape("belt_conveyor", {{"head", Vec3{}},
                                                         {"tail", Vec3{-2, 0, 0}},
                                                         {"radius", 0.19},
                                                         {"thickness", 0.02},
                                                         {"width", 0.4},
                                                         {"trough_angle", trough_angle},
                                                         {"transition", 0.5},
                                                         {"cleat_height", 0.08},
                                                         {"cleat_thickness", 0.03},
                                                         {"cleat_spacing", 0.5}});
    parts.bodies[0].motions.push_back(
        ModelLoader::make<sdk::Motion>("motion", "belt", {{"speed", 1.0}}));
    const fluid::Sides sides(parts.grid, parts.conditions);
    const fluid::FaceProperties properties(parts.grid, parts.spec);
    const fluid::Geometry at_rest =
        fluid::build_static_geometry(parts.grid, parts.bodies, sides.kinds(), properties);
    const auto cut = [&](const fluid::Geometry* known) {
      return fluid::build_geometry(parts.grid, parts.bodies, sides.kinds(), properties, {0.1, 0.12},
                                   known);
    };
    const fluid::Geometry whole = cut(nullptr);
    const fluid::Geometry anew = cut(&at_rest);
    CHECK(whole.open_fraction == anew.open_fraction);
    CHECK(whole.open_fraction != at_rest.open_fraction);  // the cleats are there
    // The belt itself: its lower 10 mm of a cell of 50 mm; a trough begins to bend 5 mm from there.
    CHECK(at_rest.open_fraction[parts.grid.index(8, 6, 3)] ==
          test::approx(0.8).epsilon(trough_angle == 0.0 ? 1e-9 : 1e-3));
    for (int d = 0; d < 3; ++d) {
      // To rounding: shares of a face are means over instants where something moves.
      const auto& area = whole.open_area.component[d];
      const auto& area_anew = anew.open_area.component[d];
      for (std::size_t n = 0; n < area.size(); ++n) {
        if (std::abs(area[n] - area_anew[n]) > 1e-15) FAIL_CHECK("face " << n << " of " << d);
      }
      CHECK(whole.kind[d] == anew.kind[d]);
    }
    CHECK(whole.wall.x == anew.wall.x);
  }
}
