// SPDX-License-Identifier: Apache-2.0
// Forces of the fluid and turbulence in a scenario; fluid alone, grains alone, one-way coupling.
#include "support/engine.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::holds;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/forces.yaml";

/// Runs the scenario with settings; returns the digest of its end.
std::string digest(const TemporaryFolder& folder, const std::string& name,
                   const std::vector<std::string>& settings,
                   const std::vector<std::string>& more = {}) {
  const fs::path out = folder / name;
  std::vector<std::string> arguments = {"run", k_scenario, "-o", out, "--quiet"};
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto run = engine(arguments);
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK(json_text(out / "summary.json", "status") == "finished");
  return json_text(out / "summary.json", "state_sha256");
}

std::string said(const std::vector<std::string>& settings) {
  std::vector<std::string> arguments = {"check", k_scenario};
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  const auto run = engine(arguments);
  return std::to_string(run.status) + ": " + run.err;
}

}  // namespace

TEST_CASE("a run with every force shall give the same bits on threads and through a restart") {
  const TemporaryFolder folder;
  const std::string whole = digest(folder, "whole", {}, {"--threads", "1"});
  CHECK(whole.size() == 64);
  CHECK(digest(folder, "two", {}, {"--threads", "2"}) == whole);
  // Half the run, then the rest from its checkpoint.
  const fs::path half = folder / "half";
  REQUIRE(engine({"run", k_scenario, "-o", half, "--quiet", "--set", "time.end=5 ms"}).status == 0);
  REQUIRE(engine({"run", k_scenario, "-o", half, "--quiet", "--resume"}).status == 0);
  CHECK(json_text(half / "summary.json", "state_sha256") == whole);
  // What is written out is the scenario: forces and turbulence included.
  const fs::path again = folder / "again";
  REQUIRE(engine({"run", (folder / "whole") / "scenario.yaml", "-o", again, "--quiet"}).status ==
          0);
  CHECK(json_text(again / "summary.json", "state_sha256") == whole);
}

TEST_CASE("each force and the turbulence shall change the run, those of the set shall not") {
  const TemporaryFolder folder;
  const std::string plain = digest(folder, "plain", {"fluid_forces=[]"});
  int n = 0;
  for (const char* force : {"virtual_mass", "basset", "saffman", "lubrication"}) {
    CAPTURE(force);
    const std::string list = std::string("fluid_forces=[{model: ") + force + "}]";
    CHECK(digest(folder, "with" + std::to_string(n++), {list}) != plain);
  }
  CHECK(digest(folder, "laminar", {"fluid_forces=[]", "fluid.turbulence.coefficient=0.2"}) !=
        plain);
}

TEST_CASE("a drag law and its parameter shall change the run, its default said aloud shall not") {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& name, const std::string& drag) {
    return digest(folder, name, {"drag={model: " + drag + "}"});
  };
  const std::string plain = with("plain", "beetstra");
  CHECK(with("other", "stokes") != plain);
  CHECK(with("default", "beetstra, polydisperse: false") == plain);
  CHECK(with("polydisperse", "beetstra, polydisperse: true") != plain);
}

TEST_CASE("a run without the grains' own disturbance shall differ, and go on from a checkpoint") {
  const TemporaryFolder folder;
  const std::string setting = "coupling.self_disturbance=on";
  const std::string whole = digest(folder, "whole", {setting}, {"--threads", "1"});
  CHECK(digest(folder, "two", {setting}, {"--threads", "2"}) == whole);
  CHECK(digest(folder, "felt", {"coupling.self_disturbance=off"}) != whole);
  // The older name of the same.
  CHECK(digest(folder, "older", {"coupling.correct_own_disturbance=true"}) == whole);
  const fs::path half = folder / "half";
  REQUIRE(
      engine({"run", k_scenario, "-o", half, "--quiet", "--set", setting, "--set", "time.end=5 ms"})
          .status == 0);
  REQUIRE(engine({"run", k_scenario, "-o", half, "--quiet", "--set", setting, "--resume"}).status ==
          0);
  CHECK(json_text(half / "summary.json", "state_sha256") == whole);
  // The closed forms are those of a flow open in three directions.
  CHECK(holds(said({setting, "fluid.cells=[10, 3, 10]"}),
              "coupling.self_disturbance: the flow around a grain is only known in three "
              "directions, and fluid.cells has fewer than 4 along y: use more cells, or leave the "
              "correction out"));
}

TEST_CASE("where a lone grain's own disturbance is left shall be told before the run") {
  const std::string transfer = DUST_SOURCE "/scenarios/transfer_point.yaml";
  const std::string beside_bodies = "felt within 2.5 cells of edges, thin sheets and moving bodies";
  CHECK(engine({"check", transfer}).out.find(beside_bodies) != std::string::npos);
  const auto off = engine({"check", transfer, "--set", "coupling.self_disturbance=off"});
  REQUIRE(off.status == 0);
  CHECK(off.out.find(beside_bodies) == std::string::npos);
}

TEST_CASE("coarse grains shall be told of, and be moved as what they stand for") {
  const TemporaryFolder folder;
  const std::vector<std::string> coarse{"fluid_forces=[]", "materials.sand.coarse_graining=2"};
  const auto reported = engine({"check", k_scenario, "--set", coarse[0], "--set", coarse[1]});
  CHECK(reported.status == 0);
  CHECK(holds(reported.out,
              "drop: sand, 3 grains at once, each for 8 of 1/2 of its size in the fluid"));
  CHECK(digest(folder, "coarse", coarse) != digest(folder, "plain", {coarse[0]}));
  CHECK(holds(read_file(folder / "coarse" / "report.json"), "\"stands_for\":8.0"));
  CHECK(!holds(read_file(folder / "plain" / "report.json"), "stands_for"));
}

TEST_CASE("contradictory forces shall be told with their place and a remedy") {
  const std::string twice =
      said({"fluid_forces=[{model: archimedes}, {model: pressure_gradient, hydrostatic: true}]"});
  CHECK(holds(twice, "2: "));
  CHECK(holds(twice,
              "error: fluid_forces[1]: 'pressure_gradient' gives the hydrostatic buoyancy, as "
              "'archimedes' (fluid_forces[0]) does: "));
  CHECK(holds(twice, "it would count twice; remove one of them"));
  const std::string set = said({"fluid.momentum_set=III"});
  CHECK(holds(set,
              "forces.yaml:34:13: error: fluid_forces[1]: 'pressure_gradient' gives the force "
              "of the pressure gradient, which momentum set III has in the drag already: "
              "remove it, or take momentum_set I or II"));
  CHECK(holds(set, "forces.yaml:35:13: error: fluid_forces[2]: 'viscous' gives"));
  CHECK(holds(said({"fluid_forces=[{model: magnus}, {model: magnus}]"}),
              "fluid_forces[1]: 'magnus' is given already by fluid_forces[0]"));
  CHECK(holds(said({"materials.sand.coarse_graining=2"}),
              "fluid_forces[7]: 'lubrication' acts between a wall and the grain itself, but a "
              "grain of 'sand' stands for smaller ones: remove it, or "
              "materials.sand.coarse_graining"));
  CHECK(holds(said({"materials.sand.coarse_graining=0.5"}),
              "materials.sand.coarse_graining: 0.5 is outside l >= 1"));
  CHECK(holds(said({"fluid_forces={model: magnus}"}),
              "fluid_forces: a list of '- model: ...' is expected, not a map"));
  CHECK(holds(said({"fluid_forces=[{model: mangus}]"}), "did you mean 'magnus'?"));
  CHECK(holds(said({"fluid_forces=[{model: basset, window: 3 mm}]"}), "fluid_forces[0].window"));
  CHECK(holds(said({"fluid.turbulence={model: smagorinsky, coefficient: 2}"}),
              "fluid.turbulence.coefficient: 2 is outside 0 < C_s <= 0.3"));
  CHECK(holds(said({"fluid.turbulence={model: k_epsilon}"}),
              "fluid.turbulence.model: unknown turbulence model 'k_epsilon'"));
  CHECK(said({}).rfind("0: ", 0) == 0);
}

TEST_CASE("the fluid shall run alone, grains alone, and grains without a back effect") {
  const TemporaryFolder folder;
  // A lid that moves over a liquid without grains.
  const std::vector<std::string> alone = {
      "emitters.drop.enabled=false",
      "domain.boundaries.top.air={model: moving_wall, velocity: [0.1, 0, 0 m/s]}"};
  const std::string fluid = digest(folder, "fluid", alone);
  const fs::path out = folder / "fluid";
  for (const char* file : {"results.h5", "fluid.xdmf", "series.csv", "report.html"}) {
    CHECK(fs::file_size(out / file) > 0);
  }
  CHECK(json_text(out / "summary.json", "emitted") == "0");
  CHECK(std::stoll(json_text(out / "summary.json", "pressure_iterations")) > 0);
  auto slower = alone;
  slower[1] = "domain.boundaries.top.air={model: moving_wall, velocity: [0.05, 0, 0 m/s]}";
  CHECK(digest(folder, "slower", slower) != fluid);
  const fs::path half = folder / "half";
  REQUIRE(engine({"run", k_scenario, "-o", half, "--quiet", "--set", alone[0], "--set", alone[1],
                  "--set", "time.end=5 ms"})
              .status == 0);
  REQUIRE(engine({"run", k_scenario, "-o", half, "--quiet", "--set", alone[0], "--set", alone[1],
                  "--resume"})
              .status == 0);
  CHECK(json_text(half / "summary.json", "state_sha256") == fluid);

  const std::string both = digest(folder, "both", {});
  const std::string one_way = digest(folder, "one_way", {"coupling.one_way=true"});
  const std::string dry = digest(folder, "dry", {"fluid=none"});
  CHECK(both != one_way);
  CHECK(dry != one_way);
  CHECK(json_text(folder / "dry" / "summary.json", "emitted") == "3");
}
