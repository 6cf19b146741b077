// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary.hpp"

#include <doctest/doctest.h>

using dust::run::PlantBegin;
using Way = PlantBegin::Key::Way;

TEST_CASE("what a plant began with shall be known by way, name and class, whatever their letters") {
  PlantBegin begin;
  begin.counted = {{{Way::hood, "hood"}, 1.0},
                   {{Way::outlet, "hood", "5_um"}, 2.0},
                   {{Way::outlet, "hood/5_um", ""}, 3.0},
                   {{Way::cause, "belt", "5_um"}, 4.0}};
  CHECK(begin.mass_of({Way::hood, "hood"}) == 1.0);
  CHECK(begin.mass_of({Way::outlet, "hood", "5_um"}) == 2.0);
  CHECK(begin.mass_of({Way::outlet, "hood/5_um"}) == 3.0);
  CHECK(begin.mass_of({Way::cause, "belt", "5_um"}) == 4.0);
  // What was not there had nothing.
  CHECK(begin.mass_of({Way::cause, "hood", "5_um"}) == 0.0);
  CHECK(begin.mass_of({Way::outlet, "hood", "10_um"}) == 0.0);
}
