// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::engine;
using dust::test::engine_interrupted;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/small_hourglass.yaml";
// Not a whole number of rows of seven steps: the last one is shorter.
const std::string k_end = "time.end=0.114 s";
// 20 rows per frame: 0.14 s are rows every 7 ms, frames beyond the end.
const std::string k_seldom = "time.output_every=0.14 s";

/// The columns of a series.csv.
std::map<std::string, std::vector<double>> columns_of(const fs::path& file) {
  std::istringstream lines(read_file(file));
  std::string line;
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t n = 0; std::getline(cells, cell, ','); ++n) {
      if (names.size() <= n) {
        names.push_back(cell);
        columns[cell] = {};
      } else {
        columns[names[n]].push_back(cell.empty() ? std::nan("") : std::stod(cell));
      }
    }
  }
  return columns;
}

struct Integral {
  double sum = 0.0;
  double size = 0.0;  ///< of the magnitudes
};
Integral integral_of(const std::vector<double>& time, const std::vector<double>& values) {
  Integral integral;
  for (std::size_t n = 1; n < values.size(); ++n) {
    integral.sum += (time[n] - time[n - 1]) * values[n];
    integral.size += (time[n] - time[n - 1]) * std::abs(values[n]);
  }
  return integral;
}

}  // namespace

TEST_CASE("impulses on walls shall be the same however seldom rows of the series are written") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, const std::string& output) {
    const auto done = engine({"run", k_scenario, "-o", folder / name, "--set", k_end, "--set",
                              output, "--threads", "1", "--quiet"});
    INFO(done.err);
    REQUIRE(done.status == 0);
    return columns_of(folder / name / "series.csv");
  };
  const auto full = run("full", "time.output_every=20 ms");
  const auto thinned = run("thinned", k_seldom);
  const std::vector<double>& each = full.at("time [s]");
  const std::vector<double>& seldom = thinned.at("time [s]");
  REQUIRE(each.size() == 115);
  REQUIRE(seldom.size() == 18);
  CHECK(seldom.back() == approx(0.114));
  int loads = 0;
  for (const auto& [name, values] : full) {
    if (json_text(folder / "full" / "summary.json", name) != "mean") continue;
    CAPTURE(name);
    const Integral of_each = integral_of(each, values);
    const Integral of_rows = integral_of(seldom, thinned.at(name));
    // Some hundred roundings of the sums, and of the times the steps are taken from.
    constexpr double k_rounding = 1e-12;
    CHECK(std::abs(of_each.sum - of_rows.sum) <= k_rounding * of_each.size);
    loads += of_each.size > 0.0 ? 1 : 0;
  }
  CHECK(loads >= 12);  // force, torque and power of two walls, some of them 0 by symmetry
  CHECK(json_text(folder / "full" / "summary.json", "tray_load/contacts [1]") == "instant");
  CHECK(json_text(folder / "full" / "summary.json", "mass_left [kg]") == "total");
}

TEST_CASE("the first row shall show the state at the start, as sensors see it") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, std::vector<std::string> settings) {
    std::vector<std::string> arguments{"run",
                                       k_scenario,
                                       "-o",
                                       folder / name,
                                       "--threads",
                                       "1",
                                       "--quiet",
                                       "--set",
                                       "sensors.height={model: bed_height, base: [0, 0, 10 mm]}",
                                       "--set",
                                       "emitters.feed.enabled=false"};
    for (std::string& setting : settings) {
      arguments.insert(arguments.end(), {"--set", std::move(setting)});
    }
    const auto done = engine(arguments);
    INFO(done.err);
    REQUIRE(done.status == 0);
    return columns_of(folder / name / "series.csv");
  };
  // The only grain at first: its centre 30 mm over the base, half of a bed of 60 mm.
  const auto first = run("first", {"time.end=4 ms", "time.output_every=4 ms",
                                   "emitters.more={model: single, material: sand, diameters: [1 "
                                   "mm], positions: [[0, 0, 40 mm]]}"});
  CHECK(first.at("height/twice_centre [m]").front() == approx(0.06));
  CHECK(first.at("plug_load/force_z [N]").front() == 0.0);  // a mean, of no time yet
  // A sensor that the other run had not sees where that one left off, the others go on.
  const auto branch =
      run("branch", {"start_from=" + (folder / "first").string(), "time.end=8 ms",
                     "emitters.more={model: single, material: sand, diameters: [1 mm], "
                     "positions: [[0, 0, 40 mm]]}",
                     "sensors.energy={model: kinetic_energy}"});
  const double translation = branch.at("energy/translation [J]").front();
  CHECK(translation > 0.0);
  CHECK(translation + branch.at("energy/rotation [J]").front() ==
        approx(first.at("kinetic_energy [J]").back()));
  CHECK(branch.at("height/twice_centre [m]").front() == first.at("height/twice_centre [m]").back());
}

TEST_CASE("a run stopped between two rows shall go on to the same series") {
  const TemporaryFolder folder;
  const auto arguments = [&](const std::string& name) {
    // Checkpoints every 5 steps, rows every 7: one of 20 checkpoints falls on a row.
    return std::vector<std::string>{
        "run",     k_scenario,  "-o",     folder / name, "--set",
        k_end,     "--set",     k_seldom, "--set",       "time.checkpoint_every=5 ms",
        "--quiet", "--threads", "1"};
  };
  REQUIRE(engine(arguments("whole")).status == 0);
  const auto stopped =
      engine_interrupted(arguments("cut"), SIGKILL, folder / "cut" / "series.csv", 12);
  CHECK(stopped.status == 128 + SIGKILL);
  auto resume = arguments("cut");
  resume.emplace_back("--resume");
  const auto resumed = engine(resume);
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  CHECK(read_file(folder / "cut" / "series.csv") == read_file(folder / "whole" / "series.csv"));
  // Asked again, a finished run has nothing to add.
  REQUIRE(engine(resume).status == 0);
  CHECK(read_file(folder / "cut" / "series.csv") == read_file(folder / "whole" / "series.csv"));
}
