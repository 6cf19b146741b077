// SPDX-License-Identifier: Apache-2.0
#include "coupling/particle_states.hpp"

#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

namespace {

using namespace dust;
using coupling::ParticleStates;

test::Grains three_grains() {
  test::Grains grains;
  for (int n = 0; n < 3; ++n) grains.add({0.1 * n, 0, 0}, {0, 0, 0}, 1e-3);
  return grains;
}

}  // namespace

TEST_CASE("the state of a grain shall follow its id, and a new grain shall start empty") {
  test::Grains grains = three_grains();
  ParticleStates states;
  states.add_columns(2);
  states.align(grains.rows());
  for (std::size_t n = 0; n < 3; ++n) {
    states[n].size_ratio = 10.0 + static_cast<double>(n);
    states[n].stencil = static_cast<std::int32_t>(n);
    states.columns(n)[1] = 20.0 + static_cast<double>(n);
  }
  const std::uint64_t order = states.order();
  const std::vector<std::int32_t> then{0, 1, 2};
  CHECK(states.rows_now(order, then).empty());  // nothing has changed

  grains.swap(0, 2);
  grains.add({0.9, 0, 0}, {0, 0, 0}, 1e-3);
  states.align(grains.rows());
  CHECK(states.order() != order);
  CHECK(states.size() == 4);
  CHECK(states[0].size_ratio == 12.0);
  CHECK(states[2].size_ratio == 10.0);
  CHECK(states.columns(0)[1] == 22.0);
  CHECK(states[3].size_ratio == 1.0);
  CHECK(states.columns(3)[1] == 0.0);
  CHECK(states.rows_now(order, then) == std::vector<std::int32_t>{2, 1, 0});
}

TEST_CASE("the residual of a grain that is gone shall be kept at the place where it was last") {
  test::Grains grains = three_grains();
  ParticleStates states;
  states.align(grains.rows());
  states[2].deferred = {1.0, -2.0, 0.5};
  states[2].place = {0.2, 0.0, 0.0};
  states[2].stencil = 1;
  states[0].stencil = 0;
  const std::uint64_t order = states.order();
  grains.remove_last();
  grains.remove_last();  // this one has no residual
  states.align(grains.rows());
  REQUIRE(states.escaped().size() == 1);
  CHECK(states.escaped()[0].deferred == coupling::Triple{1.0, -2.0, 0.5});
  CHECK(states.escaped()[0].place == coupling::Triple{0.2, 0.0, 0.0});
  CHECK(states.rows_now(order, std::vector<std::int32_t>{0, 2}) ==
        std::vector<std::int32_t>{0, -1});
}
