// SPDX-License-Identifier: Apache-2.0
#include "unit/emitter/emitter_bench.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

TEST_CASE("single grains shall come as they are written, one entry standing for all") {
  const std::vector<Vec3> places{{0, 0, 1e-2}, {0, 0, 2e-2}};
  const auto single = emitter("single", {{"positions", places},
                                         {"diameters", std::vector<double>{1e-3}},
                                         {"velocities", std::vector<Vec3>{{0, 0, 1}, {0, 0, -2}}},
                                         {"rotations", std::vector<Vec3>{{5, 0, 0}}}});
  const auto requests = requests_of(*single);
  REQUIRE(requests.size() == 2);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(requests[n].position == places[n]);
    CHECK(requests[n].diameter == 1e-3);
    CHECK(requests[n].angular_velocity == Vec3{5, 0, 0});
  }
  CHECK(requests[1].velocity == Vec3{0, 0, -2});
  CHECK(single->largest_speed() == 2.0);
  CHECK(single->diameters() == std::vector<double>{1e-3});
  CHECK_FALSE(single->insertion_rule().waits);
}

TEST_CASE("lists that do not fit the number of grains shall be refused") {
  CHECK(refusal([] {
          emitter("single", {{"positions", std::vector<Vec3>(3)},
                             {"diameters", std::vector<double>{1e-3, 2e-3}}});
        }) == "diameters has 2 entries for 3 positions: give one for all, or one each");
}

TEST_CASE("grains shall come in the step that begins at their moment, however that is rounded") {
  for (const double step : {1e-3, 0.01, 0.1}) {
    for (int n = 0; n < 1000; ++n) {
      const double time = std::stod(std::to_string(n * step));  // as it is written
      const auto single = emitter("single", {{"positions", std::vector<Vec3>(1)},
                                             {"diameters", std::vector<double>{1e-3}},
                                             {"time", time}});
      std::vector<sdk::InsertionRequest> requests;
      for (int k = std::max(0, n - 1); k <= n; ++k) {
        CHECK(requests.empty());
        single->propose(context(k * step, k * step + step), requests);
      }
      CHECK(requests.size() == 1);
    }
  }
}
