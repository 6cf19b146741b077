// SPDX-License-Identifier: Apache-2.0
#include "run/dem_cycle.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <vector>

using dust::test::approx;

namespace {

/// What refreshes hold for, in steps, over one cycle.
std::vector<double> held_steps(dust::run::DemCycle& cycle, double dem_step) {
  std::vector<double> held;
  for (; !cycle.is_done(); cycle.advance()) {
    if (cycle.is_refresh_due()) held.push_back(cycle.refresh_held() / dem_step);
  }
  return held;
}

}  // namespace

TEST_CASE("refreshes shall cover a cycle without a gap, the last one for what is left") {
  constexpr double k_dem_step = 1e-5;
  dust::run::DemCycle cycle(1e-4, k_dem_step);  // ten steps
  cycle.begin(3.9e-5);
  const std::vector<double> held = held_steps(cycle, k_dem_step);
  REQUIRE(held.size() == 4);
  CHECK(held[0] == approx(3.0));
  CHECK(held[1] == approx(3.0));
  CHECK(held[2] == approx(3.0));
  CHECK(held[3] == approx(1.0));
  cycle.begin(3e-5);  // a whole number but for rounding
  CHECK(held_steps(cycle, k_dem_step).size() == 4);
  cycle.begin(1e-9);  // no more often than there are steps
  CHECK(held_steps(cycle, k_dem_step).size() == 10);
}

TEST_CASE("a cycle shall know its time and its last step") {
  dust::run::DemCycle cycle(1e-3, 2.5e-4);
  int steps = 0;
  for (cycle.begin(); !cycle.is_done(); cycle.advance()) {
    CHECK(cycle.time() == steps * 2.5e-4);
    CHECK(cycle.is_last_step() == (steps == 3));
    ++steps;
  }
  CHECK(steps == 4);
  // A step longer than the fluid's is one step.
  dust::run::DemCycle one(1e-3, 5e-3);
  one.begin();
  CHECK(one.is_last_step());
}
