// SPDX-License-Identifier: Apache-2.0
#include "coupling/refresh_schedule.hpp"

#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

namespace {

using dust::coupling::RefreshSchedule;
using dust::test::approx;
using dust::test::MemoryArchive;

constexpr double k_step = 1e-3;
constexpr double k_spacing = 1e-3;  // 16 crossings of 1/8 cell at 2 m/s in a step

}  // namespace

TEST_CASE("refreshes shall be due by relaxation or by crossing, whichever is sooner, 1 to 64") {
  RefreshSchedule fine(k_step, k_spacing);
  CHECK(fine.interval() == approx(k_step / 16));
  fine.begin_step(k_step, 5e3);  // a quarter of 0.2 ms: 20
  CHECK(fine.interval() == approx(k_step / 20));
  fine.begin_step(k_step, 1e9);
  CHECK(fine.interval() == approx(k_step / 64));
  fine.begin_step(k_step / 4, 0.0);
  CHECK(fine.interval() == approx(k_step / 16));
  CHECK(fine.fluid_step() == k_step / 4);

  RefreshSchedule coarse(k_step, 1.0);
  CHECK(coarse.interval() == k_step);
  coarse.begin_step(k_step, 4.1 / (4.0 * k_step));  // not a whole number: one more
  CHECK(coarse.interval() == approx(k_step / 5));
}

TEST_CASE("a schedule shall know the first refresh of a step, and how long the last one held") {
  RefreshSchedule schedule(k_step, k_spacing);
  schedule.begin_step(k_step, 0.0);
  CHECK(schedule.is_first());
  CHECK(schedule.last_held() == 0.0);
  for (int n = 0; n < 4; ++n) schedule.note(2e-5);
  CHECK_FALSE(schedule.is_first());
  schedule.begin_step(k_step, 0.0);
  CHECK(schedule.is_first());
  CHECK(schedule.last_held() == 2e-5);  // the one before the step's first
}

TEST_CASE("a resumed schedule shall have the interval and what the last refresh held for") {
  RefreshSchedule schedule(k_step, k_spacing);
  schedule.begin_step(k_step / 2, 5e4);
  schedule.note(3e-6);
  MemoryArchive archive;
  schedule.save(archive);
  RefreshSchedule other(k_step, k_spacing);
  other.load(archive);
  CHECK(other.interval() == schedule.interval());
  CHECK(other.fluid_step() == schedule.fluid_step());
  CHECK(other.last_held() == 3e-6);
}
