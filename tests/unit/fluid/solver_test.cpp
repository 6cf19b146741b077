// SPDX-License-Identifier: Apache-2.0
#include "boundary/moving_wall/moving_wall.hpp"
#include "dust/sdk/error.hpp"
#include "fluid_case.hpp"
#include "support/approx.hpp"
#include "test_bodies.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <numbers>

using namespace dust;
using namespace dust::test;

namespace {

/// Small transfer point: a turning cylinder that reaches through the left side, total pressure left
/// and right, a column of drag.
std::unique_ptr<Case> transfer(std::array<int, 3> cells = {48, 9, 40}) {
  auto c = std::make_unique<Case>();
  c->max = {0.06, 0.011, 0.05};
  c->cells = cells;
  c->fluid.density = 1.2139;
  c->fluid.viscosity = 1.8e-5;
  c->sides[0] = open_side(0.0, true);
  c->sides[1] = open_side(0.0, true);
  c->sides[2] = slip();
  c->sides[3] = slip();
  c->sides[4] = wall();
  c->sides[5] = wall();
  c->bodies.push_back(body(std::make_unique<Cylinder>(Vec3{0.005, 0, 0.023}, 0.0123, false), 0.8));
  c->start();
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 22; i < 27; ++i) {
        const auto o = c->grid.index(i, j, k);
        c->eps[o] = 0.97;
        c->exchange.coefficient.component[2][o] = 50;
        c->exchange.source.component[2][o] = -75;
      }
    }
  }
  return c;
}

}  // namespace

TEST_CASE("a step shall have the same bits on one and on two threads") {
  fluid::FaceField u[2];
  fluid::CellField p[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto c = transfer();
    c->advance_to(0.01, 1e-3);
    u[threads - 1] = c->solver->velocity();
    p[threads - 1] = c->solver->pressure();
  }
  for (int d = 0; d < 3; ++d) CHECK(u[0].component[d] == u[1].component[d]);
  CHECK(p[0] == p[1]);
}

TEST_CASE("a run shall go on from saved fields bit for bit") {
  const auto whole = transfer({48, 1, 40});
  whole->advance_to(0.02, 1e-3);
  const auto first = transfer({48, 1, 40});
  first->advance_to(0.01, 1e-3);
  MemoryArchive archive;
  first->solver->save(archive);
  const auto second = transfer({48, 1, 40});
  second->solver->load(archive, second->time);
  for (int d = 0; d < 3; ++d) {
    CHECK(second->solver->velocity().component[d] == first->solver->velocity().component[d]);
  }
  second->time = first->time;
  second->advance_to(0.02, 1e-3);
  for (int d = 0; d < 3; ++d) {
    CHECK(second->solver->velocity().component[d] == whole->solver->velocity().component[d]);
    CHECK(second->solver->stress_divergence().component[d] ==
          whole->solver->stress_divergence().component[d]);
  }
  CHECK(second->solver->pressure() == whole->solver->pressure());
  const auto other = transfer({40, 1, 40});
  CHECK_THROWS_AS(other->solver->load(archive, 0.0), sdk::ModelError);
}

TEST_CASE("an open domain with a belt and a falling stream shall stay bounded, divergence small") {
  const auto c = transfer({48, 1, 40});
  double fastest = 0.0;
  for (int n = 0; n < 500; ++n) {
    c->advance(1e-3);
    fastest = std::max(fastest, c->solver->report().largest_speed);
    CHECK(c->solver->report().courant_number < 1.01 * dust::scenario::FluidSpec{}.largest_cfl);
  }
  MESSAGE("fastest " << fastest << " m/s, divergence " << c->solver->report().divergence << " 1/s");
  CHECK(fastest < 2.5);  // grains pull towards 1.5 m/s
  CHECK(fastest > 0.8);
  // The pressure is solved to 1e-4 of what the flow of a step lacks, which is far less than U/h.
  CHECK(c->solver->report().divergence < 1e-6 * 1.5 / 1.25e-3);
}

TEST_CASE("faces inside a body shall make linear interpolation meet the surface's velocity") {
  const auto c = transfer({48, 1, 40});
  c->advance_to(0.2, 1e-3);
  const Vec3 axis{0.005, 0, 0.023};
  double worst = 0.0;
  const auto& g = c->grid;
  for (int s = 0; s < 60; ++s) {
    const double a = -1.2 + 2.4 * s / 59;
    const Vec3 n{std::cos(a), 0, std::sin(a)};
    const Vec3 at = axis + 0.0123 * n;
    const Vec3 wall_velocity = 0.8 * sdk::cross({0, 1, 0}, n);
    for (const int d : {0, 2}) {
      const double x = (at.x - g.origin.x) / g.spacing.x - (d == 0 ? 0 : 0.5);
      const double z = (at.z - g.origin.z) / g.spacing.z - (d == 2 ? 0 : 0.5);
      const int i = static_cast<int>(std::floor(x));
      const int k = static_cast<int>(std::floor(z));
      const double u =
          (1 - z + k) * ((1 - x + i) * c->u(d, i, 0, k) + (x - i) * c->u(d, i + 1, 0, k)) +
          (z - k) * ((1 - x + i) * c->u(d, i, 0, k + 1) + (x - i) * c->u(d, i + 1, 0, k + 1));
      worst = std::max(worst, std::abs(u - wall_velocity[d]));
    }
  }
  MESSAGE("off by at most " << worst << " m/s of 0.8 m/s");
  CHECK(worst < 0.1);  // the layer of 1.7 mm is hardly resolved by cells of 1.25 mm
}

TEST_CASE("a thin direction shall not change a flow that does not vary along it") {
  const auto flat = transfer({48, 1, 40});
  const auto deep = transfer({48, 5, 40});
  for (const auto* c : {&flat, &deep}) {
    (*c)->solver->set_velocity([](Vec3) { return Vec3{}; });
    (*c)->advance_to(0.02, 1e-3);
  }
  double off = 0.0;
  for (int k = 0; k < 40; ++k) {
    for (int i = 0; i < 48; ++i) {
      for (const int d : {0, 2})
        off = std::max(off, std::abs(flat->u(d, i, 0, k) - deep->u(d, i, 2, k)));
    }
  }
  CHECK(off < 5e-6);  // the pressure is solved to 1e-4 of each step's change, on different grids
}

TEST_CASE("a slippery column one cell across shall have no friction, along any axis") {
  const double drop = 10.0;
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Case c;
    c.max = {0.02, 0.02, 0.02};
    c.max[axis] = 0.1;
    c.cells[axis] = 10;
    c.fluid.density = 1000.0;
    c.fluid.viscosity = 1.0;  // times 2 / h^2: 5 1/s of drag, had it walls
    c.fluid.pressure_tolerance = 1e-12;
    for (auto& s : c.sides) s = slip();
    c.sides[2 * axis] = open_side(drop, false);
    c.sides[2 * axis + 1] = open_side(0.0, false);
    c.start();
    c.advance_to(0.1, 1e-3);
    const double expected = drop / (c.fluid.density * c.max[axis]) * c.time;
    std::array<int, 3> at{};
    for (at[axis] = 0; at[axis] <= 10; ++at[axis]) {
      CHECK(c.u(axis, at[0], at[1], at[2]) == test::approx(expected).epsilon(1e-9));
    }
  }
}

TEST_CASE("sides that cannot be solved shall be refused") {
  Case c;
  c.fluid.density = 1;
  c.sides[0] = wall();
  c.sides[1] = wall();
  c.sides[0]->side_rules.pressure = sdk::SideRule::fixed;
  CHECK_THROWS_WITH_AS(c.start(), doctest::Contains("side left"), sdk::ParameterError);
}

TEST_CASE("open fractions of a body shall add up to its volume, planes along the grid exactly") {
  const auto c = transfer({48, 1, 40});
  double open = 0.0;
  for (int k = 0; k < 40; ++k) {
    for (int i = 0; i < 48; ++i) open += c->solver->open_fraction()[c->grid.index(i, 0, k)];
  }
  const double solid = (48 * 40 - open) * c->grid.spacing.x * c->grid.spacing.z;
  // Circle of 12.3 mm cut at x = 0, 5 mm left of its axis.
  const double r = 0.0123;
  const double h = 0.005;
  const double exact =
      std::numbers::pi * r * r - (r * r * std::acos(h / r) - h * std::sqrt(r * r - h * h));
  CHECK(solid == test::approx(exact).epsilon(2e-4));

  Case box;
  box.cells = {10, 1, 10};
  box.fluid.density = 1;
  box.fluid.viscosity = 1e-5;
  for (auto& s : box.sides) s = slip();
  box.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.33}, Vec3{0, 0, 1}), 0.0));
  box.start();
  CHECK(box.solver->open_fraction()[box.grid.index(4, 0, 2)] == 0.0);
  CHECK(box.solver->open_fraction()[box.grid.index(4, 0, 3)] == test::approx(0.7).epsilon(1e-9));
  CHECK(box.solver->open_fraction()[box.grid.index(4, 0, 4)] == 1.0);
}

TEST_CASE("a moving wall shall drag along itself only and let nothing through") {
  const Vec3 given{0.3, -0.2, 0.8};
  const Vec3 n = Vec3{1, 2, 2} / 3;
  const double through = dot(given, n);
  Vec3 w;
  for (int d = 0; d < 3; ++d) w[d] = model::moving_wall::along(given[d], n[d], through);
  CHECK(std::abs(dot(w, n)) < 1e-15);
  CHECK(norm(sdk::cross(w - given, n)) < 1e-15);
}
