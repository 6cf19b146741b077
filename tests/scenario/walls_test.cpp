// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>

using dust::test::engine;
using dust::test::engine_interrupted;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/small_hourglass.yaml";

}  // namespace

TEST_CASE("a run whose walls move and go shall give the same bits on any threads and resumed") {
  const TemporaryFolder folder;
  const fs::path whole = folder / "whole";
  const auto first = engine({"run", k_scenario, "-o", whole, "--threads", "1", "--quiet"});
  INFO(first.err);
  REQUIRE(first.status == 0);
  const auto hash = json_text(whole / "summary.json", "state_sha256");
  const std::string log = read_file(whole / "run.log");
  CHECK(log.find("the body plug is taken away at 0.04 s: the mean kinetic energy per grain is ") !=
        std::string::npos);
  CHECK(log.find("the body gate is taken away at 0.1 s: its time has come") != std::string::npos);

  const fs::path two = folder / "two";
  REQUIRE(engine({"run", k_scenario, "-o", two, "--threads", "2", "--quiet"}).status == 0);
  CHECK(json_text(two / "summary.json", "state_sha256") == hash);
  CHECK(read_file(two / "series.csv") == read_file(whole / "series.csv"));

  // Stopped after the plug has gone: its absence is part of the state.
  const fs::path cut = folder / "cut";
  const auto stopped = engine_interrupted(
      {"run", k_scenario, "-o", cut, "--threads", "1", "--quiet"}, SIGKILL, cut / "series.csv", 55);
  CHECK(stopped.status == 128 + SIGKILL);
  const auto resumed = engine({"run", k_scenario, "-o", cut, "--resume", "--quiet"});
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  CHECK(json_text(cut / "summary.json", "state_sha256") == hash);
  CHECK(read_file(cut / "series.csv") == read_file(whole / "series.csv"));
}
