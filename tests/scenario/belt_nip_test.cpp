// SPDX-License-Identifier: Apache-2.0
// What a run says of a grain inside the loop of a belt, which carries it to the tail pulley.
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

auto run(const fs::path& out, const std::vector<std::string>& set) {
  std::vector<std::string> words{"run", DUST_SOURCE "/tests/scenario/belt_nip.yaml", "-o", out,
                                 "--quiet"};
  for (const std::string& one : set) words.insert(words.end(), {"--set", one});
  return engine(words);
}

nlohmann::json summary_of(const fs::path& out) {
  return nlohmann::json::parse(read_file(out / "summary.json"));
}

}  // namespace

TEST_CASE("a grain that flies apart in the nip of a belt shall be told with that cause") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  // At other steps it is shot through, as below.
  const auto failed = run(out, {"time.dem_step=60 us"});
  INFO(failed.err);
  CHECK(failed.status == 1);
  CHECK(failed.err.find(
            "; last known contact: surface belt; nearest surface: belt, its centre is ") !=
        std::string::npos);
  CHECK(failed.err.find("likely cause: it was drawn into the nip of the tail pulley of 'belt'") !=
        std::string::npos);
  CHECK(failed.err.find("time.expected_speed") == std::string::npos);
  // What it recommends is taken: another step, by start_from.
  CHECK(failed.err.find("with 'start_from: " + out.string() + "'") != std::string::npos);
  const auto branch = run(folder / "branch", {"start_from=" + out.string(), "time.dem_step=20 us"});
  INFO(branch.err);
  CHECK(branch.status == 0);
}

TEST_CASE("a grain that is shot through the belt shall leave a warning") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  REQUIRE(run(out, {"time.dem_step=20 us"}).status == 0);
  const auto summary = summary_of(out);
  CHECK(summary["health"]["largest_overlap_over_radius"].get<double>() > 1.0);
  REQUIRE(summary["warnings"].size() == 1);
  CHECK(summary["warnings"][0].get<std::string>().find(
            "grains went through each other or through walls: the largest overlap is ") == 0);
}

TEST_CASE("a plough before the tail pulley shall lead a grain off over the belt's edge") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto done = run(out, {"bodies.plough.enabled=true", "time.end=1.4 s",
                              "emitters.one.positions=[[100, 0, 53.5 mm]]"});
  INFO(done.err);
  REQUIRE(done.status == 0);
  const auto summary = summary_of(out);
  CHECK(summary["health"]["largest_overlap_over_radius"].get<double>() < 0.05);
  CHECK(summary["warnings"].empty());
  CHECK(summary["particles"]["left"] == 1);
}
