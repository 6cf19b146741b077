// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/sampling.hpp"
#include "run/snapshots/columns.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

using dust::sdk::Vec3;
using dust::test::approx;

namespace {

/// 20 mm long, periodic along x; open along y and z.
dust::scenario::DomainSpec domain() {
  dust::scenario::DomainSpec d;
  d.min = {0, 0, 0};
  d.max = {20e-3, 20e-3, 20e-3};
  for (const std::size_t side : {0, 1}) d.sides[side].grains = dust::scenario::GrainSide::periodic;
  return d;
}

}  // namespace

TEST_CASE("sensors shall see grains in the domain, also those that are not yet put back into it") {
  dust::run::GrainTable table(domain());
  dust::test::Grains grains;
  grains.add({19.9e-3, 5e-3, 5e-3}, {1, 0, 0}, 2e-3);
  grains.add({0.1e-3, -0.2e-3, 5e-3}, {-1, 0, 0}, 2e-3);
  table.note_insertions(grains.rows());
  table.publish(grains.rows(), {});
  // Both pass through; the solver puts them back later.
  grains.position[0] = 20.2e-3;
  grains.position[4] = -0.3e-3;
  table.publish(grains.rows(), {});
  dust::sdk::WorldView world;
  world.domain_min = domain().min;
  world.domain_max = domain().max;
  world.grains = table.columns();
  CHECK(world.grains.x[0] == approx(0.2e-3));
  CHECK(world.grains.x[1] == approx(19.7e-3));
  CHECK(world.grains.y[1] == -0.2e-3);  // an open side brings nothing back
  // Their ways are their own, and where they began lies in the domain too.
  CHECK(dust::sdk::path_of(world, 0).before.x == approx(-0.1e-3));
  CHECK(dust::sdk::path_of(world, 1).before.x == approx(20.1e-3));
  CHECK(dust::sdk::place_before(world, 0).x == approx(19.9e-3));
  CHECK(dust::sdk::place_before(world, 1).x == approx(0.1e-3));
  // Put back: no way at all, however far the solver moved them.
  grains.position[0] = 0.2e-3;
  grains.position[4] = 19.7e-3;
  table.publish(grains.rows(), {});
  world.grains = table.columns();
  for (const std::size_t n : {0, 1}) {
    const dust::sdk::Path way = dust::sdk::path_of(world, n);
    CHECK(norm(way.now - way.before) < 1e-15);
  }
}
