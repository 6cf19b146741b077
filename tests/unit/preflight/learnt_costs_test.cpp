// SPDX-License-Identifier: Apache-2.0
#include "preflight/learnt_costs.hpp"
#include "preflight/derived.hpp"
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <ctime>
#include <fstream>

using namespace dust;
using preflight::CostTerm;
using preflight::LearntCosts;

namespace {

/// Of one term alone.
preflight::RunCost one(CostTerm term, double amount, double seconds) {
  preflight::RunCost cost;
  cost.terms[term] = {amount, seconds};
  return cost;
}

double as_measured() { return 2.0; }

}  // namespace

TEST_CASE("a scenario's own runs shall tell its time, the newest five of them") {
  const Folder folder;
  const auto file = folder.path() / "cache" / "costs";
  // Twice the steps at three times the cost of each.
  LearntCosts(file, as_measured)
      .add("hopper", one(CostTerm::grains, 100.0, 10.0), one(CostTerm::grains, 200.0, 60.0));
  const auto estimated = one(CostTerm::grains, 50.0, 5.0);
  const auto first = LearntCosts(file, as_measured).expect("hopper", estimated);
  CHECK(first.is_of_scenario);
  CHECK(first.runs == 1);
  CHECK(first.cost.terms[CostTerm::grains].amount == test::approx(100.0));
  CHECK(first.cost.terms[CostTerm::grains].seconds == test::approx(30.0));
  for (int n = 1; n <= 5; ++n) {
    LearntCosts(file, as_measured)
        .add("hopper", one(CostTerm::grains, 10.0, 10.0), one(CostTerm::grains, 10.0, 10.0 * n));
  }
  const auto last = LearntCosts(file, as_measured).expect("hopper", estimated);
  CHECK(last.runs == 5);
  CHECK(last.cost.terms[CostTerm::grains].seconds == test::approx(3.0 * 5.0));
}

TEST_CASE("runs that end together shall both be learnt from") {
  const Folder folder;
  const auto file = folder.path() / "costs";
  const auto estimated = one(CostTerm::grains, 10.0, 10.0);
  LearntCosts first(file, as_measured), second(file, as_measured);
  first.add("hopper", estimated, one(CostTerm::grains, 10.0, 20.0));
  second.add("hopper", estimated, one(CostTerm::grains, 10.0, 30.0));
  CHECK(LearntCosts(file, as_measured).expect("hopper", estimated).runs == 2);
}

TEST_CASE("runs about as long as one shall tell its time, not the first moments of the scenario") {
  // A stream that has not arrived yet is cheap; one that has is six times as dear as estimated.
  LearntCosts costs({}, as_measured);
  const auto whole = one(CostTerm::fluid, 4000.0, 400.0);
  const auto beginning = one(CostTerm::fluid, 100.0, 10.0);
  costs.add("belt", whole, one(CostTerm::fluid, 12000.0, 2400.0));
  for (int n = 0; n < 7; ++n) costs.add("belt", beginning, one(CostTerm::fluid, 100.0, 10.0));
  const auto expected = costs.expect("belt", whole);
  CHECK(expected.cost.terms[CostTerm::fluid].amount == test::approx(12000.0));
  CHECK(expected.cost.terms[CostTerm::fluid].seconds == test::approx(2400.0));
  CHECK(costs.expect("belt", beginning).cost.terms[CostTerm::fluid].seconds == test::approx(10.0));
  // Where none is as long, the longest say more than the first moments do.
  const auto longer = one(CostTerm::fluid, 16000.0, 1600.0);
  CHECK(costs.expect("belt", longer).cost.terms[CostTerm::fluid].seconds == test::approx(9600.0));
}

TEST_CASE("other scenarios shall tell the rate of each term, not how much work there is") {
  const Folder folder;
  const auto file = folder.path() / "costs";
  LearntCosts costs(file, as_measured);
  // Ten times the steps that were estimated, at half the estimated cost of each; the fluid four
  // times as slow.
  preflight::RunCost estimated = one(CostTerm::grains, 100.0, 10.0);
  estimated.terms[CostTerm::fluid] = {1000.0, 1.0};
  preflight::RunCost taken = one(CostTerm::grains, 1000.0, 50.0);
  taken.terms[CostTerm::fluid] = {1000.0, 4.0};
  for (int n = 0; n < 3; ++n) costs.add("belt", estimated, taken);
  preflight::RunCost other = one(CostTerm::grains, 10.0, 8.0);
  other.terms[CostTerm::fluid] = {10.0, 3.0};
  other.terms[CostTerm::output] = {10.0, 1.0};
  const auto expected = costs.expect("chute", other);
  CHECK_FALSE(expected.is_of_scenario);
  CHECK(expected.runs == 3);
  // Medians of three runs and the measurement's 2: (0.5, 0.5, 0.5, 2) and (2, 4, 4, 4).
  CHECK(expected.cost.terms[CostTerm::grains].seconds == test::approx(0.5 * 8.0));
  CHECK(expected.cost.terms[CostTerm::grains].amount == test::approx(10.0));
  CHECK(expected.cost.terms[CostTerm::fluid].seconds == test::approx(4.0 * 3.0));
  // No run has written files for long enough to tell.
  CHECK(expected.cost.terms[CostTerm::output].seconds == test::approx(2.0 * 1.0));
}

TEST_CASE("memory and disk shall be learnt from a scenario's own runs alone") {
  LearntCosts costs({}, as_measured);
  preflight::RunCost estimated = one(CostTerm::grains, 1.0, 1.0);
  estimated.memory_bytes = 100.0;
  estimated.disk_bytes = 10.0;
  preflight::RunCost taken = estimated;
  taken.memory_bytes = 150.0;
  taken.disk_bytes = 5.0;
  costs.add("belt", estimated, taken);
  CHECK(costs.expect("belt", estimated).cost.memory_bytes == test::approx(150.0));
  CHECK(costs.expect("belt", estimated).cost.disk_bytes == test::approx(5.0));
  CHECK(costs.expect("chute", estimated).cost.memory_bytes == 100.0);
}

TEST_CASE("a machine without runs shall be measured, and a spoilt cache shall not matter") {
  const Folder folder;
  const std::string without_estimate =
      "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 5 5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 hopper\n";
  const auto file =
      folder.write("costs", "nonsense\n0.5 chute\n\n-1 2 3 hopper\n" + without_estimate);
  const auto estimated = one(CostTerm::grains, 10.0, 10.0);
  const auto spoilt = LearntCosts(file, as_measured).expect("hopper", estimated);
  CHECK(spoilt.runs == 0);
  CHECK(spoilt.cost.terms.seconds() == test::approx(20.0));
  const double slowness = preflight::measured_slowness();
  CHECK(slowness > 0.1);
  CHECK(slowness < 10.0);
  // A cache that cannot be written is none.
  LearntCosts(file / "below", as_measured).add("hopper", estimated, estimated);
}

TEST_CASE("what is written of a run shall be read as it was") {
  const Folder folder;
  const auto file = folder.path() / "costs";
  preflight::RunCost estimated;
  for (std::size_t n = 0; n < preflight::k_cost_terms; ++n) {
    estimated.terms[n] = {1.0 + static_cast<double>(n), 3.0 + static_cast<double>(n)};
  }
  estimated.memory_bytes = 7.0;
  estimated.disk_bytes = 9.0;
  LearntCosts(file, as_measured).add("my chute", estimated, estimated);
  const auto expected = LearntCosts(file, as_measured).expect("my chute", estimated);
  REQUIRE(expected.is_of_scenario);
  CHECK(expected.cost.terms.seconds() == test::approx(estimated.terms.seconds()));
  CHECK(expected.cost.memory_bytes == 7.0);
  CHECK(expected.cost.disk_bytes == 9.0);
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
