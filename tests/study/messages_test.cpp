// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using dust::test::engine;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_head = "base: drop.yaml\nmeasure: {emitted: particles.emitted}\n";

/// The one message of a study that is refused before anything is written, without the folder's
/// name.
std::string message_of(const std::string& text) {
  const TemporaryFolder folder;
  fs::copy_file(DUST_SOURCE "/tests/study/drop.yaml", folder / "drop.yaml");
  const std::string file = folder / "s.yaml";
  std::ofstream(file) << text;
  const auto run = engine({"study", file, "-o", folder / "out"});
  CHECK(run.status == 2);
  CHECK(run.out.empty());
  CHECK_FALSE(fs::exists(folder / "out"));
  std::string reported = run.err;
  const std::string stem = file.substr(0, file.size() - std::string("s.yaml").size());
  for (auto at = reported.find(stem); at != std::string::npos; at = reported.find(stem)) {
    reported.erase(at, stem.size());
  }
  return reported;
}

void check_message(const std::string& text, const std::string& expected) {
  CAPTURE(text);
  CHECK(message_of(text) == expected + "\n");
}

}  // namespace

TEST_CASE("a study with an unknown path shall be told once, with what was meant") {
  check_message(k_head + "vary: {emitters.feed.mass_flw: [1, 2, 3 g/s]}\n",
                "s.yaml:3:8: error: unknown key 'mass_flw' in emitters.feed; did you mean "
                "'mass_flow'?");
  check_message(k_head + "vary: {emitters.fed.mass_flow: [1, 2 g/s]}\n",
                "s.yaml:3:8: error: there is no emitter 'fed'; did you mean 'feed'?");
  check_message(k_head + "vary: {'interactions[3].contact.friction': [0.1, 0.2]}\n",
                "s.yaml:3:8: error: interactions has 1 elements, counted from 0");
  check_message(k_head + "set: {time.edn: 1 s}\nreplicates: 2\n",
                "s.yaml:3:7: error: unknown key 'edn' in time; did you mean 'end'?");
}

TEST_CASE("all that is wrong in a study shall be told at once, also beside an unknown key") {
  const std::string measure = "measure: {m: sensors.out.forwrd.mass}\n";
  const std::string of_measure =
      "s.yaml:3:14: error: m: 'sensors.out.forwrd.mass' is no quantity of a run; did you mean "
      "'sensors.out.forward.mass'?\n";
  const std::string head = "base: drop.yaml\ntitel: a\n" + measure;
  const std::string of_key =
      "s.yaml:2:1: error: unknown key 'titel' in the study; did you mean 'title'?\n";
  check_message(head + "vary: {emitters.feed.mass_flw: [1, 2 g/s]}\n",
                of_key + of_measure +
                    "s.yaml:4:8: error: unknown key 'mass_flw' in emitters.feed; did you mean "
                    "'mass_flow'?");
  check_message(
      head + "vary: {emitters.fed.mass_flow: [1, 2 g/s]}\n",
      of_key + of_measure + "s.yaml:4:8: error: there is no emitter 'fed'; did you mean 'feed'?");
  check_message(head + "set: {time.edn: 1 s}\nvary: {emitters.feed.mass_flow: [1, 2 mm]}\n",
                of_key + of_measure +
                    "s.yaml:4:7: error: unknown key 'edn' in time; did you mean 'end'?\n"
                    "s.yaml:5:37: error: emitters.feed.mass_flow: 'mm' is the unit of a length: a "
                    "mass flow is expected (kg/s, g/s, t/h, tph)");
  // What cannot be read makes no point that could be looked at.
  check_message("base: drop.yaml\nvari: {time.end: [20, 40 ms]}\n" + measure,
                "s.yaml:2:1: error: unknown key 'vari' in the study; did you mean 'vary'?");
}

TEST_CASE("what is wrong with some points shall be told once, with what makes the first of them") {
  const auto holds = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != std::string::npos);
    CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  };
  holds(message_of(k_head + "vary: {domain.max: [[10, 10, 20 mm], [10, 10, 12 mm]], "
                            "emitters.feed.mass_flow: [1, 2 g/s]}\n"),
        "(points 3, 4; numbers of the first, with domain.max: [10, 10, 12 mm], "
        "emitters.feed.mass_flow: 1 g/s)");
  holds(message_of(k_head +
                   "replicates: 2\ncases:\n  fine: {}\n  light: {materials.sand.density: 2.6}\n"),
        "(points 3, 4; with case: light)");
  // Where all of them have it, the place is enough.
  holds(message_of(
            k_head +
            "set: {materials.sand.density: 2.6}\nvary: {gravity: [[0, 0, -9.8], [0, 0, 0]]}\n"),
        "raise the speed to 17.1703 m/s\n");
}

TEST_CASE("a run to start from that is not there shall be told by a study and by a check") {
  const std::string gone = "gone holds no checkpoint.h5: run that scenario first, with -o ";
  check_message(k_head + "set: {start_from: gone, time.end: 1 s}\nreplicates: 2\n",
                "s.yaml:3:19: error: start_from: " + gone + "gone");
  const TemporaryFolder folder;
  const auto check = engine({"check", DUST_SOURCE "/tests/study/drop.yaml", "--set",
                             "start_from=" + (folder / "gone").string()});
  CHECK(check.status == 2);
  CHECK(check.err.find("error: start_from: " + (folder / gone).string()) != std::string::npos);
}

TEST_CASE("a scenario that is given for a study shall be told to be one") {
  const TemporaryFolder folder;
  const auto run = engine({"study", DUST_SOURCE "/tests/study/drop.yaml", "-o", folder / "out"});
  CHECK(run.status == 2);
  CHECK(run.err.find("error: this is a scenario, not a study: engine run ") != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

TEST_CASE("a study with a wrong unit shall be told once, where it stands") {
  check_message(k_head + "vary: {emitters.feed.mass_flow: [1, 2, 3 mm]}\n",
                "s.yaml:3:40: error: emitters.feed.mass_flow: 'mm' is the unit of a length: a mass "
                "flow is expected (kg/s, g/s, t/h, tph)");
  check_message(k_head + "vary:\n  emitters.feed.mass_flow: {from: 1 g/s, to: 2 kg/s, count: 2}\n",
                "s.yaml:4:46: error: vary.emitters.feed.mass_flow: write both ends in one unit");
  check_message(
      "base: drop.yaml\nreplicates: 2\nmeasure: {e: {quantity: "
      "sensors.energy.translation, unit: kg}}\n",
      "s.yaml:3:25: error: e: 'kg' is no unit of sensors.energy.translation, which is "
      "told in J");
}

TEST_CASE("a path with an index that lacks its quotes shall be told how it is written") {
  check_message(
      k_head + "vary: {interactions[0].contact.friction: [0.1, 0.2]}\n",
      "s.yaml:3:20: error: not valid YAML: end of map flow not found; a key with brackets "
      "stands in quotes: 'interactions[0].contact.friction'");
}

TEST_CASE("an empty grid shall be told") {
  check_message(k_head + "vary: {emitters.feed.mass_flow: []}\n",
                "s.yaml:3:33: error: vary.emitters.feed.mass_flow: the list is empty: give at "
                "least one value");
  check_message(k_head + "vary: {}\n",
                "s.yaml:3:7: error: vary: nothing is given: a map of paths and values is expected");
  check_message(k_head + "vary: {time.end: {from: 1 s, to: 2 s, count: 0}}\n",
                "s.yaml:3:46: error: vary.time.end.count: 0 is outside 1 <= count <= 10000");
  check_message(k_head,
                "s.yaml:1:1: error: nothing is varied: give vary, zip, cases, sample or "
                "replicates");
  check_message(k_head + "zip: {time.end: [20, 40 ms], seed: [1, 2, 3]}\n",
                "s.yaml:3:36: error: zip.seed: 3 values stand beside the 2 of time.end");
}

TEST_CASE("an output that is no quantity shall be told with what there is") {
  check_message("base: drop.yaml\nreplicates: 2\nmeasure: {m: sensors.out.forwrd.mass}\n",
                "s.yaml:3:14: error: m: 'sensors.out.forwrd.mass' is no quantity of a run; did you "
                "mean 'sensors.out.forward.mass'?");
  check_message("base: drop.yaml\nreplicates: 2\nmeasure: {m: sensors.elsewhere.x}\n",
                "s.yaml:3:14: error: m: 'sensors.elsewhere.x' is no quantity of a run; sensors "
                "has: out, energy");
  check_message(
      "base: drop.yaml\nmeasure: {m: sensors.out.forward.mass}\n"
      "cases: {with: {}, without: {sensors.out.enabled: false}}\n",
      "s.yaml:2:14: error: m: 'sensors.out.forward.mass' is no quantity of every point; "
      "sensors has: energy");
}

TEST_CASE("a sensor that its direction leaves without an axis shall be told with its place") {
  check_message(
      "base: drop.yaml\nreplicates: 2\nmeasure: {m: particles.emitted}\n"
      "set: {sensors.heap: {model: angle_of_repose, direction: [0, 0, 1]}}\n",
      "s.yaml:4:29: error: sensors.heap: angle_of_repose: 'direction' is not level");
}

TEST_CASE("two points with one name, or of one scenario, shall be told") {
  check_message(k_head +
                    "cases:\n  - {name: a, set: {time.end: 20 ms}}\n"
                    "  - {name: a, set: {time.end: 40 ms}}\n",
                "s.yaml:5:12: error: cases: two points are called 'a'; the first stands in line 4");
  check_message(k_head + "cases:\n  a: {time.end: 20 ms}\n  a: {time.end: 40 ms}\n",
                "s.yaml:5:3: error: duplicate key 'a': already given in line 4");
  check_message(k_head + "vary:\n  time.end: [20 ms, 40 ms, 0.02 s]\n",
                "s.yaml:4:28: error: two points are the same run: '0.02 s' makes the scenario of "
                "'20 ms' in line 4; take one of them out");
  check_message(k_head + "vary: {seed: [1, 2, 3]}\n",
                "s.yaml:3:8: error: points that differ by the seed alone are the same run, for a "
                "study gives the seeds itself: write 'replicates: 3' instead, and 'seed: N' in the "
                "study for the first of them");
  check_message(k_head + "vary: {time.end: [20, 40 ms]}\nzip: {time.end: [20, 40 ms]}\n",
                "s.yaml:4:1: error: time.end is varied twice: by this and by another part of the "
                "study");
}

TEST_CASE("a value set for all points of a path that is varied shall be told") {
  const std::string set = k_head + "set: {time.end: 30 ms}\n";
  check_message(set + "vary: {time.end: [20, 40 ms]}\n",
                "s.yaml:3:7: error: set.time.end: it is varied, so this value is in no point: take "
                "one of them out");
  check_message(set + "cases: {a: {time.end: 20 ms}, b: {time.end: 40 ms}}\n",
                "s.yaml:3:7: error: set.time.end: it is varied, so this value is in no point: take "
                "one of them out");
  check_message(
      "base: drop.yaml\nset: {time.end: 30 ms}\ncalibrate:\n  targets: {m: {quantity: "
      "sensors.out.forward.mass, value: 20 mg, error: 1 mg}}\n  parameters: {t: {path: "
      "time.end, from: 30 ms, to: 40 ms}}\n",
      "s.yaml:2:7: error: set.time.end: it is calibrated, so this value is in no point: "
      "take one of them out");
  // Cases that leave it alone have what is set.
  const TemporaryFolder folder;
  fs::copy_file(DUST_SOURCE "/tests/study/drop.yaml", folder / "drop.yaml");
  const std::string file = folder / "s.yaml";
  std::ofstream(file) << set + "cases: {a: {}, b: {time.end: 40 ms}}\n";
  const auto kept = engine({"study", file, "-o", folder / "out", "--dry-run"});
  INFO(kept.err);
  CHECK(kept.status == 0);
}

TEST_CASE("expectations and calibrations shall be checked against the study") {
  const std::string vary = k_head + "vary: {time.end: [20, 40 ms]}\n";
  check_message(vary + "expect: [{output: emited, input: time.end, then: rises}]\n",
                "s.yaml:4:19: error: expect[0].output: there is no measure 'emited'; did you mean "
                "'emitted'?");
  check_message(vary + "expect: [{output: emitted, input: seed, then: rises}]\n",
                "s.yaml:4:35: error: expect[0].input: 'seed' is not varied; there are: time.end");
  check_message(vary + "expect: [{output: emitted, input: time.end, then: grows}]\n",
                "s.yaml:4:51: error: expect[0].then: 'grows' is none of rises, falls");
  const std::string held = k_head +
                           "vary: {time.end: [20, 40 ms], seed: [1, 2]}\nexpect: [{output: "
                           "emitted, input: seed, then: rises, at: ";
  check_message(held + "20 ms}]\n",
                "s.yaml:4:58: error: expect[0].at: a map of paths and levels is expected, like "
                "{bodies.belt.speed: 0.2 m/s}, not '20 ms'");
  check_message(
      held + "{time.ent: 20 ms}}]\n",
      "s.yaml:4:59: error: expect[0].at: 'time.ent' is not varied; did you mean 'time.end'?");
  check_message(held + "{time.end: 30 ms}}]\n",
                "s.yaml:4:69: error: expect[0].at.time.end: there is no level '30 ms'; there are: "
                "20 ms, 40 ms");
  check_message(held + "{seed: 1}}]\n",
                "s.yaml:4:59: error: expect[0].at: seed is the input itself");
  const std::string targets =
      "base: drop.yaml\ncalibrate:\n  targets: {m: {quantity: sensors.out.forward.mass, value: 20 "
      "mg, error: 1 mg}}\n  parameters: ";
  check_message(targets + "{f: {path: 'interactions[0].contact.frction', from: 0.1, to: 0.5}}\n",
                "s.yaml:4:16: error: unknown key 'frction' in interactions[0].contact; did you "
                "mean 'friction'?");
  check_message(targets + "{f: {path: time.end, from: 40 ms, to: 20 ms}}\n",
                "s.yaml:4:53: error: calibrate.parameters.f.to: must be above from");
  check_message(targets +
                    "{f: {path: time.end, from: 20 ms, to: 40 ms}}\n  surrogate: quadratic\n"
                    "  runs: 4\n",
                "s.yaml:6:9: error: calibrate.runs: quadratic learns from 5 runs or more where 1 "
                "parameter is sought");
}

TEST_CASE("a study file shall be told of what is wrong with itself") {
  check_message(
      "measure: {emitted: particles.emitted}\nreplicates: 2\n",
      "s.yaml:1:1: error: missing key 'base' (text: The scenario that is varied, relative "
      "to this file.)");
  check_message("base: none.yaml\nmeasure: {emitted: particles.emitted}\nreplicates: 2\n",
                "s.yaml:1:7: error: base: there is no file none.yaml");
  check_message(
      "base: drop.yaml\nmeasure: {m: {quantity: particles.emitted, minus: [particles.left]}}\n"
      "replicates: 2\n",
      "s.yaml:2:51: error: measure.m.minus: a text is expected, not a list");
  check_message(k_head + "vari: {time.end: [20 ms]}\nreplicates: 2\n",
                "s.yaml:3:1: error: unknown key 'vari' in the study; did you mean 'vary'?");
}

TEST_CASE("a cluster without commands shall be told") {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const auto run = engine({"study", DUST_SOURCE "/tests/study/drop_study.yaml", "-o",
                           folder / "out", "--launcher", "slurm"});
  setenv("PATH", path.c_str(), 1);
  CHECK(run.status == 2);
  CHECK(run.err ==
        "error: --launcher slurm: there is no sbatch in PATH; run the study where the cluster's "
        "commands are, or with --launcher local\n");
  CHECK_FALSE(fs::exists(folder / "out"));
}
