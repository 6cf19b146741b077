// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// Grains of a table and a few that fall.
const char* const k_box = R"(name: box
time: {end: 12 ms, fluid_step: 1 ms, output_every: 4 ms}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [20, 20, 20 mm]
  boundaries:
    left: {grains: open}
    right: {grains: open}
    front: {grains: open}
    back: {grains: open}
    bottom: {grains: wall, material: sand}
    top: {grains: open}
materials:
  sand: {density: 2500, young_modulus: 10 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.4}
emitters:
  bed: {model: file, material: sand, file: grains.csv}
fluid: none
)";
const char* const k_grains =
    "diameter [m],x [m],y [m],z [m]\n0.001,0.010,0.010,0.003\n0.001,0.012,0.010,0.004\n";
const char* const k_other_grains =
    "diameter [m],x [m],y [m],z [m]\n0.001,0.010,0.010,0.003\n0.001,0.012,0.010,0.005\n";

/// The project: a scenario and its table.
void write_project(const fs::path& folder, const char* grains = k_grains) {
  fs::create_directories(folder);
  std::ofstream(folder / "box.yaml") << k_box;
  std::ofstream(folder / "grains.csv") << grains;
}

dust::test::Outcome run(const fs::path& project, const fs::path& out, const std::string& end,
                        std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run",   project / "box.yaml", "-o",     out,
                                     "--set", "time.end=" + end,    "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return engine(arguments);
}

bool says(const std::string& text, const std::string& words) {
  INFO(text);
  CHECK(text.find(words) != std::string::npos);
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a run shall not be resumed with other content in the files that it reads") {
  const TemporaryFolder folder;
  const fs::path project = folder / "project";
  const fs::path out = folder / "out";
  write_project(project);
  REQUIRE(run(project, out, "5 ms").status == 0);
  const std::string summary = read_file(out / "summary.json");
  says(summary, "\"input_files\"");
  const std::string input = "input: " + (project / "grains.csv").string() + ", sha256 ";
  says(read_file(out / "run.log"), input);

  write_project(project, k_other_grains);
  const auto refused = run(project, out, "12 ms", {"--resume"});
  CHECK(refused.status == 2);
  says(refused.err, "emitters.bed.file: " + (project / "grains.csv").string() +
                        " is not the file that the run began with");
  says(refused.err, "put the file of then in its place to go on, or start again with --force");
  CHECK(read_file(out / "summary.json") == summary);

  write_project(project);
  CHECK(run(project, out, "12 ms", {"--resume"}).status == 0);
}

TEST_CASE("a run shall be resumed where its files lie elsewhere, to the same bits") {
  const TemporaryFolder folder;
  const fs::path project = folder / "project";
  const fs::path moved = folder / "a" / "much" / "longer" / "way" / "to" / "the" / "project";
  const fs::path out = folder / "out";
  write_project(project);
  REQUIRE(run(project, folder / "whole", "12 ms").status == 0);
  REQUIRE(run(project, out, "5 ms").status == 0);
  fs::create_directories(moved.parent_path());
  fs::rename(project, moved);
  const auto resumed = run(moved, out, "9 ms", {"--resume"});
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  says(read_file(out / "run.log"), "emitters.bed.file: " + (moved / "grains.csv").string() +
                                       " in place of " + (project / "grains.csv").string());
  // The name of then again, which leads to the same file.
  fs::create_directory_symlink(moved, project);
  REQUIRE(run(project, out, "12 ms", {"--resume"}).status == 0);
  CHECK(json_text(out / "summary.json", "state_sha256") ==
        json_text(folder / "whole" / "summary.json", "state_sha256"));
  // Elsewhere, and another one.
  write_project(folder / "other", k_other_grains);
  const auto refused = run(folder / "other", out, "14 ms", {"--resume"});
  CHECK(refused.status == 2);
  says(refused.err,
       "is not the file that the run began with, " + (project / "grains.csv").string());
}

TEST_CASE("a branch shall not take other content of its files for the same scenario") {
  const TemporaryFolder folder;
  const fs::path project = folder / "project";
  write_project(project);
  REQUIRE(run(project, folder / "base", "5 ms").status == 0);
  const std::string from = "start_from=" + (folder / "base").string();
  REQUIRE(run(project, folder / "same", "8 ms", {"--set", from}).status == 0);
  CHECK(json_text(folder / "same" / "summary.json", "is_same_scenario") == "true");
  write_project(project, k_other_grains);
  REQUIRE(run(project, folder / "other", "8 ms", {"--set", from}).status == 0);
  CHECK(json_text(folder / "other" / "summary.json", "is_same_scenario") == "false");
}

TEST_CASE("a branch shall go on from its own checkpoint and say that its origin has changed") {
  const TemporaryFolder folder;
  const fs::path project = folder / "project";
  const fs::path base = folder / "base";
  const fs::path out = folder / "out";
  write_project(project);
  const std::vector<std::string> from = {"--set", "start_from=" + base.string()};
  const std::vector<std::string> resume = {from[0], from[1], "--resume"};
  REQUIRE(run(project, base, "5 ms").status == 0);
  REQUIRE(run(project, out, "8 ms", from).status == 0);
  REQUIRE(run(project, base, "6 ms", {"--resume"}).status == 0);
  // Each time, not only the first.
  for (const std::string end : {"10 ms", "12 ms"}) {
    const auto resumed = run(project, out, end, resume);
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
    says(read_file(out / "summary.json"),
         "start_from: another state than the run began with stands in " + base.string());
  }
}
