// SPDX-License-Identifier: Apache-2.0
#include "preflight/slope_drain.hpp"

#include "preflight/derived.hpp"
#include "preflight/reader.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;

namespace {

preflight::SlopeDrain drain_of(const std::vector<scenario::Override>& set) {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto file = std::string(DUST_SOURCE) + "/scenarios/thesis/container_periodic_8.yaml";
  const auto setup = preflight::read_scenario(file, set, shipped).setup;
  return preflight::derive(setup, shipped).drain;
}

}  // namespace

TEST_CASE("what has left shall be the integral's derivative, and tend to its share") {
  const preflight::SlopeDrain drain{0.2, 0.4, 0.1};
  CHECK(drain.left(0.2) == 0.0);
  CHECK(drain.absent(0.1) == 0.0);
  // 0.4 (1 - 1/e) after one of its times, and all but 5e-5 after ten.
  CHECK(drain.left(0.3) == test::approx(0.25284822353142307).epsilon(1e-12));
  CHECK(drain.left(1.2) == test::approx(0.4).epsilon(1e-4));
  // 0.4 (0.1 - 0.1 (1 - 1/e)).
  CHECK(drain.absent(0.3) == test::approx(0.014715177646857694).epsilon(1e-12));
  const double h = 1e-5;  // [s]; the error of the quotient is of its square
  CHECK((drain.absent(0.5 + h) - drain.absent(0.5 - h)) / (2.0 * h) ==
        test::approx(drain.left(0.5)).epsilon(1e-8));
}

TEST_CASE("a bed whose side wall is taken away shall run out as the thesis's container does") {
  const preflight::SlopeDrain drain = drain_of({});
  CHECK(drain.begin == 0.15);
  // The run of it at 5 MPa: of 47,877 grains 36,411, 28,733 and 23,844 were left. The time was
  // fitted to them, the share was not.
  CHECK(drain.left(0.27) == test::approx(1.0 - 36411.0 / 47877.0).epsilon(0.15));
  CHECK(drain.left(0.45) == test::approx(1.0 - 28733.0 / 47877.0).epsilon(0.1));
  CHECK(drain.left(0.855) == test::approx(1.0 - 23844.0 / 47877.0).epsilon(0.1));
}

TEST_CASE("a bed shall stay where no wall of it is taken away before an open side") {
  CHECK(drain_of({}).share > 0.4);
  CHECK(drain_of({{"domain.boundaries.right", "{grains: wall, material: plexiglass}"}}).share ==
        0.0);
  // Half as high, or a wall that leaves a gap of 1 mm.
  CHECK(drain_of({{"bodies.side.max", "[41, 20, 10 mm]"}}).share == 0.0);
  CHECK(drain_of({{"bodies.side.min", "[38, -1, -1 mm]"}, {"bodies.side.max", "[39, 20, 100 mm]"}})
            .share == 0.0);
  CHECK(drain_of({{"gravity", "[3 m/s2, 0, -9 m/s2]"}}).share == 0.0);
}

TEST_CASE("a bed shall run out from the time at which its wall is taken away") {
  CHECK(drain_of({{"bodies.side.remove", "{at: 0.1 s}"}}).begin == 0.1);
}

TEST_CASE("two fillings shall run out as one bed") {
  // Half each of what lies there; slopes of its own would leave more of each.
  const std::string half =
      "{model: fill, material: sand, min: [0, 0, 0], max: [40, 4, 35 mm], mass: 3.672 g, "
      "diameters: "
      "[500 um], mass_fractions: [1]}";
  const double whole = drain_of({}).share;
  CHECK(drain_of({{"emitters.bed.mass", "3.672 g"}, {"emitters.more", half}}).share ==
        test::approx(whole).epsilon(0.01));
}

TEST_CASE("a high bed shall leave a slope that ends at the far wall") {
  // 160 mm of sand on 40 mm: what stays is the half of 0.75 x 40 mm, 15 mm.
  const preflight::SlopeDrain low = drain_of({});
  const preflight::SlopeDrain high = drain_of({{"domain.max", "[40, 4, 450 mm]"},
                                               {"bodies.side.max", "[41, 20, 500 mm]"},
                                               {"emitters.bed.max", "[40, 4, 400 mm]"},
                                               {"emitters.bed.mass", "40 g"}});
  const double height = 40e-3 / 2653.0 / 0.58 / (40e-3 * 4e-3);
  CHECK(high.share == test::approx(1.0 - 0.5 * 0.75 * 40e-3 / height).epsilon(0.01));
  CHECK(high.time == low.time);
}
