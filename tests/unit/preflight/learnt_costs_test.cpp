// SPDX-License-Identifier: Apache-2.0
#include "preflight/learnt_costs.hpp"
#include "preflight/derived.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <ctime>
#include <fstream>

using namespace dust;
using preflight::LearntCosts;

TEST_CASE("what runs cost shall be learnt by scenario, the newest five of it, else by all others") {
  const Folder folder;
  const auto file = folder.path() / "cache" / "costs";
  LearntCosts(file).add("hopper", 100.0, 20.0);
  LearntCosts(file).add("chute", 10.0, 30.0);
  LearntCosts(file).add("my chute", 10.0, 10.0);
  const LearntCosts costs(file);
  CHECK(costs.factor_for("hopper").value == doctest::Approx(0.2));
  CHECK(costs.factor_for("hopper").is_of_scenario);
  CHECK(costs.factor_for("my chute").value == doctest::Approx(1.0));
  // The median of 0.2, 1 and 3.
  CHECK(costs.factor_for("belt").value == doctest::Approx(1.0));
  CHECK(costs.factor_for("belt").runs == 3);
  CHECK_FALSE(costs.factor_for("belt").is_of_scenario);
  for (int n = 0; n < 5; ++n) LearntCosts(file).add("hopper", 10.0, 10.0 * (n + 1));
  CHECK(LearntCosts(file).factor_for("hopper").value == doctest::Approx(3.0));
  CHECK(LearntCosts(file).factor_for("hopper").runs == 5);
}

TEST_CASE("a machine without runs shall be measured, and a spoilt cache shall not matter") {
  const Folder folder;
  const auto file = folder.write("costs", "nonsense\n-1 hopper\n0.5 chute\n\n");
  CHECK(LearntCosts(file).factor_for("hopper").value == doctest::Approx(0.5));
  const auto measured = LearntCosts(folder.path() / "none").factor_for("hopper");
  CHECK(measured.runs == 0);
  CHECK(measured.value > 0.1);
  CHECK(measured.value < 10.0);
  // A cache that cannot be written is none.
  LearntCosts(folder.path() / "costs" / "below").add("hopper", 1.0, 1.0);
}

TEST_CASE("an estimate shall come within a second where no run could follow the grains") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const Folder folder;
  std::string text = text_of(std::string(DUST_SOURCE) + "/scenarios/transfer_point.yaml");
  const auto file = folder.write("wide.yaml", text);
  for (const std::string smallest : {"0.05 mm", "0.5 mm"}) {
    const std::string feed =
        "{model: feed, material: sand, mass_flow: 500 t/h, min: [0, 0, 300 mm], max: [0.3, 3, 0.3 "
        "m], velocity: [0, 0, -2], distribution: rosin_rammler, characteristic_diameter: 20 mm, "
        "exponent: 1, smallest: " +
        smallest + ", largest: 60 mm}";
    const auto setup = preflight::read_scenario(file,
                                                {{"emitters", "{wide: " + feed + "}"},
                                                 {"fluid", "none"},
                                                 {"domain.max", "[330, 3000, 350 mm]"}},
                                                shipped)
                           .setup;
    // Of the processor, which others may share.
    const std::clock_t begin = std::clock();
    const auto derived = preflight::derive(setup, shipped);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    CAPTURE(smallest);
    CHECK(seconds < 1.0);
    CHECK(derived.emissions[0].real_per_second > 1e5);
    CHECK(derived.emissions[0].computed_per_second >= derived.emissions[0].real_per_second * 0.99);
  }
}
