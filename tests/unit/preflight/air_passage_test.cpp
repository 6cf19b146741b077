// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/air_passage.hpp"
#include "preflight/reader.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace dust;

TEST_CASE("air shall pass a side that it is driven through for a moment between even instants") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto passes = [&](const std::string& factors) {
    const auto read =
        preflight::read_scenario(std::string(DUST_SOURCE) + "/scenarios/plant/transfer_chute.yaml",
                                 {{"dust.hoods", "null"},
                                  {"domain.boundaries.top.air.times", "[0.11, 0.12, 0.13 s]"},
                                  {"domain.boundaries.top.air.factors", factors}},
                                 shipped);
    const preflight::SideModelSet sides(read.setup, shipped);
    return preflight::passes_air(read.setup, 5, sides.models());
  };
  CHECK(passes("[0, 1, 0]"));
  CHECK_FALSE(passes("[0, 0, 0]"));
}
