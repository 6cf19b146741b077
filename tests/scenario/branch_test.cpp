// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using dust::test::engine;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/small_transfer.yaml";

/// Runs a scenario and returns what the engine says.
dust::test::Outcome run(const fs::path& out, const std::string& end,
                        const std::vector<std::string>& settings = {},
                        const std::string& threads = "1",
                        const std::string& scenario = k_scenario) {
  std::vector<std::string> arguments{
      "run", scenario, "-o", out, "--set", "time.end=" + end, "--threads", threads, "--quiet"};
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  return engine(arguments);
}

std::string digest(const fs::path& out) { return json_text(out / "summary.json", "state_sha256"); }

/// The last row of the series.
std::string last_row(const fs::path& out) {
  const std::string text = read_file(out / "series.csv");
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

/// A box of 20 x 20 x 40 mm, open but for its bottom, with the rest of its scenario.
void write_box(const fs::path& file, const std::string& rest) {
  std::ofstream(file) << R"(name: box
domain:
  min: [0, 0, 0]
  max: [20, 20, 40 mm]
  boundaries:
    left: {grains: open}
    right: {grains: open}
    front: {grains: open}
    back: {grains: open}
    bottom: {grains: wall, material: sand}
    top: {grains: open}
materials:
  sand: {density: 2650, young_modulus: 5 MPa, poisson_ratio: 0.3}
fluid: none
)" << rest;
}

}  // namespace

TEST_CASE(
    "a run that starts from its own scenario's state shall have the bits of an unbroken one") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "whole", "24 ms").status == 0);
  REQUIRE(run(folder / "first", "14 ms", {}, "2").status == 0);
  const std::string from = "start_from=" + (folder / "first").string();
  for (const std::string threads : {"1", "2"}) {
    CAPTURE(threads);
    const fs::path out = folder / ("branch" + threads);
    const auto branch = run(out, "24 ms", {from, "time.output_every=5 ms"}, threads);
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    CHECK(digest(out) == digest(folder / "whole"));
    CHECK(last_row(out) == last_row(folder / "whole"));
    CHECK(json_text(out / "summary.json", "is_same_scenario") == "true");
    const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
    const auto first = nlohmann::json::parse(read_file(folder / "first" / "summary.json"));
    CHECK(summary["start_from"]["particle_steps"] == first["particle_steps"]);
    CHECK(summary["start_from"]["fluid_steps"] == 14);
  }
  // With a sensor less and another one more: what is there does not know of it.
  const auto other =
      run(folder / "sensor", "24 ms",
          {from, "sensors.lip.enabled=false", "sensors.more={model: kinetic_energy}"});
  INFO(other.err);
  REQUIRE(other.status == 0);
  CHECK(digest(folder / "sensor") == digest(folder / "whole"));
}

TEST_CASE("a run that started from another shall be resumed, also where that one is gone") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(run(first, "12 ms").status == 0);
  const std::vector<std::string> settings{"start_from=" + first.string(),
                                          "bodies.belt.speed=0.5 m/s"};
  REQUIRE(run(folder / "whole", "20 ms", settings).status == 0);
  REQUIRE(run(folder / "threads", "20 ms", settings, "2").status == 0);
  CHECK(digest(folder / "threads") == digest(folder / "whole"));
  REQUIRE(run(folder / "parts", "16 ms", settings).status == 0);
  fs::remove_all(first);
  const auto resumed = engine({"run", k_scenario, "-o", folder / "parts", "--set", "time.end=20 ms",
                               "--set", settings[0], "--set", settings[1], "--resume", "--quiet"});
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  CHECK(digest(folder / "parts") == digest(folder / "whole"));
}

TEST_CASE("grains shall be let in where the other run has taken a body away") {
  const TemporaryFolder folder;
  const fs::path scenario = folder / "plug.yaml";
  write_box(scenario,
            "time: {end: 40 ms, fluid_step: 1 ms, output_every: 10 ms}\n"
            "gravity: [0, 0, -9.81]\n"
            "interactions:\n"
            "  - between: [sand, sand]\n"
            "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.3}\n"
            "bodies:\n"
            "  plug: {shape: box, material: sand, min: [0, 0, 0], max: [20, 20, 5 mm], remove: "
            "{at: 5 ms}}\n"
            "emitters:\n"
            "  one: {model: single, material: sand, positions: [[10, 10, 6.1 mm]], diameters: [2 "
            "mm]}\n");
  // Fallen half into what was the plug.
  REQUIRE(run(folder / "first", "30 ms", {}, "1", scenario).status == 0);
  const std::vector<std::string> settings = {"start_from=" + (folder / "first").string(),
                                             "interactions[0].contact.restitution=0.6"};
  const auto branch = run(folder / "branch", "40 ms", settings, "1", scenario);
  INFO(branch.err);
  CHECK(branch.status == 0);
  const auto check = engine({"check", scenario, "--set", settings[0], "--set", settings[1]});
  INFO(check.err);
  CHECK(check.status == 0);
}

TEST_CASE("a branch shall rest what comes along on holes that its own grains fall through") {
  const TemporaryFolder folder;
  // A lump of 12 mm on a hole of 10, then a grain of 2 mm in its place among the emitters.
  const auto plate = [&](const std::string& name, const std::string& emitter) {
    const fs::path file = folder / (name + ".yaml");
    write_box(file, R"(bodies:
  plate: {shape: disc, material: sand, centre: [10, 10, 10 mm], axis: [0, 0, 1], radius: 9 mm,
          hole_radius: 5 mm, thickness: 2 mm}
interactions:
  - {between: [sand, sand], contact: {model: hertz_mindlin, restitution: 0.1, friction: 0.5}}
gravity: [0, 0, -9.81]
time: {end: 0.1 s, fluid_step: 1 ms, output_every: 50 ms}
emitters:
  )" + emitter);
    return file.string();
  };
  const std::string large = plate("large",
                                  "lump: {model: single, material: sand, positions: "
                                  "[[10, 10, 16 mm]], diameters: [12 mm]}\n");
  const std::string small = plate("small",
                                  "grain: {model: single, material: sand, positions: "
                                  "[[4, 4, 14 mm]], diameters: [2 mm], time: 0.15 s}\n");
  const auto first = run(folder / "first", "0.1 s", {}, "1", large);
  INFO(first.err);
  REQUIRE(first.status == 0);
  std::string from = (folder / "first").string();
  double end = 0.1;
  for (const std::string friction : {"0.4", "0.3"}) {
    CAPTURE(friction);
    const std::string setting = "interactions[0].contact.friction=" + friction;
    end += 0.1;
    const auto checked = engine({"check", small, "--set", "start_from=" + from, "--set", setting,
                                 "--set", "time.end=0.3 s"});
    INFO(checked.out << checked.err);
    CHECK(checked.status == 0);
    const fs::path out = folder / friction;
    const auto branch =
        run(out, std::to_string(end) + " s", {"start_from=" + from, setting}, "1", small);
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
    CHECK(summary["particles"]["in_domain"] == 2);
    CHECK(summary["contacts"] >= 24);
    from = out.string();
  }
}

TEST_CASE("springs kept by the conventions of LIGGGHTS shall hold on by those of this engine") {
  const TemporaryFolder folder;
  const fs::path scenario = folder / "slope.yaml";
  write_box(scenario,
            "time: {end: 60 ms, fluid_step: 1 ms, output_every: 10 ms}\n"
            "gravity: [2, 0, -9.81]\n"
            "interactions:\n"
            "  - between: [sand, sand]\n"
            "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.8, tangential: "
            "liggghts}\n"
            "    rolling: {model: epsd2, friction: 0.8}\n"
            "emitters:\n"
            "  one: {model: single, material: sand, positions: [[10, 10, 1 mm]], diameters: [2 "
            "mm]}\n");
  REQUIRE(run(folder / "first", "60 ms", {}, "1", scenario).status == 0);
  const auto branch = run(folder / "branch", "65 ms",
                          {"start_from=" + (folder / "first").string(), "time.output_every=1 ms",
                           "interactions[0].contact.tangential=rescaled"},
                          "1", scenario);
  INFO(branch.err);
  REQUIRE(branch.status == 0);
  // It rests on the slope and goes on to: without its spring it slips at 0.2 mm/s, of 2e-13 J.
  std::istringstream rows(read_file(folder / "branch" / "series.csv"));
  std::string row;
  std::getline(rows, row);
  int count = 0;
  for (; std::getline(rows, row); ++count) CHECK(std::stod(row.substr(row.find(',') + 1)) < 1e-16);
  CHECK(count >= 5);
}

TEST_CASE("kept states shall be found by their time, and others be named") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(run(first, "14 ms", {"time.keep_every=4 ms", "time.output_every=7 ms"}).status == 0);
  const std::string from = "start_from=" + first.string();
  REQUIRE(run(folder / "whole", "16 ms").status == 0);
  const auto kept = run(folder / "kept", "16 ms", {from + "@8 ms"});
  INFO(kept.err);
  REQUIRE(kept.status == 0);
  CHECK(digest(folder / "kept") == digest(folder / "whole"));
  CHECK(json_text(folder / "kept" / "summary.json", "time_s").substr(0, 5) == "0.008");
  const auto none = run(folder / "none", "16 ms", {from + "@9 ms"});
  CHECK(none.status == 2);
  CHECK(
      none.err.find("keeps no state of 0.009 s, only of 0 s, 0.004 s, 0.008 s, 0.012 s, 0.014 s") !=
      std::string::npos);
  CHECK(!fs::exists(folder / "none"));
}

TEST_CASE("what cannot be carried over shall be named with its place and a remedy") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(run(first, "14 ms").status == 0);
  const std::string from = "start_from=" + first.string();
  const auto refused = [&](const std::string& end, const std::vector<std::string>& settings,
                           const std::string& words) {
    std::vector<std::string> all{from};
    all.insert(all.end(), settings.begin(), settings.end());
    const auto done = run(folder / "refused", end, all);
    CHECK(done.status == 2);
    INFO(done.err);
    CHECK(done.err.find(words) != std::string::npos);
    CHECK(!fs::exists(folder / "refused"));
  };
  refused("14 ms", {}, "is not after the time that the run starts from, 0.014 s");
  refused("20 ms", {"domain.max=[340, 11, 350 mm]"}, "give the same domain");
  refused("20 ms", {"time.fluid_step=5 ms"}, "is no multiple of time.fluid_step, 0.005 s");
  // A block where grains lie on the belt or fall.
  refused(
      "20 ms",
      {"bodies.block={shape: box, min: [10, -1, 150 mm], max: [40, 12, 230 mm], material: belt}",
       "emitters.feed.min=[60, 1.5, 202 mm]", "emitters.feed.max=[84, 9.5, 202 mm]"},
      "bodies.block: ");
  const auto missing = run(folder / "refused", "20 ms", {"start_from=" + (folder / "no").string()});
  CHECK(missing.status == 2);
  CHECK(missing.err.find("holds no checkpoint.h5: run that scenario first") != std::string::npos);
  const auto time = run(folder / "refused", "20 ms", {from + "@soon"});
  CHECK(time.status == 2);
  CHECK(time.err.find("'soon' behind the @ is no time, like 0.5 s") != std::string::npos);
}

TEST_CASE("a resumed branch shall know that it is one, and what was warned of when it began") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "first", "8 ms").status == 0);
  const std::vector<std::string> settings = {"start_from=" + (folder / "first").string(),
                                             "emitters.feed.mass_flow=2 g/s"};
  REQUIRE(run(folder / "whole", "16 ms", settings).status == 0);
  REQUIRE(run(folder / "parts", "12 ms", settings).status == 0);
  // Also the second time.
  for (const std::string end : {"14 ms", "16 ms"}) {
    const auto resumed =
        engine({"run", k_scenario, "-o", folder / "parts", "--set", "time.end=" + end, "--set",
                settings[0], "--set", settings[1], "--resume", "--quiet"});
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
  }
  const auto summary = [&](const char* name) {
    return nlohmann::json::parse(read_file(folder / name / "summary.json"));
  };
  const auto whole = summary("whole"), parts = summary("parts");
  REQUIRE(whole.contains("start_from"));
  CHECK(parts["start_from"] == whole["start_from"]);
  REQUIRE(!whole["warnings"].empty());
  CHECK(parts["warnings"] == whole["warnings"]);
}

TEST_CASE("a feed whose grains become denser or lighter shall go on with its mass flow") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "first", "14 ms").status == 0);
  const auto emitted = [&](const char* name) {
    const auto summary = nlohmann::json::parse(read_file(folder / name / "summary.json"));
    const double mass = summary["emitters"]["feed"]["achieved"]["mass_kg"].get<double>();
    // The balance, in which all grains weigh what they weigh now.
    CHECK(mass == dust::test::approx(summary["mass_kg"]["emitted"].get<double>()).epsilon(1e-12));
    return mass;
  };
  const double first = emitted("first");
  for (const auto& [density, times] :
       {std::pair{"5300 kg/m3", 2.0}, std::pair{"1325 kg/m3", 0.5}}) {
    CAPTURE(density);
    const double before = times * first;
    const auto branch = run(folder / "branch", "24 ms",
                            {"start_from=" + (folder / "first").string(),
                             "materials.sand.density=" + std::string(density)},
                            "2");
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    // 10 ms of 6 g/s, to three grains of 0.6 mm at the most: those that wait and half ones.
    CHECK(std::abs(emitted("branch") - before - 6e-5) < 3.0 * 5300.0 * 1.131e-10);
    fs::remove_all(folder / "branch");
  }
}

TEST_CASE(
    "a stream that a branch sets otherwise shall be asked for what had come and its new flow") {
  const TemporaryFolder folder;
  const auto feed = [&](const std::string& name) {
    const auto summary = nlohmann::json::parse(read_file(folder / name / "summary.json"));
    return summary["emitters"]["feed"];
  };
  REQUIRE(run(folder / "first", "14 ms").status == 0);
  const std::string slower = "emitters.feed.mass_flow=2 g/s";
  const std::vector<std::string> settings = {"start_from=" + (folder / "first").string(), slower};
  REQUIRE(run(folder / "branch", "20 ms", settings).status == 0);
  REQUIRE(engine({"run", k_scenario, "-o", folder / "branch", "--set", "time.end=24 ms", "--set",
                  settings[0], "--set", slower, "--resume", "--quiet"})
              .status == 0);
  const double before = feed("first")["achieved"]["mass_kg"];
  constexpr double k_grains = 3.0 * 2650.0 * 1.131e-10;  // [kg] that wait, and the half ones
  const auto asked = [&](const std::string& name) {
    return feed(name)["requested"]["mass_kg"].get<double>();
  };
  CHECK(std::abs(asked("first") - 14e-3 * 6e-3) < 1e-12);
  CHECK(std::abs(asked("branch") - before - 10e-3 * 2e-3) < k_grains);
  CHECK(std::abs(asked("branch") - feed("branch")["achieved"]["mass_kg"].get<double>()) < k_grains);
  // Also in a run that goes on from the branch, by the same settings or with other sensors.
  const std::string from = "start_from=" + (folder / "branch").string();
  REQUIRE(run(folder / "same", "30 ms", {from, slower}).status == 0);
  REQUIRE(run(folder / "other", "30 ms", {from, slower, "sensors.lip.enabled=false"}).status == 0);
  for (const std::string name : {"same", "other"}) {
    CAPTURE(name);
    CHECK(std::abs(asked(name) - before - 16e-3 * 2e-3) < k_grains);
  }
}

TEST_CASE("sensors shall begin anew where anything but sensors and the end is set otherwise") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "first", "5 ms").status == 0);
  const auto begins_anew = [&](const std::string& setting) {
    const auto branch =
        run(folder / "branch", "7 ms", {"start_from=" + (folder / "first").string(), setting});
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    fs::remove_all(folder / "branch");
    // The check says beforehand what the run will say.
    const auto check = engine({"check", k_scenario, "--set", "time.end=7 ms", "--set",
                               "start_from=" + (folder / "first").string(), "--set", setting});
    const auto said = [](const std::string& err) {
      std::string lines;
      std::istringstream stream(err);
      for (std::string line; std::getline(stream, line);) {
        if (line.find("start_from: ") != std::string::npos) {
          lines += line.substr(line.find("start_from: ")) + "\n";
        }
      }
      return lines;
    };
    CHECK(said(check.err) == said(branch.err));
    const std::string begin =
        "these sensors begin anew, for something is set otherwise than in "
        "that run: ";
    const auto at = branch.err.find(begin);
    if (at == std::string::npos) return std::string();
    const auto from = at + begin.size();
    return branch.err.substr(from, branch.err.find(';', from) - from);
  };
  const std::string all = begins_anew("materials.sand.density=5300 kg/m3");
  CHECK(all.find("stream") != std::string::npos);
  CHECK(all.find("suction") != std::string::npos);
  CHECK(begins_anew("fluid.cells=[33, 4, 35]") == all);
  // The mean over two plants is of neither: another stiffness, belt, wind or feed.
  CHECK(begins_anew("materials.sand.young_modulus=60 MPa") == all);
  CHECK(begins_anew("bodies.belt.speed=0.5 m/s") == all);
  CHECK(begins_anew("domain.boundaries.top.air.velocity=[0.5, 0, 0 m/s]") == all);
  CHECK(begins_anew("emitters.feed.mass_flow=4 g/s") == all);
  CHECK(begins_anew("sensors.stream.steady_after=6 ms") == "stream");
  CHECK(begins_anew("time.output_every=5 ms").empty());
}

TEST_CASE("a sensor that begins in a branch shall not take what was emitted before as its feed") {
  const TemporaryFolder folder;
  REQUIRE(run(folder / "first", "14 ms").status == 0);
  const auto branch = run(folder / "branch", "34 ms",
                          {"start_from=" + (folder / "first").string(),
                           "sensors.spilt={model: spillage, min: [0, 0, 50 mm], max: [340, 11, 50 "
                           "mm], steady_after: 1 ms}"});
  INFO(branch.err);
  REQUIRE(branch.status == 0);
  const auto summary = nlohmann::json::parse(read_file(folder / "branch" / "summary.json"));
  // Nothing has fallen yet, of an even feed: 0 g/t, not "feed not even".
  CHECK(summary["sensors"]["spilt"]["grams_per_tonne"]["value"] == 0.0);
}

namespace {

/// Two grains that fly through the open sides at 2 and 20 ms.
const std::string k_fliers =
    "time: {end: 30 ms, fluid_step: 1 ms, output_every: 10 ms}\n"
    "gravity: [0, 0, 0]\n"
    "interactions:\n"
    "  - between: [sand, sand]\n"
    "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.3}\n"
    "emitters:\n"
    "  two: {model: single, material: sand, positions: [[2, 10, 20 mm], [10, 10, 20 mm]], "
    "diameters: [2 mm], velocities: [[-1, 0, 0 m/s], [0, 0.5, 0 m/s]]}\n";

}  // namespace

TEST_CASE("counts of what left through each side shall go on in a branch") {
  const TemporaryFolder folder;
  const fs::path scenario = folder / "fliers.yaml";
  write_box(scenario, k_fliers);
  REQUIRE(run(folder / "first", "10 ms", {}, "1", scenario).status == 0);
  const auto branch =
      run(folder / "branch", "30 ms",
          {"start_from=" + (folder / "first").string(), "interactions[0].contact.restitution=0.6"},
          "1", scenario);
  INFO(branch.err);
  REQUIRE(branch.status == 0);
  const auto summary = nlohmann::json::parse(read_file(folder / "branch" / "summary.json"));
  CHECK(summary["particles"]["left"] == 2);
  CHECK(summary["health"]["grains_left"]["left"]["count"] == 1);
  CHECK(summary["health"]["grains_left"]["back"]["count"] == 1);
}

TEST_CASE("an emitter of a branch whose grains would have come before shall be refused") {
  const TemporaryFolder folder;
  const fs::path scenario = folder / "fliers.yaml";
  write_box(scenario, k_fliers);
  REQUIRE(run(folder / "first", "10 ms", {}, "1", scenario).status == 0);
  const auto branch = [&](const std::string& time) {
    return run(folder / "branch", "12 ms",
               {"start_from=" + (folder / "first").string(),
                "emitters.more={model: single, material: sand, positions: [[10, 10, 5 mm]], "
                "diameters: [2 mm]" +
                    time + "}"},
               "1", scenario);
  };
  const auto refused = branch("");
  CHECK(refused.status == 2);
  INFO(refused.err);
  CHECK(refused.err.find("emitters.more: its grains come at 0 s, before this run begins at 0.01 s: "
                         "give it a later 'time'") != std::string::npos);
  CHECK(!fs::exists(folder / "branch"));
  const auto taken = branch(", time: 10 ms");
  INFO(taken.err);
  REQUIRE(taken.status == 0);
  const auto summary = nlohmann::json::parse(read_file(folder / "branch" / "summary.json"));
  CHECK(summary["particles"]["emitted"] == 3);
}

TEST_CASE("a branch on another grid shall begin its maps of where dust came off anew") {
  const TemporaryFolder folder;
  const std::string scenario = DUST_SOURCE "/tests/scenario/dusty_bounce.yaml";
  // The grain meets the plate after 3.5 ms, in cells that the first grid does not have.
  REQUIRE(run(folder / "first", "1 ms", {}, "1", scenario).status == 0);
  for (const std::string cells : {"[20, 20, 20]", "[3, 3, 3]"}) {
    CAPTURE(cells);
    const auto branch =
        run(folder / "branch", "8 ms",
            {"start_from=" + (folder / "first").string(), "fluid.cells=" + cells}, "1", scenario);
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    const auto summary = nlohmann::json::parse(read_file(folder / "branch" / "summary.json"));
    const auto& ore = summary["dust_on_grains"]["classes"]["10_um"];
    CHECK(ore["set_free_kg"].get<double>() > 0.0);
    CHECK(std::abs(ore["balance_error"].get<double>()) < 1e-9);
    fs::remove_all(folder / "branch");
  }
}

TEST_CASE("rates and shares of a hood in a branch shall be of one plant") {
  const TemporaryFolder folder;
  const std::string scenario = DUST_SOURCE "/tests/scenario/dusty_stream.yaml";
  const std::string rule = "dust.finer_than=5 mm";  // all of the stream
  REQUIRE(run(folder / "first", "0.3 s", {rule}, "1", scenario).status == 0);
  const std::vector<std::string> settings = {
      rule, "start_from=" + (folder / "first").string(),
      "domain.boundaries.top.air={model: static_pressure, pressure: 0 Pa}",
      "domain.boundaries.bottom.air={model: hood, flow: 3.6 l/s, min: [0, 0, 0], max: [60, 60, 0 "
      "mm]}"};
  const auto summary = [&](const char* name) {
    return nlohmann::json::parse(read_file(folder / name / "summary.json"));
  };
  REQUIRE(run(folder / "branch", "0.35 s", settings, "1", scenario).status == 0);
  // Also of one that was resumed.
  std::vector<std::string> resumed = {"run",   scenario,         "-o",       folder / "branch",
                                      "--set", "time.end=0.4 s", "--resume", "--quiet"};
  for (const std::string& setting : settings) resumed.insert(resumed.end(), {"--set", setting});
  const auto done = engine(resumed);
  INFO(done.err);
  REQUIRE(done.status == 0);
  const auto first = summary("first"), branch = summary("branch");
  const auto& hood = branch["hoods"]["bottom"];
  INFO(branch["hoods"].dump());
  const double dust = hood["dust_kg"];
  REQUIRE(dust > 0.0);
  const double load =
      branch["mass_kg"]["emitted"].get<double>() - first["mass_kg"]["emitted"].get<double>();
  CHECK(hood["dust_kg_per_h"].get<double>() == dust::test::approx(3600.0 * dust / 0.1));
  CHECK(hood["dust_g_per_tonne"].get<double>() == dust::test::approx(1e6 * dust / load));
  CHECK(hood["share_of_dust"].get<double>() > 0.0);
  CHECK(hood["share_of_dust"].get<double>() < 1.5);  // some of what hung in the air before
  // And of a run that started from that one, where the hood is no longer new.
  std::vector<std::string> again = settings;
  again[1] = "start_from=" + (folder / "branch").string();
  for (const char* friction : {"0.4", "0.2"}) {
    CAPTURE(friction);  // the first says the same, the second something else
    again.push_back(std::string("interactions[0].contact.friction=") + friction);
    REQUIRE(run(folder / friction, "0.45 s", again, "1", scenario).status == 0);
    const auto last = summary(friction);
    const bool is_same = std::string(friction) == "0.4";
    const double drawn = last["hoods"]["bottom"]["dust_kg"];
    CHECK(drawn > dust);
    const double rate = last["hoods"]["bottom"]["dust_kg_per_h"];
    CHECK(rate ==
          dust::test::approx(is_same ? 3600.0 * drawn / 0.15 : 3600.0 * (drawn - dust) / 0.05));
    CHECK(last["start_from"]["rates_since_s"].get<double>() ==
          dust::test::approx(is_same ? 0.3 : 0.4));
    // What the field gave out by the same way, over the same time.
    const double out = last["dust_outflow"]["bottom"]["kg"];
    const double before = branch["dust_outflow"]["bottom"]["kg"];
    CHECK(last["dust_outflow"]["bottom"]["kg_per_h"].get<double>() ==
          dust::test::approx(is_same ? 3600.0 * out / 0.15 : 3600.0 * (out - before) / 0.05));
  }
}

TEST_CASE(
    "grains whose material has another dust load shall carry that, not a share of the old one") {
  const TemporaryFolder folder;
  const std::string scenario = DUST_SOURCE "/tests/scenario/dusty_bounce.yaml";
  REQUIRE(run(folder / "first", "1 ms", {}, "1", scenario).status == 0);
  const std::string from = "start_from=" + (folder / "first").string();
  const std::string same = "[0.4 %, 0.6 %]";
  const auto set_free = [&](const std::string& load) {
    const auto branch =
        run(folder / "branch", "8 ms", {from, "materials.ore.dust_load=" + load}, "1", scenario);
    INFO(branch.err);
    REQUIRE(branch.status == 0);
    CHECK((branch.err.find("another dust_load") != std::string::npos) == (load != same));
    const auto summary = nlohmann::json::parse(read_file(folder / "branch" / "summary.json"));
    fs::remove_all(folder / "branch");
    double sum = 0.0;
    for (const auto& one : summary["dust_on_grains"]["classes"]) {
      sum += one["set_free_kg"].get<double>();
    }
    return sum;
  };
  // m0 (1 - exp(-E / (m0 e_b))) of each class, and of both together: the exponent of half the load
  // is twice that of the whole.
  const double whole = set_free(same);
  const double half = set_free("[0.2 %, 0.3 %]");
  const double load = 0.01 * 3000.0 * std::numbers::pi / 6.0 * std::pow(6e-3, 3);
  CHECK(whole > 0.1 * load);
  CHECK(half ==
        dust::test::approx(0.5 * load * (1.0 - std::pow(1.0 - whole / load, 2))).epsilon(1e-6));
}

TEST_CASE("the report of dust set free in a branch shall say what its summary says") {
  const TemporaryFolder folder;
  const std::string scenario = DUST_SOURCE "/tests/scenario/dusty_stream.yaml";
  // Onto a floor, which the first grains reach in the branch.
  std::vector<std::string> settings = {"domain.boundaries.bottom.grains=wall",
                                       "domain.boundaries.bottom.material=steel"};
  REQUIRE(run(folder / "first", "0.15 s", settings, "1", scenario).status == 0);
  settings.push_back("start_from=" + (folder / "first").string());
  settings.push_back("materials.ore.dust_load=[2 %]");
  const auto branch = run(folder / "branch", "0.3 s", settings, "1", scenario);
  INFO(branch.err);
  REQUIRE(branch.status == 0);
  const auto read = [&](const char* file) {
    return nlohmann::json::parse(read_file(folder / "branch" / file));
  };
  const auto causes = read("summary.json")["dust_on_grains"]["classes"]["10_um"]["set_free_by"];
  REQUIRE(!causes.empty());
  const auto report = read("report.json");
  const auto table =
      std::find_if(report["tables"].begin(), report["tables"].end(), [](const auto& one) {
        return one["title"] == "Dust set free from grains, start-up included";
      });
  REQUIRE(table != report["tables"].end());
  REQUIRE((*table)["rows"].size() == causes.size());
  for (const auto& row : (*table)["rows"]) {
    CAPTURE(row.dump());
    CHECK(row[1].get<double>() ==
          dust::test::approx(causes[row[0].get<std::string>()]["g_per_tonne"].get<double>()));
  }
  // Of a run that started from that one, another plant with the same loads: since it began.
  settings[2] = "start_from=" + (folder / "branch").string();
  settings.push_back("interactions[0].contact.friction=0.25");
  const auto again = run(folder / "again", "0.35 s", settings, "1", scenario);
  INFO(again.err);
  REQUIRE(again.status == 0);
  const auto later =
      nlohmann::json::parse(read_file(folder / "again" / "summary.json"))["dust_on_grains"];
  for (const auto& [cause, set_free] : later["classes"]["10_um"]["set_free_by"].items()) {
    CAPTURE(cause);
    const double before = causes.contains(cause) ? causes[cause]["kg"].get<double>() : 0.0;
    CHECK(set_free["kg_per_h"].get<double>() ==
          dust::test::approx(3600.0 * (set_free["kg"].get<double>() - before) / 0.05));
  }
}
