// SPDX-License-Identifier: Apache-2.0
// Plugins that are well until they are used: the run ends, and says which model of which file did
// what, what was expected, and how to go on.
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::json_text;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const fs::path k_folder = BAD_PLUGINS;
const std::string k_scenario = DUST_SOURCE "/tests/scenario/forces.yaml";

std::vector<std::string> with_drag(const char* command, const std::string& library,
                                   const std::string& law) {
  return {command, k_scenario, "--plugin-path", k_folder / library, "--set", "drag.model=" + law};
}

/// Runs with the law of a bad library; the run fails with the words `begin` ... `end`.
void check_run(const std::string& library, const std::string& law, const std::string& begin,
               const std::string& end) {
  const TemporaryFolder folder;
  const fs::path out = folder / "run";
  auto arguments = with_drag("run", library, law);
  arguments.insert(arguments.end(), {"-o", out, "--quiet"});
  const auto run = engine(arguments);
  INFO(run.err);
  CHECK(run.status == 1);
  const std::string who =
      "drag/" + law + " (" + (k_folder / library / (library + ".so")).string() + ") ";
  const std::size_t at = run.err.find(who + begin);
  REQUIRE(at != std::string::npos);
  CHECK(run.err.find(end + "\n", at) != std::string::npos);
  CHECK(run.err.find("the last good checkpoint is " + (out / "checkpoint.h5").string()) !=
        std::string::npos);
  CHECK(json_text(out / "summary.json", "status") == "failed");
  CHECK(fs::exists(out / "checkpoint.h5"));
}

/// The engine ends by `signal` and has said what it asked of a law of the library `crashes`.
void check_crash(const std::vector<std::string>& arguments, int signal, const std::string& name,
                 const std::string& law, const std::string& asked) {
  const auto run = engine(arguments);
  INFO(run.err);
  CHECK(run.status == 128 + signal);
  const std::string file = k_folder / "crashes/crashes.so";
  CHECK(run.err.ends_with("error: crashed (" + name + ") while drag/" + law + " (" + file + ") " +
                          asked + "; loaded plugins that are not the engine's own: " + file +
                          "\n"));
}

}  // namespace

TEST_CASE("a plugin that crashes shall end the engine by its signal, with what it was asked") {
  const TemporaryFolder folder;
  const std::string gave_up = "SIGABRT, its own code gave up";
  auto run = with_drag("run", "crashes", "gives_up");
  run.insert(run.end(), {"-o", folder / "run", "--quiet"});
  check_crash(run, SIGABRT, gave_up, "gives_up", "was asked for evaluate");
  check_crash(with_drag("check", "crashes", "stillborn"), SIGABRT, gave_up, "stillborn",
              "was made");
  check_crash({"test-plugin", k_folder / "crashes/crashes.so"}, SIGABRT, gave_up, "gives_up",
              "was tried with values for its parameters");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they report it themselves
  run = with_drag("run", "crashes", "null_pointer");
  run.insert(run.end(), {"-o", folder / "other_run", "--quiet"});
  check_crash(run, SIGSEGV, "SIGSEGV, memory that it may not use", "null_pointer",
              "was asked for evaluate");
#endif
}

TEST_CASE("a library that crashes while it is opened shall be named as the engine's own is not") {
  for (const char* library : {"crashes_on_load", "throws_on_load"}) {
    const std::string file = k_folder / library / (std::string(library) + ".so");
    const auto check = engine(with_drag("check", library, "constant"));
    INFO(check.err);
    CHECK(check.status == 128 + SIGABRT);
    CHECK(check.err.ends_with("error: crashed (SIGABRT, its own code gave up) while " + file +
                              " was loaded; loaded plugins that are not the engine's own: " + file +
                              "\n"));
  }
}

TEST_CASE("a plugin that ends the program shall fail the run, with what it was asked") {
  const std::string file = k_folder / "ends_program/ends_program.so";
  const std::string begin = "error: ended by a call of exit() that is not the engine's while ";
  const std::string loaded = "; loaded plugins that are not the engine's own: ";
  const auto line = [&](const std::string& law, const std::string& asked) {
    return begin + "drag/" + law + " (" + file + ") " + asked + loaded + file + "\n";
  };
  for (const std::string law : {"leaves", "leaves_quickly"}) {
    const TemporaryFolder folder;
    auto arguments = with_drag("run", "ends_program", law);
    arguments.insert(arguments.end(), {"-o", folder / "run", "--quiet"});
    const auto run = engine(arguments);
    INFO(run.err);
    CHECK(run.status == 1);
    CHECK(run.err.ends_with(line(law, "was asked for evaluate") +
                            "error: the last good checkpoint is " +
                            (folder / "run/checkpoint.h5").string() +
                            ": --resume goes on from it once the plugin is mended\n"));
  }
  const auto check = engine(with_drag("check", "ends_program", "leaves_early"));
  CHECK(check.status == 2);
  CHECK(check.err.ends_with(line("leaves_early", "was made")));
  CHECK(engine({"test-plugin", file}).status == 2);
  const std::string loads = k_folder / "ends_on_load/ends_on_load.so";
  const auto opened = engine(with_drag("check", "ends_on_load", "constant"));
  CHECK(opened.status == 2);
  CHECK(opened.err == begin + loads + " was loaded" + loaded + loads + "\n");
}

TEST_CASE("a plugin that could end the program and does not shall leave the engine's own end") {
  const auto check = engine({"check", k_scenario, "--plugin-path", k_folder / "ends_program"});
  INFO(check.err);
  CHECK(check.status == 0);
  CHECK(engine({"--help"}).status == 0);
  CHECK(engine({"check", k_folder / "no.yaml"}).status == 2);
  const TemporaryFolder folder;
  const fs::path out = folder / "run";
  const auto run =
      dust::test::engine_interrupted({"run", k_scenario, "--plugin-path", k_folder / "ends_program",
                                      "--set", "time.end=100 s", "-o", out, "--quiet"},
                                     SIGTERM, out / "series.csv", 3);
  INFO(run.err);
  CHECK(run.status == 128 + SIGTERM);
  CHECK(run.err.find("exit()") == std::string::npos);
}

TEST_CASE("a liberation law shall have the load by rounding more, and no more than that") {
  const std::string bounce = DUST_SOURCE "/tests/scenario/dusty_bounce.yaml";
  const auto run = [&](const std::string& excess, const fs::path& out) {
    return engine({"run", bounce, "--plugin-path", k_folder / "overdraws", "-o", out, "--quiet",
                   "--set", "dust.liberation={model: overdraws, excess: " + excess + "}"});
  };
  const TemporaryFolder folder;
  const auto rounded = run("1e-13", folder / "rounded");
  CHECK_MESSAGE(rounded.status == 0, rounded.err);
  const auto summary =
      nlohmann::json::parse(dust::test::read_file(folder / "rounded/summary.json"));
  for (const auto& [name, of_class] : summary["dust_on_grains"]["classes"].items()) {
    CHECK(of_class["set_free_kg"] == of_class["entered_kg"]);
  }
  const auto more = run("1e-11", folder / "more");
  INFO(more.err);
  CHECK(more.status == 1);
  CHECK(more.err.find("liberation law 'overdraws': grain ") != std::string::npos);
  CHECK(more.err.find(" kg of dust and is to lose ") != std::string::npos);
  CHECK(more.err.find(" kg: what comes off lies between 0 and the load") != std::string::npos);
}

TEST_CASE("a model whose values cannot be guessed shall be told, and the others tested") {
  const std::string file = k_folder / "needs_values/needs_values.so";
  const std::string why = "no value can be guessed; write --set table=VALUE (File of factors.)";
  const auto tested = engine({"test-plugin", file});
  INFO(tested.out);
  CHECK(tested.status == 2);
  CHECK(tested.out.find("drag/tabled 1.0 (" + file + ")\n  NOT TESTED  " + why + "\n") !=
        std::string::npos);
  CHECK(tested.out.find("drag/smooth 1.0 (" + file + ")\n  pass  ") != std::string::npos);
  CHECK(tested.out.ends_with("\nall rules are kept; 1 of 2 models not tested\n"));
  const auto given = engine({"test-plugin", file, "--set", "table=ab"});
  INFO(given.out);
  CHECK(given.out.find("NOT TESTED") == std::string::npos);
  const auto json = nlohmann::json::parse(engine({"test-plugin", file, "--json"}).out);
  CHECK(json.at(0)["not_tested"] == why);
  CHECK(json.at(0)["rules"].empty());
  CHECK_FALSE(json.at(1).contains("not_tested"));
}

TEST_CASE("a plugin that throws in a batch shall end the run with kind, name, file and words") {
  check_run("throws_in_batch", "brittle",
            "throws in evaluate: the table ends at Re = 100; expected: a factor for every grain of "
            "the batch",
            "");
}

TEST_CASE("a plugin that gives no number shall end the run with the row and what it saw") {
  check_run("not_a_number", "rootless", "gives factor = nan in row ",
            "; expected: a finite number");
}

TEST_CASE(
    "a sensor that throws shall be told with its name and place, before anything is written") {
  for (const std::string fault : {"summary", "report"}) {
    for (const char* command : {"check", "run"}) {
      const TemporaryFolder folder;
      std::vector<std::string> arguments = {
          command,         k_scenario,
          "--plugin-path", k_folder / "bad_sensors",
          "--set",         "sensors.eye={model: broken_" + fault + "}"};
      const fs::path out = folder / "run";
      if (std::string(command) == "run") arguments.insert(arguments.end(), {"-o", out});
      const auto done = engine(arguments);
      INFO(done.err);
      CHECK(done.status == 2);
      CHECK(done.err.find("sensors.eye: its figures cannot be asked for: sensor/broken_" + fault +
                          " (" + (k_folder / "bad_sensors/bad_sensors.so").string() +
                          ") throws in " + fault + ": broken " +
                          (fault == "summary" ? "sum" : "report")) != std::string::npos);
      CHECK_FALSE(fs::exists(out));
    }
  }
}

TEST_CASE("a sensor whose figures no file can hold shall be refused with its place and what fits") {
  const std::pair<const char*, const char*> faults[] = {
      {"comma",
       "asked for series, gives a figure 'left, right'; expected: a name of snake_case words with "
       "'/' between them"},
      {"nameless",
       "asked for summary, gives a figure ''; expected: a name of snake_case words with '/' "
       "between them"},
      {"twice", "asked for series, gives a figure 'looks' twice; expected: every name once"},
      {"unitless",
       "asked for summary, gives the figure 'times' the unit ''; expected: a unit, for a bare "
       "number \"1\""},
      {"cells",
       "asked for fields, gives 2 numbers for its field 'map'; expected: one for each of its 8 "
       "cells"}};
  for (const auto& [model, words] : faults) {
    const auto check = engine({"check", k_scenario, "--plugin-path", k_folder / "bad_sensors",
                               "--set", "sensors.eye={model: " + std::string(model) + "}"});
    INFO(check.err);
    CHECK(check.status == 2);
    CHECK(check.err.find(": error: sensors.eye: its figures cannot be asked for: sensor/" +
                         std::string(model) + " (" +
                         (k_folder / "bad_sensors/bad_sensors.so").string() + "), " + words +
                         "\n") != std::string::npos);
  }
}

TEST_CASE("a law whose collision time is none shall be refused at its place before the run") {
  const std::pair<const char*, const char*> answers[] = {
      {"zero", "0"}, {"negative", "-1e-06"}, {"not_a_number", "nan"}};
  for (const auto& [law, answer] : answers) {
    for (const char* command : {"check", "run"}) {
      const TemporaryFolder folder;
      const fs::path out = folder / "run";
      std::vector<std::string> arguments = {
          command,         k_scenario,
          "--plugin-path", k_folder / "timeless",
          "--set",         "interactions.sand-sand.contact={model: " + std::string(law) + "}"};
      if (std::string(command) == "run") arguments.insert(arguments.end(), {"-o", out});
      const auto done = engine(arguments);
      INFO(done.err);
      CHECK(done.status == 2);
      CHECK(done.err.find("--set interactions.sand-sand.contact") != std::string::npos);
      CHECK(done.err.find(": error: interactions[0].contact: contact/" + std::string(law) + " (" +
                          (k_folder / "timeless/timeless.so").string() + ") answers " + answer +
                          " to collision_time; expected: a number above 0\n") != std::string::npos);
      CHECK_FALSE(fs::exists(out));
    }
  }
}

TEST_CASE("a sensor whose columns change shall end the run with the column that did") {
  const TemporaryFolder folder;
  const auto run = engine({"run", k_scenario, "--plugin-path", k_folder / "bad_sensors", "--set",
                           "sensors.eye={model: other_columns}", "-o", folder / "run", "--quiet"});
  INFO(run.err);
  CHECK(run.status == 1);
  CHECK(run.err.find("'eye/looks [1]' is 'eye/gazes [1]' now") != std::string::npos);
}

TEST_CASE("a sensor that throws after the last step shall fail the run with its reason") {
  const TemporaryFolder folder;
  const fs::path out = folder / "run";
  const auto run = engine({"run", k_scenario, "--plugin-path", k_folder / "bad_sensors", "--set",
                           "sensors.eye={model: late_summary}", "-o", out, "--quiet"});
  INFO(run.err);
  CHECK(run.status == 1);
  CHECK(run.err.find("the run failed at t = ") != std::string::npos);
  CHECK(run.err.find("sensor/late_summary") != std::string::npos);
  CHECK(run.err.find("broken sum") != std::string::npos);
  CHECK(run.err.find("the last good checkpoint is " + (out / "checkpoint.h5").string()) !=
        std::string::npos);
}

TEST_CASE("a plugin under a shipped model's name shall be refused, by its test too") {
  const std::string file = k_folder / "shipped_name/shipped_name.so";
  const auto tested = engine({"test-plugin", file});
  INFO(tested.err);
  CHECK(tested.status == 2);
  CHECK(tested.err.starts_with(file +
                               ": error: offers drag/gidaspow, which the engine has already ("));
  CHECK(tested.err.ends_with("): choose another name for the model\n"));
  const auto check = engine(with_drag("check", "shipped_name", "gidaspow"));
  CHECK(check.status == 2);
  CHECK(check.err == tested.err);
  CHECK(engine({"test-plugin", k_folder / "good/good.so"}).status == 1);  // it says no source
}

TEST_CASE("a model that nobody offers shall be refused with names and folders searched") {
  const auto check = engine(with_drag("check", "good", "rootles"));
  CHECK(check.status == 2);
  INFO(check.err);
  CHECK(check.err.starts_with("--set drag.model: error: drag.model: unknown drag model 'rootles'"));
  CHECK(check.err.find("(drag models: abraham, beetstra, constant, ") != std::string::npos);
  CHECK(check.err.find("; plugins were looked for in " + (k_folder / "good").string() + ", " +
                       fs::path(DUST_TEST_PLUGINS).string() +
                       " (--plugin-path and DUST_PLUGIN_PATH name more folders)") !=
        std::string::npos);
}

TEST_CASE("every bad library shall be refused before anything is written") {
  for (const char* library :
       {"older", "newer", "other_compiler", "other_sizes", "no_handshake", "no_register",
        "missing_symbol", "throws_on_register", "no_models", "bad_names"}) {
    const TemporaryFolder folder;
    const fs::path out = folder / "run";
    const auto run = engine({"run", k_scenario, "--plugin-path", k_folder / library, "-o", out});
    INFO(library);
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(run.err.starts_with((k_folder / library / library).string() + ".so: error: "));
    CHECK(!fs::exists(out));
  }
}
