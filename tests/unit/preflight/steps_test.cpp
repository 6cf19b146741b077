// SPDX-License-Identifier: Apache-2.0
#include "preflight/derived.hpp"
#include "preflight/reader.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

using namespace dust;
using test::engine;
using test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path k_small = DUST_SOURCE "/tests/scenario/small_transfer.yaml";

const registry::Registry& shipped() {
  static registry::Registry registry;
  static const bool is_loaded = (registry.load({DUST_TEST_PLUGINS}), true);
  (void)is_loaded;
  return registry;
}

/// The scenarios that come with the engine; the rest of the files are studies of them.
std::vector<fs::path> shipped_scenarios() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(DUST_SOURCE "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().parent_path().filename() == "materials") continue;  // parts, to be included
    std::ifstream stream(entry.path());
    bool is_study = false;
    for (std::string line; std::getline(stream, line);) is_study |= line.starts_with("base:");
    if (!is_study) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What `engine check` says of a scenario.
Json reported(const fs::path& file, const std::vector<std::string>& settings = {}) {
  std::vector<std::string> arguments = {"check", file.string(), "--json"};
  for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
  const auto outcome = engine(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return Json::parse(outcome.out);
}

Json read_json(const fs::path& file) {
  std::ifstream stream(file);
  return Json::parse(stream);
}

/// The summary of a run that has made no step. The grains are put up as in any run; fluid and
/// sensors, which have no say in their steps, take time and are left out.
Json summary_without_a_step(scenario::Setup setup) {
  setup.fluid.reset();
  setup.sensors.clear();
  const run::Simulation simulation(setup, run::make_models(setup, shipped()));
  const TemporaryFolder folder;
  run::write_summary(folder / "", simulation, {});
  return read_json(folder / "summary.json");
}

void compare(const particles::TimeSteps& steps, const Json& summary) {
  CHECK(summary["dem_step_s"] == steps.coarse_step);
  REQUIRE(summary["size_classes"].size() == steps.classes.size());
  for (std::size_t n = 0; n < steps.classes.size(); ++n) {
    const Json& size = summary["size_classes"][n];
    CHECK(size["diameter_m"] == steps.classes[n].diameter);
    CHECK(size["rayleigh_time_s"] == steps.classes[n].rayleigh_time);
    CHECK(size["hertz_time_s"] == steps.classes[n].hertz_time);
    CHECK(size["stable_step_s"] == steps.classes[n].stable_step);
    CHECK(size["level"] == steps.classes[n].level);
  }
}

void compare(const Json& check, const Json& summary) {
  CHECK(check["largest_step_s"] == summary["dem_step_s"]);
  const Json& classes = summary["size_classes"];
  REQUIRE(check["size_classes"].size() == classes.size());
  double finest = summary["dem_step_s"];
  for (std::size_t n = 0; n < classes.size(); ++n) {
    for (const auto& [key, value] : check["size_classes"][n].items()) {
      CHECK_MESSAGE(value == classes[n][key], key);
    }
    const double step = summary["dem_step_s"];
    finest = std::min(finest, std::ldexp(step, -classes[n]["level"].get<int>()));
  }
  CHECK(check["smallest_step_s"] == finest);
}

}  // namespace

TEST_CASE("steps told before a run shall be those of its summary, for every shipped scenario") {
  const auto files = shipped_scenarios();
  REQUIRE(files.size() > 30);
  for (const fs::path& file : files) {
    CAPTURE(file);
    const scenario::Setup setup = preflight::read_scenario(file, {}, shipped()).setup;
    compare(preflight::derive_steps(setup, shipped()), summary_without_a_step(setup));
  }
}

TEST_CASE("a size of two materials shall be told the step of the one that needs the shorter") {
  // The 4 mm grains of the drum are stepped as the stiffest pair of grains that come to it needs.
  const Json check = reported(DUST_SOURCE "/scenarios/thesis/dosta_drum.yaml");
  const double step = check["size_classes"].back()["stable_step_s"];
  CHECK(step == test::approx(4.4e-6).epsilon(0.02));
}

TEST_CASE("check, log and summary of a run shall hold the same steps, to the last digit") {
  const TemporaryFolder folder;
  for (const char* setting :
       {"time.end=1 ms", "emitters.feed.enabled=false", "time.dem_step=1 us"}) {
    CAPTURE(setting);
    const std::vector<std::string> settings = {"time.end=1 ms", "time.output_every=1 ms", setting};
    std::vector<std::string> arguments = {
        "run", k_small.string(), "-o", (folder / "out").string(), "--quiet", "--force"};
    for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
    const auto outcome = engine(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const Json check = reported(k_small, settings);
    compare(check, read_json(folder / "out" / "summary.json"));

    const std::string log = test::read_file(folder / "out" / "run.log");
    std::smatch found;
    REQUIRE(std::regex_search(log, found, std::regex("time step (\\S+) s")));
    CHECK(std::stod(found[1]) == check["largest_step_s"]);
    const std::regex row("grains of (\\S+) m: stable step (\\S+) s, step (\\S+) s");
    std::size_t n = 0;
    double finest = check["largest_step_s"];
    for (auto at = std::sregex_iterator(log.begin(), log.end(), row); at != std::sregex_iterator();
         ++at, ++n) {
      REQUIRE(n < check["size_classes"].size());
      CHECK(std::stod((*at)[1]) == check["size_classes"][n]["diameter_m"]);
      CHECK(std::stod((*at)[2]) == check["size_classes"][n]["stable_step_s"]);
      finest = std::min(finest, std::stod((*at)[3]));
    }
    CHECK(n == check["size_classes"].size());
    CHECK(finest == check["smallest_step_s"]);
  }
}
