// SPDX-License-Identifier: Apache-2.0
#include "verification/bulk/bulk_run.hpp"

// Each contact of a grain damps its spin; with many neighbours and a low restitution the sum of
// these rates passes what one time step can resolve, and the bed would shiver for ever: 3e-10 J a
// grain, nearly all of it rotation, whatever the time.
TEST_CASE("a bed of low restitution shall come to rest at the default step") {
  const dust::test::BulkRun run("janssen", {"interactions[0].contact.restitution=0.3",
                                            "interactions[1].contact.restitution=0.3",
                                            "time.end=0.2 s", "bodies.floor.start=1 s"});
  // A thousandth of a grain's weight (1.3e-6 kg) times its diameter; about 4e-13 J are left by now.
  CHECK(run.figure("energy", "mean_per_grain_at_end") < 1e-3 * 1.3e-6 * 9.81 * 1e-3);
}
