// SPDX-License-Identifier: Apache-2.0
#include "sensor/coordination/coordination.hpp"

#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

using dust::test::approx;
using namespace dust::test;
using dust::sdk::Vec3;

TEST_CASE("the coordination number of a simple cubic block shall follow from its faces") {
  // n^3 grains: 3 n^2 (n - 1) contacts, Z = 6 (n - 1) / n; 6 n^2 wall contacts fill it up to 6.
  constexpr int n = 5;
  SyntheticScene world;
  const auto index = [](int i, int j, int k) { return i + n * (j + n * k); };
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        world.grains.push_back({});
        const int c[3] = {i, j, k};
        for (int d = 0; d < 3; ++d) {
          if (c[d] == 0) world.contacts.push_back({index(i, j, k), -1, {}, {}});
          if (c[d] == n - 1) {
            world.contacts.push_back({index(i, j, k), -1, {}, {}});
            continue;
          }
          world.contacts.push_back(
              {index(i, j, k), index(i + (d == 0), j + (d == 1), k + (d == 2)), {}, {}});
        }
      }
    }
  }
  const auto with = load_sensor("coordination").make({});
  step(*with, world);
  CHECK(summary_of(*with)["mean_at_end"] == approx(6.0).epsilon(1e-14));
  CHECK(summary_of(*with)["wall_contacts_per_grain_at_end"] == approx(6.0 / n).epsilon(1e-14));
  const auto without = load_sensor("coordination").make({{"with_walls", false}});
  step(*without, world);
  CHECK(summary_of(*without)["mean_at_end"] == approx(6.0 * (n - 1) / n).epsilon(1e-14));
  CHECK(summary_of(*without)["rattler_share_at_end"] == 0.0);
  const auto none = load_sensor("coordination").make({});
  SyntheticScene empty;
  step(*none, empty);
  CHECK(is_of_nothing(summary_of(*none).at("mean")));
}

TEST_CASE("grains without load shall not count in the mechanical coordination number") {
  // A ring of four (2 contacts each), one leaning on it by one contact, one free; one is within the
  // reach of a law without touching.
  SyntheticScene world;
  world.grains.resize(6);
  world.contacts = {{0, 1, {}, {}}, {1, 2, {}, {}}, {2, 3, {}, {}},
                    {3, 0, {}, {}}, {4, 0, {}, {}}, {5, 1, {}, {}, -1e-9}};
  const auto sensor = load_sensor("coordination").make({});
  step(*sensor, world);
  const Figures f = summary_of(*sensor);
  CHECK(f["mean_at_end"] == approx(10.0 / 6).epsilon(1e-14));
  CHECK(f["mechanical_at_end"] == approx((10.0 - 1) / (6 - 1 - 1)).epsilon(1e-14));
  CHECK(f["rattler_share_at_end"] == approx(2.0 / 6).epsilon(1e-14));
}
