// SPDX-License-Identifier: Apache-2.0
#include "report/run_text.hpp"
#include "study/hoods/hood_scene.hpp"
#include "support/approx.hpp"
#include "support/engine.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::holds;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/study/dusty_wake.yaml";

/// Runs the scenario into a folder.
void run(const fs::path& out, std::vector<std::string> settings = {}) {
  std::vector<std::string> arguments{"run", k_scenario, "-o", out, "--quiet"};
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  const auto done = engine(arguments);
  INFO(done.err);
  REQUIRE(done.status == 0);
}

/// What is said of a folder that no hood can be suggested for.
std::string refused(const fs::path& folder) {
  const auto done = engine({"suggest-hoods", folder, "-o", folder / "hoods.yaml"});
  CHECK(done.status == 2);
  CHECK(done.out.empty());
  CHECK(!fs::exists(folder / "hoods.yaml"));
  return done.err;
}

}  // namespace

TEST_CASE("the dust that places of hoods are ranked by shall be that in the air") {
  // A cloud among cells that a box cuts: they hold less gas.
  const TemporaryFolder folder;
  const auto done =
      engine({"run", DUST_SOURCE "/tests/scenario/dust_on_box.yaml", "-o", folder / "out",
              "--quiet", "--set", "dust.field.clouds.cloud.min=[0, 0, 20 mm]", "--set",
              "dust.field.clouds.cloud.max=[120, 80, 70 mm]", "--set", "time.end=20 ms", "--set",
              "time.output_every=20 ms", "--set", "frames.turned.angle=20 deg"});
  INFO(done.err);
  REQUIRE(done.status == 0);
  const auto run = dust::report::read_run_text(folder / "out");
  const dust::study::HoodScene scene(folder / "out", run);
  const double airborne = run.summary["dust_field"]["classes"]["50_um"]["airborne_kg"];
  // Frames are of single precision.
  CHECK(scene.dust_in({0, 0, 0}, {0.12, 0.08, 0.1}) == dust::test::approx(airborne).epsilon(1e-5));
}

TEST_CASE("a run shall give a study of hoods, and the study what each hood captures") {
  const TemporaryFolder folder;
  run(folder / "wake");
  const std::string file = folder / "hoods.yaml";
  const auto written = engine({"suggest-hoods", folder / "wake", "--flows", "6, 30 l/min",
                               "--places", "1", "--duration", "0.24 s", "-o", file});
  INFO(written.err);
  REQUIRE(written.status == 0);
  CHECK(holds(written.out, "3 points of 0.24 s"));
  CHECK(holds(written.out, "mg/m3 of dust round the place"));
  const std::string text = read_file(file);
  INFO(text);
  CHECK(holds(text, "start_from: wake"));
  CHECK(holds(text, "sensors.exit.steady_after: 0.48 s"));
  CHECK(holds(text, "place_1_at_6_l_min:"));
  const std::string often = folder / "more often.yaml";
  const auto repeated =
      engine({"suggest-hoods", folder / "wake", "--flows", "6, 30 l/min", "--places", "1",
              "--duration", "0.24 s", "--replicates", "3", "-o", often});
  CHECK(holds(repeated.out, "9 points of 0.24 s"));
  CHECK(holds(repeated.out, "more often.yaml' -o "));  // as a shell wants it
  const auto plan = engine({"study", often, "--dry-run"});
  INFO(plan.err);
  CHECK(plan.status == 0);
  CHECK(holds(plan.out, "seed 3"));
  const std::string results = folder / "study";
  const auto study = engine({"study", file, "-o", results, "--quiet"});
  INFO(study.err);
  REQUIRE(study.status == 0);
  const auto answer = engine({"suggest-hoods", results, "--capture", "10 %"});
  INFO(answer.out);
  REQUIRE(answer.status == 0);
  CHECK(holds(answer.out, "plain"));
  CHECK(holds(answer.out, "6 l/min"));
  CHECK(holds(answer.out, "30 l/min"));
  CHECK(holds(answer.out, "Smallest flow that captures 10 % of the dust:"));
  // 30 l/min are more than what flows past: all dust is drawn out.
  CHECK(holds(answer.out, "place_1: "));
  CHECK(!holds(answer.out, "not reached"));
  // A study with a point missing says which line of the table it is.
  const std::string table = read_file(fs::path(results) / "study.csv");
  std::string broken = table;
  broken.replace(broken.rfind(",finished,"), 10, ",waiting,");
  std::ofstream(fs::path(results) / "study.csv") << broken;
  const auto unfinished = engine({"suggest-hoods", results});
  CHECK(unfinished.status == 2);
  CHECK(holds(unfinished.err, "study.csv:4: error: 1 of 3 points have not finished: engine study"));
}

TEST_CASE("a hood shall make grains expect its air's speed only where dust comes as grains") {
  const TemporaryFolder folder;
  const auto suggested = [&](const std::string& name, const std::vector<std::string>& settings) {
    run(folder / name, settings);
    const std::string file = folder / (name + ".yaml");
    const auto written = engine({"suggest-hoods", folder / name, "--flows", "6, 60 l/min",
                                 "--places", "1", "--duration", "0.12 s", "-o", file});
    INFO(written.err);
    REQUIRE(written.status == 0);
    return read_file(file);
  };
  // 60 l/min through 20 x 10 mm: 5 m/s in the mean, twice that at the edges.
  const std::string of_grains = suggested("grains", {});
  CHECK(holds(of_grains, "time.expected_speed: 10 m/s"));
  // Dust of a field makes no contacts, and grains of 60 um are none of it here.
  const std::string of_field = suggested(
      "field", {"dust={finer_than: 10 um, field: {classes: [5 um], material: fluff, sources: {s: "
                "{min: [10, 1, 30 mm], max: [30, 9, 36 mm], mass_flow: [0.02 mg/s]}}}}"});
  CHECK(holds(of_field, "flow: 60 l/min"));
  CHECK(!holds(of_field, "expected_speed"));
}

TEST_CASE("a run for which no hood can be suggested shall be refused with place and remedy") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  run(out, {"time.end=20 ms"});
  // Nothing is averaged before 0.2 s.
  CHECK(holds(refused(out), "sensors.suction has found no place of low pressure"));
  fs::remove(out / "checkpoint.h5");
  CHECK(holds(refused(out), "checkpoint.h5:1: error: is not there"));
  std::string summary = read_file(out / "summary.json");
  summary.replace(summary.find("finished"), 8, "interrupted");
  std::ofstream(out / "summary.json") << summary;
  CHECK(holds(refused(out), "summary.json:1: error: the run has not finished"));
  run(folder / "coarse", {"time.end=20 ms", "dust={finer_than: 10 um}"});
  const std::string coarse = refused(folder / "coarse");
  CHECK(holds(coarse, "the run has no dust"));
  CHECK(holds(coarse, "scenario.yaml:"));
  run(folder / "blind", {"time.end=20 ms", "sensors.suction.enabled=false"});
  CHECK(holds(refused(folder / "blind"), "no sensor looks for places of low pressure"));
  run(folder / "loose", {"time.end=20 ms", "sensors.exit.role=passage"});
  CHECK(holds(refused(folder / "loose"), "no sensor watches an opening"));
  // A dust field whose means have not begun: a study without measures would say nothing.
  run(folder / "early",
      {"time.end=0.24 s",
       "dust={finer_than: 10 um, steady_after: 0.24 s, field: {classes: [5 um], material: fluff, "
       "sources: {s: {min: [10, 1, 30 mm], max: [30, 9, 36 mm], mass_flow: [0.02 mg/s]}}}}"});
  CHECK(holds(refused(folder / "early"), "summary.json:1: error: dust_rates has no dust"));
  const auto flow = engine({"suggest-hoods", out, "--flows", "3 mm"});
  CHECK(flow.status == 2);
  CHECK(holds(flow.err, "--flows: 'mm' is the unit of a length"));
}

TEST_CASE("dust that lies where a new hood stands shall count as drawn out by it") {
  const TemporaryFolder folder;
  run(folder / "wake", {"time.end=0.2 s"});
  const auto with = [&](const std::string& body, const fs::path& out) {
    return engine({"run", k_scenario, "-o", out, "--set", "time.end=0.22 s", "--set",
                   "start_from=" + (folder / "wake").string(), "--set", "bodies.hood=" + body});
  };
  const std::string box =
      "shape: box, material: steel, min: [100, -1, 20 mm], max: [140, 11, 40 mm]";
  const auto solid = with("{" + box + "}", folder / "solid");
  CHECK(solid.status == 2);
  CHECK(holds(solid.err, "lie in it, the first, number"));
  const auto hood =
      with("{" + box + ", suction: {flow: 6 l/min, min: [100, 0, 20 mm], max: [100, 10, 40 mm]}}",
           folder / "hood");
  INFO(hood.err);
  REQUIRE(hood.status == 0);
  CHECK(holds(hood.err + hood.out, "of dust lie in it and count as drawn out by it"));
  const std::string summary = read_file(folder / "hood" / "summary.json");
  const auto number = [&](const std::string& key, std::size_t from) {
    const std::size_t at = summary.find("\"" + key + "\":", from);
    return std::stod(summary.substr(at + key.size() + 3));
  };
  const std::size_t particles = summary.find("\"particles\"");
  CHECK(number("removed", particles) > 0.0);
  CHECK(number("emitted", particles) ==
        number("in_domain", particles) + number("left", particles) + number("removed", particles));
}
