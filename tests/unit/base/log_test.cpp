// SPDX-License-Identifier: Apache-2.0
#include "base/log.hpp"

#include "support/engine.hpp"

#include <doctest/doctest.h>

TEST_CASE("a line shall stand in the log as soon as it is logged") {
  // Who follows a run reads it while the run goes on; of one that was killed it is all there is.
  const dust::test::TemporaryFolder folder;
  dust::base::log_to_file(folder / "run.log", false);
  dust::base::log_info("t = 0.05 s: 2166 grains");
  CHECK(dust::test::read_file(folder / "run.log").ends_with(" info t = 0.05 s: 2166 grains\n"));
}
