// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"
#include "support/same_bits.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::engine_interrupted;
using dust::test::engine_interrupted_when;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/small_transfer.yaml";
const std::string k_short = "time.end=0.024 s";

}  // namespace

TEST_CASE("an interrupted run shall go on to the same bits and the same series") {
  const TemporaryFolder folder;
  const fs::path whole = folder / "whole";
  REQUIRE(engine({"run", k_scenario, "-o", whole, "--set", k_short, "--quiet"}).status == 0);
  const auto hash = json_text(whole / "summary.json", "state_sha256");

  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    CAPTURE(signal);
    const fs::path cut = folder / ("cut" + std::to_string(signal));
    // Past the frame at 10 ms, so that a kill finds a checkpoint in mid-run.
    const auto stopped = engine_interrupted(
        {"run", k_scenario, "-o", cut, "--set", k_short, "--threads", "1", "--quiet"}, signal,
        cut / "series.csv", 15);
    CHECK(stopped.status == 128 + signal);
    if (signal != SIGKILL) CHECK(json_text(cut / "summary.json", "status") == "interrupted");
    const auto resumed = engine(
        {"run", k_scenario, "-o", cut, "--set", k_short, "--resume", "--threads", "2", "--quiet"});
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
    CHECK(json_text(cut / "summary.json", "state_sha256") == hash);
    CHECK(read_file(cut / "series.csv") == read_file(whole / "series.csv"));
  }
}

TEST_CASE("a stirred box with dust and eddies shall have the same bits wherever it is cut") {
  for (const char* at : {"2 ms", "5 ms", "11 ms"}) {
    CAPTURE(at);
    dust::test::check_same_bits(DUST_SOURCE "/tests/scenario/stirred.yaml", {}, {at, "20 ms"},
                                {"dust_field", "mass_kg"});
  }
}

TEST_CASE(
    "air that overlaps the grains shall give the same bits on any threads and after a resume") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, const std::string& end, const std::string& threads,
                       std::vector<std::string> more) {
    std::vector<std::string> arguments{"run",         k_scenario, "-o",
                                       folder / name, "--set",    "time.end=" + end,
                                       "--threads",   threads,    "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto done = engine(arguments);
    INFO(done.err);
    REQUIRE(done.status == 0);
    return json_text(folder / name / "summary.json", "state_sha256");
  };
  const std::vector<std::string> overlap{"--set", "coupling.overlap=true"};
  const auto whole = run("whole", "24 ms", "1", overlap);
  CHECK(run("threads", "24 ms", "2", overlap) == whole);
  run("parts", "13 ms", "2", overlap);
  auto resume = overlap;
  resume.emplace_back("--resume");
  CHECK(run("parts", "24 ms", "2", resume) == whole);
  CHECK(run("turns", "24 ms", "1", {}) != whole);
}

TEST_CASE("a finished run shall be continued to a later end with the bits of the whole") {
  const TemporaryFolder folder;
  const fs::path parts = folder / "parts";
  const fs::path whole = folder / "whole";
  REQUIRE(engine({"run", k_scenario, "-o", parts, "--set", "time.end=8 ms", "--quiet"}).status ==
          0);
  // Steps and times tell of the same stretch: the whole run.
  const double spent = std::stod(json_text(parts / "summary.json", "neighbour"));
  REQUIRE(engine({"run", k_scenario, "-o", parts, "--set", "time.end=9 ms", "--resume", "--quiet"})
              .status == 0);
  CHECK(std::stod(json_text(parts / "summary.json", "neighbour")) > spent);
  REQUIRE(engine({"run", k_scenario, "-o", parts, "--set", "time.end=14 ms", "--resume", "--quiet"})
              .status == 0);
  REQUIRE(engine({"run", k_scenario, "-o", whole, "--set", "time.end=14 ms", "--quiet"}).status ==
          0);
  CHECK(json_text(parts / "summary.json", "state_sha256") ==
        json_text(whole / "summary.json", "state_sha256"));
}

TEST_CASE("wet grains shall keep their bridges through a restart, with the bits of the whole") {
  const TemporaryFolder folder;
  const fs::path dry = folder / "dry";
  const fs::path parts = folder / "parts";
  const fs::path whole = folder / "whole";
  const auto run = [](const fs::path& out, const std::string& end, bool is_wet, bool resumes) {
    std::vector<std::string> arguments{"run",     k_scenario,  "-o",
                                       out,       "--set",     "time.end=" + end,
                                       "--quiet", "--threads", resumes ? "2" : "1"};
    if (resumes) arguments.emplace_back("--resume");
    const std::string law = "interactions[0].cohesion.";
    for (const std::string setting :
         {"model=liquid_bridge", "surface_tension=0.07 N/m", "relative_volume=0.001"}) {
      if (is_wet) arguments.insert(arguments.end(), {"--set", law + setting});
    }
    return engine(arguments);
  };
  // Grains lie on the belt after 11 ms.
  const auto first = run(parts, "20 ms", true, false);
  INFO(first.err);
  REQUIRE(first.status == 0);
  REQUIRE(run(parts, "28 ms", true, true).status == 0);
  REQUIRE(run(whole, "28 ms", true, false).status == 0);
  REQUIRE(run(dry, "28 ms", false, false).status == 0);
  const auto hash = [](const fs::path& out) {
    return json_text(out / "summary.json", "state_sha256");
  };
  CHECK(hash(parts) == hash(whole));
  CHECK(hash(dry) != hash(whole));
}

TEST_CASE("bodies that move, go and suck in the air shall give the same bits after a resume") {
  const TemporaryFolder folder;
  const fs::path parts = folder / "parts";
  const fs::path whole = folder / "whole";
  const std::string paddle = DUST_SOURCE "/tests/scenario/paddle.yaml";
  const auto run = engine({"run", paddle, "-o", whole, "--threads", "1", "--quiet"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  // Before the gate goes and after it. 9 ms and a step of 1 ms are not quite 10 ms, as numbers go.
  for (const std::string end : {"5 ms", "10 ms"}) {
    const bool is_first = end == "5 ms";
    std::vector<std::string> arguments{
        "run", paddle, "-o", parts, "--set", "time.end=" + end, "--threads", "2", "--quiet"};
    if (!is_first) arguments.emplace_back("--resume");
    REQUIRE(engine(arguments).status == 0);
  }
  REQUIRE(engine({"run", paddle, "-o", parts, "--resume", "--threads", "2", "--quiet"}).status ==
          0);
  CHECK(json_text(parts / "summary.json", "state_sha256") ==
        json_text(whole / "summary.json", "state_sha256"));
}

TEST_CASE("resuming with another scenario shall be refused with the difference") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  REQUIRE(engine({"run", k_scenario, "-o", out, "--set", "time.end=4 ms", "--quiet"}).status == 0);
  const auto run = engine({"run", k_scenario, "-o", out, "--set", "time.end=8 ms", "--set",
                           "bodies.belt.speed=0.4 m/s", "--resume", "--quiet"});
  CHECK(run.status == 2);
  CHECK(run.err.find("speed") != std::string::npos);
  const auto two = engine({"run", k_scenario, "-o", out, "--set", "seed=77", "--set",
                           "bodies.belt.speed=0.4 m/s", "--resume", "--quiet"});
  CHECK(two.status == 2);
  CHECK(two.err.find("speed") != std::string::npos);
  CHECK(two.err.find("seed") != std::string::npos);
}

TEST_CASE("resuming to an end that has passed shall be refused and change nothing") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto run = [&](const std::string& end, const char* how) {
    return engine({"run", k_scenario, "-o", out, "--set", "time.end=" + end, how, "--quiet"});
  };
  REQUIRE(run("8 ms", "--force").status == 0);
  const std::string scenario = read_file(out / "scenario.yaml");
  const std::string summary = read_file(out / "summary.json");
  const auto early = run("4 ms", "--resume");
  CHECK(early.status == 2);
  CHECK(early.err.find("error: time.end: 0.004 s is before the time that the run in " +
                       out.string() + " has reached, 0.008 s: give a later end") !=
        std::string::npos);
  CHECK(read_file(out / "scenario.yaml") == scenario);
  CHECK(read_file(out / "summary.json") == summary);
  CHECK(run("8 ms", "--resume").status == 0);
}

TEST_CASE("a finished run whose continuation is killed shall not count as finished") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  REQUIRE(engine({"run", k_scenario, "-o", out, "--set", "time.end=8 ms", "--quiet"}).status == 0);
  // Nothing is left to do: it ends once more.
  REQUIRE(engine({"run", k_scenario, "-o", out, "--set", "time.end=8 ms", "--resume", "--quiet"})
              .status == 0);
  CHECK(json_text(out / "summary.json", "status") == "finished");
  CHECK(fs::exists(out / "report.html"));
  const std::string rows = read_file(out / "series.csv");
  const auto killed =
      engine_interrupted_when({"run", k_scenario, "-o", out, "--resume", "--quiet"}, SIGKILL,
                              [&] { return read_file(out / "series.csv").size() > rows.size(); });
  CHECK(killed.status == 128 + SIGKILL);
  for (const char* file : {"summary.json", "report.json", "report.html"}) {
    CAPTURE(file);
    CHECK_FALSE(fs::exists(out / file));
  }
}

TEST_CASE("a resume that lacks a frame or a row shall be refused and change nothing") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  REQUIRE(engine({"run", k_scenario, "-o", out, "--set", "time.end=8 ms", "--quiet"}).status == 0);
  const auto check_refused = [&](const std::string& missing) {
    CAPTURE(missing);
    const char* const kept[] = {"scenario.yaml", "summary.json", "report.html", "run.log"};
    std::vector<std::string> before;
    for (const char* file : kept) before.push_back(read_file(out / file));
    // A later end is another scenario.yaml.
    const auto refused =
        engine({"run", k_scenario, "-o", out, "--set", "time.end=9 ms", "--resume", "--quiet"});
    CHECK(refused.status == 2);
    CHECK(refused.err.find(missing) != std::string::npos);
    for (std::size_t n = 0; n < before.size(); ++n) CHECK(read_file(out / kept[n]) == before[n]);
  };
  const std::string series = read_file(out / "series.csv");
  { std::ofstream(out / "series.csv") << series.substr(0, series.find('\n') + 1); }
  check_refused("series.csv holds 0 rows");
  { std::ofstream(out / "series.csv") << series; }
  fs::remove(out / "frames/000000.h5");
  check_refused("frame 0 of the ");
}

TEST_CASE("a report that cannot be written shall be a warning beside a run that has finished") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  // In the way of the name under which the page is written first.
  fs::create_directories(out / "report.html.part/x");
  const auto run =
      engine({"run", k_scenario, "-o", out, "--set", "time.end=2 ms", "--force", "--quiet"});
  CHECK(run.status == 0);
  CHECK(run.err.find("the run failed") == std::string::npos);
  CHECK(run.err.find("write it again with 'engine report " + out.string() + "'") !=
        std::string::npos);
  CHECK(json_text(out / "summary.json", "status") == "finished");
  fs::remove_all(out / "report.html.part");
  CHECK(engine({"report", out}).status == 0);
  CHECK(fs::exists(out / "report.html"));
}

TEST_CASE("resuming without a checkpoint shall be refused with a remedy") {
  const TemporaryFolder folder;
  const auto run = engine({"run", k_scenario, "-o", folder / "none", "--resume"});
  CHECK(run.status == 2);
  CHECK(run.err.find("checkpoint") != std::string::npos);
  CHECK(run.err.find("without --resume") != std::string::npos);
  // Killed before its first checkpoint: each remedy leads on.
  REQUIRE(engine({"run", k_scenario, "-o", folder / "cut", "--set", "time.end=4 ms", "--quiet"})
              .status == 0);
  fs::remove(fs::path(folder / "cut") / "checkpoint.h5");
  fs::remove(fs::path(folder / "cut") / "summary.json");
  const auto again = engine({"run", k_scenario, "-o", folder / "cut", "--resume"});
  CHECK(again.status == 2);
  CHECK(again.err.find("--force") != std::string::npos);
  const auto followed = engine({"watch", folder / "cut"});
  CHECK(followed.out.find("start again with --force -o ") != std::string::npos);
  CHECK(followed.out.find("--resume") == std::string::npos);
}

TEST_CASE("a folder that a run writes to shall be refused to another one") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const std::string in_use = "another engine is writing to " + out.string();
  bool is_asked = false;
  const auto others_are_refused = [&] {
    if (!fs::exists(out / "checkpoint.h5")) return false;
    for (const std::string how : {"--resume", "--force"}) {
      const auto other = engine({"run", k_scenario, "-o", out, how, "--quiet"});
      CAPTURE(how);
      CHECK(other.status == 2);
      CHECK(other.err.find(in_use) != std::string::npos);
      CHECK(other.err.find("run.log") != std::string::npos);
    }
    const auto monitored = engine({"watch", out, "--once"});
    CHECK(monitored.status == 0);
    CHECK(monitored.out.find(" of 0.06 s, ") != std::string::npos);
    is_asked = true;
    return true;
  };
  const auto first = engine_interrupted_when(
      {"run", k_scenario, "-o", out, "--threads", "1", "--quiet"}, SIGKILL, others_are_refused);
  CHECK(first.status == 128 + SIGKILL);
  CHECK(is_asked);
  // A killed process holds nothing.
  const auto stopped = engine({"watch", out});
  CHECK(stopped.status == 1);
  CHECK(stopped.out.find("stopped at t = ") == 0);
  // To its own end: how far it had come hangs on the machine.
  const auto next = engine({"run", k_scenario, "-o", out, "--resume", "--quiet"});
  INFO(next.err);
  CHECK(next.status == 0);
  const auto finished = engine({"watch", out});
  CHECK(finished.status == 0);
  CHECK(finished.out.find("finished: t = 0.06 of 0.06 s, 100.0 %, ") == 0);
}

TEST_CASE("run.log shall begin with what the run is made by, where and from what") {
  const TemporaryFolder folder;
  const fs::path out = folder / "a b";
  REQUIRE(engine({"run", k_scenario, "-o", out, "--set", "time.end=2 ms", "--quiet"}).status == 0);
  const std::string log = read_file(out / "run.log");
  CHECK(log.find("engine 0.") < log.find(", commit: "));
  CHECK(log.find(", commit: ") < log.find(", plugin interface: "));
  CHECK(log.find("machine: ") != std::string::npos);
  CHECK(log.find("command: engine run " + k_scenario + " -o '" + out.string() +
                 "' --set 'time.end=2 ms' --quiet") != std::string::npos);
  CHECK(log.find("sha256 " + json_text(out / "summary.json", "scenario_sha256")) <
        log.find("plugin: "));
  const std::size_t drag = log.find("plugin: drag/");
  REQUIRE(drag != std::string::npos);
  const std::string line = log.substr(drag, log.find('\n', drag) - drag);
  CHECK(line.find(".so, sha256 ") != std::string::npos);
  // 64 digits of a digest at its end.
  CHECK(line.substr(line.rfind(' ') + 1).size() == 64);
}
