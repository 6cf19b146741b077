// SPDX-License-Identifier: Apache-2.0
#include "run/step_clock.hpp"

#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

TEST_CASE("a run shall have the whole steps that cover its end, rounding aside") {
  using dust::run::StepClock;
  const auto steps_of = [](double step, double end) {
    StepClock clock(step, end);
    while (!clock.is_finished()) clock.advance();
    return clock.steps_done();
  };
  CHECK(steps_of(0.1, 0.3) == 3);  // 0.3 / 0.1 is not 3 to the last bit
  CHECK(steps_of(1e-3, 2.5e-3) == 3);
  CHECK(steps_of(1e-3, 0.0) == 0);

  StepClock clock(0.25, 1.0);
  clock.advance();
  clock.advance();
  CHECK(clock.time() == 0.5);
  dust::test::MemoryArchive archive;
  clock.save(archive);
  StepClock resumed(0.25, 2.0);  // continued to a later end
  resumed.load(archive);
  CHECK(resumed.time() == 0.5);
  CHECK(resumed.steps_done() == 2);
  CHECK_FALSE(resumed.is_finished());
}
