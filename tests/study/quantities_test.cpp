// SPDX-License-Identifier: Apache-2.0
#include "study/quantities.hpp"
#include "preflight/reader.hpp"
#include "registry/registry.hpp"
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <map>
#include <set>

using namespace dust;
using dust::test::TemporaryFolder;

namespace {

/// Times of single nodes, facts of the build, rows of lists and what is told only of sides that
/// grains have left through are no quantities.
bool is_named(const std::string& path) {
  return !path.starts_with("timers_s.") && !path.starts_with("build.") &&
         !path.starts_with("health.grains_left.") && path.find(".requested.") == std::string::npos;
}

bool is_of_dust(const std::string& path) {
  return path.starts_with("dust_") || path.starts_with("hoods.") ||
         path.starts_with("stream_indices.");
}

}  // namespace

TEST_CASE("the quantities known before a run shall be those it tells") {
  registry::Registry registry;
  registry.load({DUST_TEST_PLUGINS});
  const TemporaryFolder folder;
  struct Case {
    std::string file;
    std::vector<std::string> settings;
  };
  const std::vector<Case> cases = {
      {DUST_SOURCE "/tests/study/drop.yaml", {}},
      {DUST_SOURCE "/tests/scenario/small_transfer.yaml",
       {"time.end=4 ms", "sensors.stream.steady_after=0 s", "sensors.lip.steady_after=0 s",
        "sensors.loose_dust.steady_after=0 s", "sensors.suction.averaging_after=0 s",
        "sensors.dust_out_below_belt.steady_after=0 s",
        "sensors.dust_out_above_belt.steady_after=0 s", "sensors.dust_out_right.steady_after=0 s",
        "sensors.dust_kept_in_stream.steady_after=0 s", "sensors.carry_back.steady_after=0 s",
        "sensors.dust_above_feed.steady_after=0 s"}},
      {DUST_SOURCE "/tests/scenario/small_hourglass.yaml",
       {"time.end=10 ms", "sensors.tray_load.averaging_after=0 s"}}};
  for (const Case& one : cases) {
    CAPTURE(one.file);
    std::vector<scenario::Override> overrides;
    std::vector<std::string> arguments = {"run",          one.file,  "-o",
                                          folder / "out", "--force", "--quiet"};
    for (const std::string& setting : one.settings) {
      const auto sign = setting.find('=');
      overrides.push_back({setting.substr(0, sign), setting.substr(sign + 1)});
      arguments.insert(arguments.end(), {"--set", setting});
    }
    const auto read = preflight::read_scenario(one.file, overrides, registry);
    std::set<std::string> known;
    for (const auto& q : study::quantities_of(read.setup, read.dust, registry))
      known.insert(q.path);
    const auto run = test::engine(arguments);
    INFO(run.err);
    REQUIRE(run.status == 0);
    std::set<std::string> reported;
    for (const auto& [path, figure] : study::read_figures(folder / "out" / "summary.json")) {
      if (is_named(path)) reported.insert(path);
    }
    for (const std::string& path : reported) CHECK_MESSAGE(known.contains(path), path);
    for (const std::string& path : known) CHECK_MESSAGE(reported.contains(path), path);
  }
}

TEST_CASE("what a run tells of dust shall be quantities of a study") {
  registry::Registry registry;
  registry.load({DUST_TEST_PLUGINS});
  const TemporaryFolder folder;
  for (const std::string name : {"dust_in_duct", "dust_at_hood", "dust_on_belt", "dusty_stream",
                                 "dusty_bounce", "rain_through_cloud", "dust_through_sides"}) {
    CAPTURE(name);
    const std::string file = DUST_SOURCE "/tests/scenario/" + name + ".yaml";
    const auto run = test::engine({"run", file, "-o", folder / name, "--quiet"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    const auto figures = study::read_figures(folder / name / "summary.json");
    const auto read = preflight::read_scenario(file, {}, registry);
    std::map<std::string, study::Quantity> known;
    for (const auto& q : study::quantities_of(read.setup, read.dust, registry)) {
      if (is_of_dust(q.path)) known[q.path] = q;
    }
    std::size_t compared = 0;
    for (const auto& [path, figure] : figures) {
      // Rates by class and what is estimated by rules are told beside.
      if (path.starts_with("dust_estimates") || path.find(".class.") != std::string::npos) continue;
      if (path == "dust_rates.observed" || path == "stream_indices.observed") continue;
      if (!is_of_dust(path)) continue;
      CHECK_MESSAGE(known.contains(path), path);
      ++compared;
    }
    CHECK(compared > 10);
    // Without a load, in all or in the steady stream, there is no figure per tonne of it.
    const bool is_fed = figures.at("mass_kg.emitted").value > 0.0;
    const bool is_fed_steadily = figures.contains("dust_rates.deposited.all.per_load");
    for (const auto& [path, quantity] : known) {
      const bool is_per_load =
          path.find("_per_kg") != std::string::npos || path.ends_with("g_per_tonne");
      if (is_per_load && !is_fed) continue;
      if (path.ends_with("per_load") && !is_fed_steadily) continue;
      // Nothing falls freely in some of them.
      if (path.starts_with("stream_indices.")) continue;
      CHECK_MESSAGE((figures.contains(path) ||
                     (!quantity.zero_beside.empty() && figures.contains(quantity.zero_beside))),
                    path);
    }
  }
}

TEST_CASE("rates of dust shall come with their errors") {
  const TemporaryFolder folder;
  const std::string file = DUST_SOURCE "/tests/scenario/dust_in_duct.yaml";
  const auto run = test::engine({"run", file, "-o", folder / "out", "--quiet"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto figures = study::read_figures(folder / "out" / "summary.json");
  CHECK(figures.at("dust_rates.left.right.rate").error >= 0.0);
  CHECK(study::unit_factor("mg/kg", "g/kg").value() == test::approx(1e-3));
}

TEST_CASE("units of quantities shall be converted where they measure the same") {
  CHECK(study::unit_factor("m", "mm").value() == test::approx(1000.0));
  CHECK(study::unit_factor("deg", "deg").value() == 1.0);
  CHECK(study::unit_factor("kg/s", "g/s").value() == test::approx(1000.0));
  CHECK_FALSE(study::unit_factor("m", "s").has_value());
}
