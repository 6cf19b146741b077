// SPDX-License-Identifier: Apache-2.0
#include "run/entry.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace {

using namespace dust;
using particles::NewGrain;

constexpr double k_diameter = 4e-4;  // [m]

NewGrain grain(double x, double diameter = k_diameter) {
  NewGrain g;
  g.position = {x, 0.0, 0.0};
  g.velocity = {0.0, 0.0, -0.15};
  g.diameter = diameter;
  return g;
}

/// Grains in the domain, as the rows of the DEM.
struct Present {
  std::vector<double> position;
  void add(double x, double diameter = k_diameter) {
    position.insert(position.end(), {x, 0.0, 0.0, 0.5 * diameter});
  }
  [[nodiscard]] particles::GrainRows rows() const {
    particles::GrainRows rows;
    rows.count = position.size() / 4;
    rows.position = position.data();
    return rows;
  }
};

}  // namespace

TEST_CASE("grains shall enter in their order where nothing is in the way") {
  std::vector<NewGrain> waiting{grain(2e-3), grain(0.0), grain(1e-3)};
  const auto entering = run::take_free_places(waiting, {});
  REQUIRE(entering.size() == 3);
  CHECK(entering[0].position.x == 2e-3);
  CHECK(entering[1].position.x == 0.0);
  CHECK(waiting.empty());
}

TEST_CASE("a grain shall wait for as long as one in the domain touches its place") {
  std::vector<NewGrain> waiting{grain(0.0), grain(1e-3)};
  Present present;
  present.add(0.99 * k_diameter);
  auto entering = run::take_free_places(waiting, present.rows());
  REQUIRE(entering.size() == 1);
  CHECK(entering[0].position.x == 1e-3);
  REQUIRE(waiting.size() == 1);
  present.position[0] = 1.01 * k_diameter;
  entering = run::take_free_places(waiting, present.rows());
  REQUIRE(entering.size() == 1);
  CHECK(entering[0].position.x == 0.0);
  CHECK(waiting.empty());
}

TEST_CASE("of two entering grains that touch the first shall enter and the second wait") {
  std::vector<NewGrain> waiting{grain(0.0), grain(0.9 * k_diameter)};
  const auto entering = run::take_free_places(waiting, {});
  REQUIRE(entering.size() == 1);
  CHECK(entering[0].position.x == 0.0);
  REQUIRE(waiting.size() == 1);
  CHECK(waiting[0].position.x == 0.9 * k_diameter);
}

TEST_CASE("a large grain beyond the box of the waiting centres shall be seen") {
  std::vector<NewGrain> waiting{grain(0.0, 1e-5)};
  Present present;
  present.add(9e-4, 2e-3);
  CHECK(run::take_free_places(waiting, present.rows()).empty());
  CHECK(waiting.size() == 1);
}

TEST_CASE("waiting grains shall come back from a checkpoint as they were") {
  std::vector<NewGrain> waiting{grain(0.0), grain(1e-3, 1e-5)};
  waiting[1].weight = 0.05;
  waiting[1].material = 2;
  test::MemoryArchive archive;
  run::save_waiting(waiting, archive);
  std::vector<NewGrain> loaded{grain(7.0)};
  run::load_waiting(loaded, archive);
  REQUIRE(loaded.size() == 2);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(loaded[n].position == waiting[n].position);
    CHECK(loaded[n].velocity == waiting[n].velocity);
    CHECK(loaded[n].diameter == waiting[n].diameter);
    CHECK(loaded[n].weight == waiting[n].weight);
    CHECK(loaded[n].material == waiting[n].material);
  }
}
