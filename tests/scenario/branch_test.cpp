// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/small_transfer.yaml";

/// Runs a scenario and returns what the engine says.
dust::test::Outcome run(const fs::path& out, const std::string& end,
                        const std::vector<std::string>& settings = {},
                        const std::string& threads = "1",
                        const std::string& scenario = k_scenario) {
  std::vector<std::string> arguments{
      "run", scenario, "-o", out, "--set", "time.end=" + end, "--threads", threads, "--quiet"};
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  return engine(arguments);
}

std::string digest(const fs::path& out) { return json_text(out / "summary.json", "state_sha256"); }

/// The last row of the series.
std::string last_row(const fs::path& out) {
  const std::string text = read_file(out / "series.csv");
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

/// A box of 20 x 20 x 40 mm, open but for its bottom, with the rest of its scenario.
void write_box(const fs::path& file, const std::string& rest) {
  std::ofstream(file) << R"(name: box
domain:
  min: [0, 0, 0]
  max: [20, 20, 40 mm]
  boundaries:
    left: {grains: open}
    right: {grains: open}
    front: {grains: open}
    back: {grains: open}
    bottom: {grains: wall, material: sand}
    top: {grains: open}
materials:
  sand: {density: 2650, young_modulus: 5 MPa, poisson_ratio: 0.3}
fluid: none
)" << rest;
}

}  // namespace

TEST_CASE(
    "a run that starts from its own scenario's state shall have the bits of an unbroken one") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "whole", "24 ms").status == 0);
  REQUIRE(run(folder / "first", "14 ms", {}, "2").status == 0);
  const std::string from = "start_from=" + (folder / "first").string();
  for (const std::string threads : {"1", "2"}) {
    CAPTURE(threads);
    const fs::path out = folder / ("branch" + threads);
    const auto branch = run(out, "24 ms", {from, "time.output_every=5 ms"}, threads);
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    CHECK(digest(out) == digest(folder / "whole"));
    CHECK(last_row(out) == last_row(folder / "whole"));
    CHECK(json_text(out / "summary.json", "is_same_scenario") == "true");
  }
  // With a sensor less and another one more: what is there does not know of it.
  const auto other =
      run(folder / "sensor", "24 ms",
          {from, "sensors.lip.enabled=false", "sensors.more={model: kinetic_energy}"});
  INFO(other.err);
  REQUIRE(other.status == 0);
  CHECK(digest(folder / "sensor") == digest(folder / "whole"));
}

TEST_CASE("a run that started from another shall be resumed, also where that one is gone") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(run(first, "12 ms").status == 0);
  const std::vector<std::string> settings{"start_from=" + first.string(),
                                          "bodies.belt.speed=0.5 m/s"};
  REQUIRE(run(folder / "whole", "20 ms", settings).status == 0);
  REQUIRE(run(folder / "threads", "20 ms", settings, "2").status == 0);
  CHECK(digest(folder / "threads") == digest(folder / "whole"));
  REQUIRE(run(folder / "parts", "16 ms", settings).status == 0);
  fs::remove_all(first);
  const auto resumed = engine({"run", k_scenario, "-o", folder / "parts", "--set", "time.end=20 ms",
                               "--set", settings[0], "--set", settings[1], "--resume", "--quiet"});
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  CHECK(digest(folder / "parts") == digest(folder / "whole"));
}

TEST_CASE("grains shall be let in where the other run has taken a body away") {
  const TemporaryFolder folder;
  const fs::path scenario = folder / "plug.yaml";
  write_box(scenario,
            "time: {end: 40 ms, fluid_step: 1 ms, output_every: 10 ms}\n"
            "gravity: [0, 0, -9.81]\n"
            "interactions:\n"
            "  - between: [sand, sand]\n"
            "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.3}\n"
            "bodies:\n"
            "  plug: {shape: box, material: sand, min: [0, 0, 0], max: [20, 20, 5 mm], remove: "
            "{at: 5 ms}}\n"
            "emitters:\n"
            "  one: {model: single, material: sand, positions: [[10, 10, 6.1 mm]], diameters: [2 "
            "mm]}\n");
  // Fallen half into what was the plug.
  REQUIRE(run(folder / "first", "30 ms", {}, "1", scenario).status == 0);
  const std::vector<std::string> settings = {"start_from=" + (folder / "first").string(),
                                             "interactions[0].contact.restitution=0.6"};
  const auto branch = run(folder / "branch", "40 ms", settings, "1", scenario);
  INFO(branch.err);
  CHECK(branch.status == 0);
  const auto check = engine({"check", scenario, "--set", settings[0], "--set", settings[1]});
  INFO(check.err);
  CHECK(check.status == 0);
}

TEST_CASE("springs kept by the conventions of LIGGGHTS shall hold on by those of this engine") {
  const TemporaryFolder folder;
  const fs::path scenario = folder / "slope.yaml";
  write_box(scenario,
            "time: {end: 60 ms, fluid_step: 1 ms, output_every: 10 ms}\n"
            "gravity: [2, 0, -9.81]\n"
            "interactions:\n"
            "  - between: [sand, sand]\n"
            "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.8, tangential: "
            "liggghts}\n"
            "    rolling: {model: epsd2, friction: 0.8}\n"
            "emitters:\n"
            "  one: {model: single, material: sand, positions: [[10, 10, 1 mm]], diameters: [2 "
            "mm]}\n");
  REQUIRE(run(folder / "first", "60 ms", {}, "1", scenario).status == 0);
  const auto branch = run(folder / "branch", "65 ms",
                          {"start_from=" + (folder / "first").string(), "time.output_every=1 ms",
                           "interactions[0].contact.tangential=rescaled"},
                          "1", scenario);
  INFO(branch.err);
  REQUIRE(branch.status == 0);
  // It rests on the slope and goes on to: without its spring it slips at 0.2 mm/s, of 2e-13 J.
  std::istringstream rows(read_file(folder / "branch" / "series.csv"));
  std::string row;
  std::getline(rows, row);
  int count = 0;
  for (; std::getline(rows, row); ++count) CHECK(std::stod(row.substr(row.find(',') + 1)) < 1e-16);
  CHECK(count >= 5);
}

TEST_CASE("kept states shall be found by their time, and others be named") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(run(first, "14 ms", {"time.keep_every=4 ms", "time.output_every=7 ms"}).status == 0);
  const std::string from = "start_from=" + first.string();
  REQUIRE(run(folder / "whole", "16 ms").status == 0);
  const auto kept = run(folder / "kept", "16 ms", {from + "@8 ms"});
  INFO(kept.err);
  REQUIRE(kept.status == 0);
  CHECK(digest(folder / "kept") == digest(folder / "whole"));
  CHECK(json_text(folder / "kept" / "summary.json", "time_s").substr(0, 5) == "0.008");
  const auto none = run(folder / "none", "16 ms", {from + "@9 ms"});
  CHECK(none.status == 2);
  CHECK(
      none.err.find("keeps no state of 0.009 s, only of 0 s, 0.004 s, 0.008 s, 0.012 s, 0.014 s") !=
      std::string::npos);
  CHECK(!fs::exists(folder / "none"));
}

TEST_CASE("what cannot be carried over shall be named with its place and a remedy") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(run(first, "14 ms").status == 0);
  const std::string from = "start_from=" + first.string();
  const auto refused = [&](const std::string& end, const std::vector<std::string>& settings,
                           const std::string& words) {
    std::vector<std::string> all{from};
    all.insert(all.end(), settings.begin(), settings.end());
    const auto done = run(folder / "refused", end, all);
    CHECK(done.status == 2);
    INFO(done.err);
    CHECK(done.err.find(words) != std::string::npos);
    CHECK(!fs::exists(folder / "refused"));
  };
  refused("14 ms", {}, "is not after the time that the run starts from, 0.014 s");
  refused("20 ms", {"domain.max=[340, 11, 350 mm]"}, "give the same domain");
  refused("20 ms", {"time.fluid_step=5 ms"}, "is no multiple of time.fluid_step, 0.005 s");
  // A block where grains lie on the belt or fall.
  refused(
      "20 ms",
      {"bodies.block={shape: box, min: [10, -1, 150 mm], max: [40, 12, 230 mm], material: belt}",
       "emitters.feed.min=[60, 1.5, 202 mm]", "emitters.feed.max=[84, 9.5, 202 mm]"},
      "bodies.block: ");
  const auto missing = run(folder / "refused", "20 ms", {"start_from=" + (folder / "no").string()});
  CHECK(missing.status == 2);
  CHECK(missing.err.find("holds no checkpoint.h5: run that scenario first") != std::string::npos);
  const auto time = run(folder / "refused", "20 ms", {from + "@soon"});
  CHECK(time.status == 2);
  CHECK(time.err.find("'soon' behind the @ is no time, like 0.5 s") != std::string::npos);
}

TEST_CASE("a resumed branch shall know that it is one, and what was warned of when it began") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "first", "8 ms").status == 0);
  const std::vector<std::string> settings = {"start_from=" + (folder / "first").string(),
                                             "emitters.feed.mass_flow=2 g/s"};
  REQUIRE(run(folder / "whole", "16 ms", settings).status == 0);
  REQUIRE(run(folder / "parts", "12 ms", settings).status == 0);
  // Also the second time.
  for (const std::string end : {"14 ms", "16 ms"}) {
    const auto resumed =
        engine({"run", k_scenario, "-o", folder / "parts", "--set", "time.end=" + end, "--set",
                settings[0], "--set", settings[1], "--resume", "--quiet"});
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
  }
  const auto summary = [&](const char* name) {
    return nlohmann::json::parse(read_file(folder / name / "summary.json"));
  };
  const auto whole = summary("whole"), parts = summary("parts");
  REQUIRE(whole.contains("start_from"));
  CHECK(parts["start_from"] == whole["start_from"]);
  REQUIRE(!whole["warnings"].empty());
  CHECK(parts["warnings"] == whole["warnings"]);
}
