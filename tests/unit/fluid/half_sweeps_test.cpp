// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum/half_sweeps.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <vector>

using namespace dust::fluid;

namespace {

/// How many half sweeps each row has gone through, and whether one came at a wrong time.
struct Progress {
  Progress(int rows_per_plane, int planes)
      : n1(rows_per_plane), n2(planes), done(static_cast<std::size_t>(n1) * n2) {}

  void take(int half, int j, int k) {
    std::atomic<int>& own = done[static_cast<std::size_t>(k) * n1 + j];
    if (own.exchange(half + 1) != half) is_wrong = true;
    // The other colour around: as the half sweep before left it, not as the next one will.
    for (const int z : {k - 1, k + 1}) {
      if (z < 0 || z >= n2) continue;
      const int beside = done[static_cast<std::size_t>(z) * n1 + j];
      if (beside < half || beside > half + 1) is_wrong = true;
    }
  }

  int n1, n2;
  std::vector<std::atomic<int>> done;
  std::atomic<bool> is_wrong{false};
};

}  // namespace

TEST_CASE("half sweeps in slabs shall see around a plane what sweeps over all planes see") {
  for (const int threads : {1, 2, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (const int halves : {2, 4, 6, 12, 40}) {
      for (const int planes : {1, 2, 7, 63, 64, 65, 129, 280}) {
        CAPTURE(threads);
        CAPTURE(halves);
        CAPTURE(planes);
        Progress progress(2, planes);
        // Rows so long that threads share them.
        for_half_sweeps(halves, 20000, 2, planes,
                        [&](int half, int j, int k) { progress.take(half, j, k); });
        CHECK(!progress.is_wrong);
        for (const auto& done : progress.done) REQUIRE(done == halves);
      }
    }
  }
}

TEST_CASE("slabs shall be thick enough for their half sweeps, and one for each thread or none") {
  CHECK(SweepSlabs(6, 280, 1).count() == 4);
  CHECK(SweepSlabs(6, 280, 8).count() >= 8);
  CHECK(SweepSlabs(6, 280, 64).count() == 280 / 13);  // fewer than threads: not used
  CHECK(SweepSlabs(100, 64, 1).count() == 1);
}
