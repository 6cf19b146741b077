// SPDX-License-Identifier: Apache-2.0
// Flows through sides and into bodies that are given over time: what has passed is their integral.
#include "crossing_cylinder.hpp"
#include "fluid_case.hpp"
#include "support/approx.hpp"
#include "test_bodies.hpp"

#include "dust/sdk/table.hpp"
#include "fluid/step/time_mean.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace dust;
using namespace dust::test;

namespace {

constexpr double k_flow_step = 2e-3;  // [s]
/// Of the flow: the pressure is solved to 1e-11.
constexpr double k_passed_exact = 1e-8;

using Speed = std::function<double(double)>;

/// A channel along x: a given speed on the left, open on the right.
Case given_channel(const Speed& speed) {
  Case c;
  c.max = {0.2, 0.01, 0.05};
  c.cells = {40, 1, 10};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-3;
  c.fluid.pressure_tolerance = 1e-11;
  for (int s = 2; s < 6; ++s) c.sides[s] = s < 4 ? slip() : wall();
  c.sides[0] = wall();
  c.sides[0]->velocity = [speed](Vec3, double t) { return Vec3{speed(t), 0, 0}; };
  c.sides[1] = open_side(0.0, false);
  c.start();
  return c;
}

/// [m] What passed the faces of layer `i` in `steps` steps, over their area.
double passed(const Speed& speed, int i, int steps) {
  Case c = given_channel(speed);
  fluid::FaceField flow(c.grid);
  double sum = 0.0;
  for (int n = 0; n < steps; ++n) {
    c.advance(k_flow_step);
    c.solver->find_throughflow(flow);
    for (int k = 0; k < c.cells[2]; ++k) sum += flow.component[0][c.grid.index(i, 0, k)];
  }
  return k_flow_step * sum / c.cells[2];
}

/// Difference of the velocities 16 ms after a flow was switched on in the middle of a step from
/// those of one that was on from the beginning.
double difference_after_switching(double step) {
  const double on = 2.5 * step;
  const double after = 16e-3;
  Case switched = given_channel([on](double t) { return t > on ? 1.0 : 0.0; });
  switched.advance_to(2.0 * step, step);
  switched.advance_to(2.0 * step + after, step);
  Case begun = given_channel([](double) { return 1.0; });
  const int count = 31;
  for (int n = 0; n < count; ++n) begun.advance((switched.time - on) / count);
  double largest = 0.0;
  begun.each_face(0, [&](int i, int j, int k, Vec3, double u) {
    largest = std::max(largest, std::abs(u - switched.u(0, i, j, k)));
  });
  return largest;
}

}  // namespace

TEST_CASE("the mean of a table over time shall be that of its straight lines") {
  const sdk::Table table({1.0, 2.0, 4.0}, {0.0, 3.0, 1.0}, "times", "factors");
  CHECK(table.mean(0.0, 1.0) == 0.0);
  CHECK(table.mean(0.5, 2.0) == test::approx(1.0).epsilon(1e-15));          // 1.5 / 1.5
  CHECK(table.mean(1.5, 5.0) == test::approx(6.125 / 3.5).epsilon(1e-15));  // 1.125 + 4 + 1
  CHECK(table.mean(3.0, 3.0) == 2.0);
  const double value = 0.1;
  CHECK(sdk::Table({0.0, 0.3}, {value, value}, "times", "factors").mean(-0.7, 0.9) == value);
  CHECK(sdk::Table().mean(0.1, 0.7) == 1.0);
}

TEST_CASE("the mean over time shall be exact across kinks and jumps, and nothing where none is") {
  const auto mean = [](const Speed& f) {
    return fluid::time_mean({0.25, 1.25}, [&](double t) { return std::vector<double>{f(t)}; });
  };
  CHECK_FALSE(mean([](double) { return 0.1; }).has_value());
  const auto jump = mean([](double t) { return t > 0.6 ? 2.0 : 0.5; });
  REQUIRE(jump.has_value());
  CHECK(jump->front() == test::approx(0.35 * 0.5 + 0.65 * 2.0).epsilon(1e-9));
  const auto kink = mean([](double t) { return std::max(0.0, t - 0.9); });
  REQUIRE(kink.has_value());
  CHECK(kink->front() == test::approx(0.5 * 0.35 * 0.35).epsilon(1e-9));
  const auto wave = mean([](double t) { return std::sin(5.0 * t); });
  REQUIRE(wave.has_value());
  CHECK(wave->front() == test::approx((std::cos(1.25) - std::cos(6.25)) / 5.0).epsilon(1e-9));
}

TEST_CASE("what has passed a side of given flow shall be the integral of that flow") {
  const int steps = 10;
  const double end = steps * k_flow_step;
  // A jump within a step, a ramp that begins and ends within steps, one over the whole run.
  const double on = 7.3e-3;
  const sdk::Table ramp({3.1e-3, 12.4e-3}, {0.2, 1.0}, "times", "factors");
  for (const int layer : {0, 20, 40}) {
    CAPTURE(layer);
    const double jumped = passed([on](double t) { return t > on ? 1.0 : 0.0; }, layer, steps);
    CHECK(jumped == test::approx(end - on).epsilon(k_passed_exact));
    CHECK(passed(ramp, layer, steps) ==
          test::approx(end * ramp.mean(0.0, end)).epsilon(k_passed_exact));
    const double grown = passed([](double t) { return 50.0 * t; }, layer, steps);
    CHECK(grown == test::approx(25.0 * end * end).epsilon(k_passed_exact));
  }
}

TEST_CASE("a steady given flow shall pass as the velocity at the end of the step has it") {
  Case c = given_channel([](double) { return 0.7; });
  c.advance(k_flow_step);
  fluid::FaceField flow(c.grid);
  c.solver->find_throughflow(flow);
  c.each_face(0, [&](int i, int j, int k, Vec3, double u) {
    CHECK(flow.component[0][c.grid.index(i, j, k)] == u);
  });
}

TEST_CASE("what an opening in a body has drawn in shall be the integral of its flow") {
  const double flow = 3e-4;
  Case c;
  c.max = {0.1, 0.05, 0.1};
  c.cells = {12, 6, 12};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-11;
  for (auto& s : c.sides) s = wall();
  c.sides[5] = open_side(0.0, true);
  c.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0, 0, 0.031}, Vec3{0.1, 0, 1}), 0.0));
  // Switched off within the third step.
  c.bodies.back().suction = scenario::SuctionSpec{
      flow, {0.03, 0.01, 0.0}, {0.06, 0.04, 0.1}, {5.1e-3, 5.2e-3}, {1.0, 0.0}};
  c.start();
  fluid::FaceField passing(c.grid);
  double drawn = 0.0;
  double entered = 0.0;
  const double face = c.grid.spacing.x * c.grid.spacing.y;
  for (int n = 0; n < 5; ++n) {
    c.advance(k_flow_step);
    c.solver->find_throughflow(passing);
    c.solver->each_sink([&](std::int32_t, double rate, std::int32_t) {
      drawn += k_flow_step * rate * c.grid.cell_volume();
    });
    for (int j = 0; j < c.cells[1]; ++j) {
      for (int i = 0; i < c.cells[0]; ++i) {
        entered -= k_flow_step * face * passing.component[2][c.grid.index(i, j, c.cells[2])];
      }
    }
  }
  CHECK(drawn == test::approx(5.15e-3 * flow).epsilon(1e-12));
  CHECK(entered == test::approx(drawn).epsilon(k_passed_exact));
}

TEST_CASE("what has passed shall be the integral of the flow also where the grid is cut anew") {
  // A cylinder goes 1.3 cells a step: three cuts. The flow begins within the second of them.
  const double step = 2e-3;
  const double on = 0.5 * step;
  Case c;
  c.max = {0.06, 0.005, 0.06};
  c.cells = {24, 1, 24};
  c.fluid.density = 1.2;
  c.fluid.viscosity = 1.8e-5;
  c.fluid.pressure_tolerance = 1e-11;
  for (auto& s : c.sides) s = slip();
  c.sides[4]->velocity = [on](Vec3, double t) { return Vec3{0, 0, t > on ? 0.4 : 0.0}; };
  c.sides[5] = open_side(0.0, false);
  c.bodies.push_back(moving(std::make_unique<Cylinder>(Vec3{0.0203, 0, 0.0311}, 0.008, false),
                            Shift::steady({1.3 * 0.0025 / step, 0, 0})));
  c.start();
  fluid::FaceField flow(c.grid);
  double entered = 0.0;
  double left = 0.0;
  for (int n = 0; n < 3; ++n) {
    c.advance(step);
    c.solver->find_throughflow(flow);
    for (int i = 0; i < c.cells[0]; ++i) {
      entered += step * flow.component[2][c.grid.index(i, 0, 0)] / c.cells[0];
      left += step * flow.component[2][c.grid.index(i, 0, c.cells[2])] / c.cells[0];
    }
  }
  CHECK(entered == test::approx(0.4 * (3.0 * step - on)).epsilon(k_passed_exact));
  // The body's volume in cells, which changes by rounding its outline, has passed, too.
  CHECK(left == test::approx(entered).epsilon(0.05));
}

TEST_CASE(
    "the divergence of a step of several cuts shall be told of its end, also of ramped flows") {
  const double step = 2e-3;
  Case c = crossing_cylinder(step);
  c.fluid.pressure_tolerance = 1e-11;
  c.sides[4]->velocity = [](Vec3, double t) { return Vec3{0, 0, 100.0 * t}; };
  c.start();
  for (int n = 0; n < 3; ++n) {
    c.advance(step);
    CHECK(c.solver->report().divergence < 1e-5);  // of some 500 1/s that the body makes
  }
}

TEST_CASE("a flow switched on within a step shall act as from the middle of it, second order") {
  const double coarse = difference_after_switching(4e-3);
  const double fine = difference_after_switching(2e-3);
  MESSAGE("difference at steps of 4 and 2 ms: ", coarse, " ", fine);
  CHECK(coarse < 0.03);
  CHECK(order(coarse, fine) > 1.8);
}

TEST_CASE("the mean over time of numbers that vary like noise shall be found in bounded work") {
  int samples = 0;
  const dust::fluid::TimeFunction noise = [&](double time) {
    ++samples;
    const double hash = 43758.5453 * std::sin(12.9898e6 * time);
    return std::vector<double>{hash - std::floor(hash)};
  };
  const auto mean = dust::fluid::time_mean({0.0, 1.0}, noise);
  REQUIRE(mean.has_value());
  CHECK((*mean)[0] > 0.3);
  CHECK((*mean)[0] < 0.7);
  CHECK(samples < 5000);
}
