// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

using dust::test::approx;
using dust::test::engine;
using dust::test::engine_interrupted_when;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const fs::path k_here = DUST_SOURCE "/tests/study";

/// Fields of a line of study.csv; quoted ones hold commas.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> all(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      all.emplace_back();
    } else {
      all.back() += c;
    }
  }
  return all;
}

/// study.csv as rows of name -> field; times differ from run to run and are left out.
std::vector<std::map<std::string, std::string>> table_of(const fs::path& folder) {
  std::istringstream stream(read_file(folder / "study.csv"));
  std::string line;
  std::getline(stream, line);
  const auto names = fields(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(stream, line)) {
    const auto values = fields(line);
    REQUIRE(values.size() == names.size());
    rows.emplace_back();
    for (std::size_t n = 0; n < names.size(); ++n) {
      if (names[n] != "wall_s [s]") rows.back()[names[n]] = values[n];
    }
  }
  return rows;
}

std::size_t count_of(const fs::path& folder, const std::string& status) {
  std::size_t count = 0;
  const std::string text = read_file(folder / "study.csv");
  for (std::size_t at = text.find("," + status + ","); at != std::string::npos;
       at = text.find("," + status + ",", at + 1)) {
    ++count;
  }
  return count;
}

/// The study `text` beside a copy of drop.yaml.
fs::path write_study(const TemporaryFolder& folder, const std::string& text) {
  fs::copy_file(k_here / "drop.yaml", folder / "drop.yaml", fs::copy_options::overwrite_existing);
  std::ofstream(folder / "study.yaml") << text;
  return folder / "study.yaml";
}

}  // namespace

TEST_CASE("a study shall run every point and tell what was set and what came of it") {
  const TemporaryFolder folder;
  const auto run = engine({"study", k_here / "drop_study.yaml", "-o", folder / "out"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto rows = table_of(folder / "out");
  REQUIRE(rows.size() == 8);
  CHECK(rows[0].at("emitters.feed.velocity") == "[0, 0, -0.5 m/s]");
  CHECK(rows[2].at("emitters.feed.mass_flow [g/s]") == "2");
  CHECK(rows[0].at("seed") == "1");
  CHECK(rows[1].at("seed") == "2");
  // Twice the flow, twice the grains.
  const double once = std::stod(rows[0].at("emitted [1]"));
  const double twice = std::stod(rows[2].at("emitted [1]"));
  CHECK(twice == approx(2.0 * once).epsilon(0.01));
  // What passed in mg is what the run itself says in kg.
  const fs::path point = folder / "out" / "points" / rows[0].at("hash");
  const std::string summary = read_file(point / "summary.json");
  const auto at = summary.find("\"forward/mass\"");
  const double kilograms = std::stod(summary.substr(summary.find("\"value\": ", at) + 9));
  CHECK(std::stod(rows[0].at("passed [mg]")) == approx(1e6 * kilograms));
  CHECK(fs::file_size(folder / "out" / "study.h5") > 0);
  // One line per point, with its turn.
  CHECK(run.out.find("[8/8]") != std::string::npos);
}

TEST_CASE("a study shall count as 0 what a run leaves out because there is none") {
  const TemporaryFolder folder;
  const fs::path file = folder / "study.yaml";
  std::ofstream(file)
      << "base: " DUST_SOURCE
         "/tests/scenario/dust_in_duct.yaml\n"
         "vary: {time.end: [0.5 s]}\n"
         "measure:\n"
         "  floor: dust_field.classes.3_um.deposited_kg.bottom\n"
         "  out: dust_rates.left.right.rate\n"
         "  more_out:\n"
         "    {quantity: dust_rates.left.right.rate, minus: dust_rates.deposited.bottom.rate}\n";
  const auto run = engine({"study", file, "-o", folder / "out"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto rows = table_of(folder / "out");
  REQUIRE(rows.size() == 1);
  // Nothing settles without gravity, and the summary does not name the floor.
  CHECK(rows[0].at("floor [kg]") == "0");
  CHECK(std::stod(rows[0].at("out [kg/h]")) > 0.0);
  CHECK(rows[0].at("more_out [kg/h]") == rows[0].at("out [kg/h]"));
}

TEST_CASE("a study shall say of which figures runs are not steady, and judge nothing by them") {
  const TemporaryFolder folder;
  const fs::path study =
      write_study(folder,
                  "base: drop.yaml\nreplicates: 2\nvary: {emitters.feed.mass_flow: [1, 2 g/s]}\n"
                  "measure: {passed: sensors.out.forward.mass}\n"
                  "expect: [{output: passed, input: emitters.feed.mass_flow, then: rises}]\n");
  const fs::path out = folder / "out";
  REQUIRE(engine({"study", study, "-o", out, "--quiet"}).status == 0);
  // As a run says it whose mean still drifts.
  for (const auto& row : table_of(out)) {
    const fs::path summary = out / "points" / row.at("hash") / "summary.json";
    auto json = nlohmann::json::parse(read_file(summary));
    auto& figure = json["sensors"]["out"]["forward/mass"];
    figure["uncertainty"] = nullptr;
    figure["no_error"] = "not steady";
    std::ofstream(summary) << json;
  }
  const auto run = engine({"study", study, "-o", out, "--resume"});
  INFO(run.out);
  REQUIRE(run.status == 0);
  CHECK(run.out.find("open: 4 of 4 points not steady: ") != std::string::npos);
  for (const auto& row : table_of(out)) {
    CHECK(row.at("passed error [kg]").empty());
    CHECK(row.at("no_error") == "passed: not steady");
  }
}

TEST_CASE("a study killed half way and resumed shall equal an uninterrupted one row for row") {
  const TemporaryFolder folder;
  const fs::path study = k_here / "drop_study.yaml";
  REQUIRE(engine({"study", study, "-o", folder / "whole", "--quiet"}).status == 0);
  const auto whole = table_of(folder / "whole");
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    CAPTURE(signal);
    const fs::path cut = folder / ("cut" + std::to_string(signal));
    const auto stopped =
        engine_interrupted_when({"study", study, "-o", cut, "--jobs", "2", "--quiet"}, signal,
                                [&] { return count_of(cut, "finished") >= 3; });
    CHECK(stopped.status == 128 + signal);
    const std::size_t before = count_of(cut, "finished");
    CHECK(before < whole.size());
    const auto resumed = engine({"study", study, "-o", cut, "--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
    CHECK(table_of(cut) == whole);
    // What had finished was not run again: one line for each of the others.
    const auto lines = std::count(resumed.out.begin(), resumed.out.end(), '\n');
    CHECK(static_cast<std::size_t>(lines) <= whole.size() - before + 1);
  }
}

TEST_CASE("a widened study shall run only what is missing") {
  const TemporaryFolder folder;
  const std::string text =
      "base: drop.yaml\nmeasure: {emitted: particles.emitted}\n"
      "vary:\n  emitters.feed.mass_flow: ";
  const fs::path study = write_study(folder, text + "[1, 2 g/s]\n");
  REQUIRE(engine({"study", study, "-o", folder / "out"}).status == 0);
  write_study(folder, text + "[0.5, 1, 2 g/s]\n");
  const auto wider = engine({"study", study, "-o", folder / "out", "--resume"});
  REQUIRE(wider.status == 0);
  CHECK(std::count(wider.out.begin(), wider.out.end(), '[') == 1);
  CHECK(table_of(folder / "out").size() == 3);
  CHECK(count_of(folder / "out", "finished") == 3);
}

TEST_CASE("a failing point shall be recorded with its reason and stop the others only if asked") {
  const TemporaryFolder folder;
  // The grain lies inside the obstacle: that is seen only when it is let in.
  const fs::path study = write_study(
      folder,
      "base: drop.yaml\nset: {emitters.seed.enabled: true, emitters.feed.enabled: false}\n"
      "vary: {bodies.obstacle.enabled: [true, false]}\n"
      "measure: {emitted: particles.emitted}\n");
  const auto run = engine({"study", study, "-o", folder / "out", "--jobs", "1"});
  CHECK(run.status == 1);
  const auto rows = table_of(folder / "out");
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].at("status") == "failed");
  CHECK(rows[0].at("reason").find("overlaps 'obstacle'") != std::string::npos);
  CHECK(rows[0].at("emitted [1]").empty());
  CHECK(rows[1].at("status") == "finished");

  const auto fast = engine({"study", study, "-o", folder / "fast", "--jobs", "1", "--fail-fast"});
  CHECK(fast.status == 1);
  CHECK(table_of(folder / "fast")[1].at("status") == "waiting");
  CHECK(fast.err.find("1 left waiting; --resume") != std::string::npos);
  CHECK(run.err.find("wait") == std::string::npos);
}

TEST_CASE("a study whose folder is in use shall say at once that it waits") {
  const TemporaryFolder folder;
  const fs::path study = write_study(folder,
                                     "base: drop.yaml\nmeasure: {emitted: particles.emitted}\n"
                                     "vary: {emitters.feed.mass_flow: [1, 2 g/s]}\n");
  const fs::path out = folder / "out";
  REQUIRE(engine({"study", study, "-o", out, "--quiet"}).status == 0);
  const int lock = open((out / "study.lock").c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(flock(lock, LOCK_EX | LOCK_NB) == 0);
  std::thread holder([lock] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    close(lock);
  });
  const auto waited = engine({"study", study, "-o", out, "--resume", "--quiet"});
  holder.join();
  CHECK(waited.status == 0);
  INFO(waited.err);
  CHECK(waited.err.starts_with(out.string() + " is in use by another study"));
  CHECK(waited.err.find("waits up to 30 s") != std::string::npos);
  // Nothing to wait for, nothing to say.
  CHECK(engine({"study", study, "-o", out, "--resume", "--quiet"}).err.empty());
}

TEST_CASE("a dry run shall list the points and write nothing") {
  const TemporaryFolder folder;
  const auto run = engine({"study", k_here / "drop_study.yaml", "-o", folder / "out", "--dry-run"});
  CHECK(run.status == 0);
  CHECK(run.out.find("8 points, 0 finished") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a study of a run's scenario, which the engine wrote, shall not ask for its units") {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  // Whole metres: where a user writes them, mm may be meant.
  const auto done = engine(
      {"run", k_here / "drop.yaml", "-o", run, "--quiet", "--set", "domain.max=[1, 1, 1 m]"});
  REQUIRE(done.status == 0);
  const fs::path study = folder / "study.yaml";
  std::ofstream(study) << "base: run/scenario.yaml\nmeasure: {emitted: particles.emitted}\n"
                          "vary: {emitters.feed.mass_flow: [1, 2 g/s]}\n";
  const auto dry = engine({"study", study, "--dry-run"});
  CHECK(dry.status == 0);
  CHECK(dry.err.empty());
}

TEST_CASE("what a check warns of shall be told by a study, once, with the points that it is of") {
  const TemporaryFolder folder;
  const std::string head = "base: drop.yaml\nmeasure: {emitted: particles.emitted}\n";
  const auto warnings = [&](const std::string& text) {
    const auto run = engine({"study", write_study(folder, head + text), "--dry-run"});
    CHECK(run.status == 0);
    CAPTURE(run.err);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    return run.err;
  };
  const std::string soft = "warning: interactions[0].contact: grains of 600 um overlap by ";
  const std::string some =
      warnings("vary: {materials.sand.young_modulus: [5 MPa, 5 kPa, 6 kPa]}\nreplicates: 2\n");
  CHECK(some.find(soft) != std::string::npos);
  CHECK(some.find(
            "(points 3 to 6; numbers of the first, with materials.sand.young_modulus: 5 kPa)") !=
        std::string::npos);
  const std::string all = warnings(
      "set: {materials.sand.young_modulus: 5 kPa}\nvary: {emitters.feed.mass_flow: [1, 2 g/s]}\n");
  CHECK(all.find(soft) != std::string::npos);
  CHECK(all.find("points") == std::string::npos);
  // A plan may come before the run that it starts from.
  CHECK(warnings("set: {start_from: yonder, time.end: 1 s}\nreplicates: 2\n")
            .find("warning: start_from: ") != std::string::npos);
}

/// [s] of all points by a dry run of the study.
double planned_seconds(const fs::path& study, const std::string& text) {
  std::ofstream(study) << text;
  const auto run = engine({"study", study, "-o", study.parent_path() / "out", "--dry-run"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string lead = "MB each; about ";
  std::istringstream words(run.out.substr(run.out.find(lead) + lead.size()));
  double value = 0.0;
  std::string unit;
  words >> value >> unit;
  return value * (unit == "h" ? 3600.0 : unit == "min" ? 60.0 : 1.0);
}

TEST_CASE("a dry run shall tell of a branch what is left of it") {
  const TemporaryFolder folder;
  const std::string text = "name: branch\nbase: " + (k_here / "drop.yaml").string() +
                           "\nvary: {emitters.feed.mass_flow: [1 g/s]}\n"
                           "measure: {emitted: particles.emitted}\nset:\n  time.end: 4000 s\n";
  const double whole = planned_seconds(folder / "study.yaml", text);
  const double branch =
      planned_seconds(folder / "study.yaml", text + "  start_from: yonder@3000 s\n");
  REQUIRE(whole > 60.0);
  // Two digits are told.
  CHECK(branch / whole == approx(0.25).epsilon(0.1));
}

TEST_CASE(
    "a study that is not there shall not be resumed, and none begins where no folder can be") {
  const TemporaryFolder folder;
  const auto absent =
      engine({"study", k_here / "drop_study.yaml", "-o", folder / "none", "--resume"});
  CHECK(absent.status == 2);
  CHECK(absent.err.find("holds no study to resume; start the study without --resume") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder / "none"));
  fs::create_symlink(folder / "nowhere", folder / "link");
  CHECK(engine({"study", k_here / "drop_study.yaml", "-o", folder / "link"}).status == 2);
  CHECK(engine({"study", k_here / "drop_study.yaml", "-o", folder / "caf\xE9"}).status == 2);
  CHECK_FALSE(fs::exists(folder / "caf\xE9"));
}

TEST_CASE("a folder that holds a study shall be kept unless told otherwise") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "out");
  std::ofstream(folder / "out" / "mine.txt") << "mine";
  const auto refused = engine({"study", k_here / "drop_study.yaml", "-o", folder / "out"});
  CHECK(refused.status == 2);
  CHECK(refused.err.find("--resume") != std::string::npos);
  CHECK(refused.err.find("--force") != std::string::npos);
}

TEST_CASE("a study shall know its points by what stands in their files, wherever these lie") {
  const TemporaryFolder folder;
  const auto write_project = [](const fs::path& project, const std::string& height) {
    fs::create_directories(project);
    std::string base = read_file(k_here / "drop.yaml");
    const std::string bed = "  bed: {model: file, material: sand, file: bed.csv}\n";
    base.insert(base.find("fluid: none"), bed);
    std::ofstream(project / "drop.yaml") << base;
    std::ofstream(project / "bed.csv")
        << "diameter [m],x [m],y [m],z [m]\n0.001,0,0," << height << "\n";
    std::ofstream(project / "study.yaml")
        << "base: drop.yaml\nvary: {emitters.feed.mass_flow: [1, 2 g/s]}\n"
           "measure: {emitted: particles.emitted}\nrun: {jobs: 1, threads: 1}\n";
  };
  const fs::path out = folder / "out";
  const auto hashes = [&] {
    std::vector<std::string> all;
    for (const auto& row : table_of(out)) all.push_back(row.at("hash"));
    return all;
  };
  write_project(folder / "project", "0.012");
  REQUIRE(engine({"study", folder / "project" / "study.yaml", "-o", out, "--quiet"}).status == 0);
  const auto first = hashes();

  // Moved to a longer name, with one point that is still to be run.
  const fs::path moved = folder / "another place with quite a long name to see where lines break";
  fs::rename(folder / "project", moved);
  fs::remove_all(out / "points" / first[1]);
  const auto on = engine({"study", moved / "study.yaml", "-o", out, "--resume"});
  INFO(on.err);
  REQUIRE(on.status == 0);
  CHECK(hashes() == first);
  CHECK(count_of(out, "finished") == 2);
  CHECK(on.out.find(first[0]) == std::string::npos);
  CHECK(on.out.find(first[1]) != std::string::npos);

  // Another table under the same name: other points.
  write_project(moved, "0.013");
  REQUIRE(engine({"study", moved / "study.yaml", "-o", out, "--resume", "--quiet"}).status == 0);
  for (const std::string& hash : hashes()) {
    CHECK(std::find(first.begin(), first.end(), hash) == first.end());
  }
}

TEST_CASE("force shall replace a study, but nothing that it reads") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto forced = [&](const std::string& text) {
    return engine({"study", write_study(folder, text), "-o", out, "--force", "--quiet"});
  };
  const std::string rest =
      "replicates: 2\nset: {time.end: 2 ms}\nmeasure: {emitted: particles.emitted}\n";
  REQUIRE(forced("base: drop.yaml\n" + rest).status == 0);
  REQUIRE(forced("base: drop.yaml\n" + rest).status == 0);
  const std::string point = "out/points/" + table_of(out).front().at("hash");
  const std::string scenario = read_file(folder / point / "scenario.yaml");
  { std::ofstream(folder / "over.yaml") << "include: " + point + "/scenario.yaml\n"; }
  for (const std::string& text :
       {"base: " + point + "/scenario.yaml\n" + rest, "base: over.yaml\n" + rest,
        "base: drop.yaml\nreplicates: 2\nset: {start_from: " + point +
            ", time.end: 4 ms}\nmeasure: {emitted: particles.emitted}\n"}) {
    CAPTURE(text);
    const auto refused = forced(text);
    INFO(refused.err);
    CHECK(refused.status == 2);
    CHECK(refused.err.find(", which this study reads: copy it elsewhere, or give another -o") !=
          std::string::npos);
    CHECK(read_file(folder / point / "scenario.yaml") == scenario);
  }
}
