// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Runs the engine of the test's own prefix with `arguments` (as in a shell).
Outcome engine(const std::string& arguments) {
  const fs::path stem =
      fs::temp_directory_path() / ("dust_command_line_" + std::to_string(::getpid()));
  const std::string out = stem.string() + ".out";
  const std::string err = stem.string() + ".err";
  const std::string command =
      "env -u DUST_PLUGIN_PATH " PREFIX "/bin/engine " + arguments + " > " + out + " 2> " + err;
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

void check_refused(const std::string& arguments, const std::string& expected) {
  const Outcome o = engine(arguments);
  CHECK_MESSAGE(o.status == 2, o.err);
  CHECK(o.out.empty());
  CHECK_MESSAGE(o.err == expected + "\n", o.err);
}

const std::string k_scenario = DUST_SOURCE "/tests/unit/scenario/transfer_point.yaml";

}  // namespace

TEST_CASE("a bad command line shall exit with 2 and a hint") {
  check_refused("chekc x", "engine: error: unknown command 'chekc'; did you mean 'check'?");
  check_refused("check", "engine check: error: SCENARIO is required (see engine check --help)");
  check_refused("check a.yaml --treads 2",
                "engine check: error: The following arguments were not expected: 2 --treads (see "
                "engine check --help)");
  check_refused("check " + k_scenario + " --set time.end",
                "--set time.end: error: write --set path=value");
  check_refused("describe drag/gidaspov",
                "engine describe: error: there is no 'drag/gidaspov'; did you mean "
                "'drag/gidaspow'?");
  CHECK(engine("").status == 2);
}

TEST_CASE("a new plugin's name that would not build shall be refused with the reason") {
  const auto refused = [](const std::string& what, const std::string& why) {
    const std::string name = what.substr(what.find(' ') + 1);
    check_refused("new-plugin " + what,
                  "engine new-plugin: error: the name '" + name + "' is " + why +
                      ", so the plugin would not build: choose another, like my_" + name);
  };
  refused("contact class", "a keyword of C++");
  refused("drag int", "a keyword of C++");
  refused("drag main", "a name of the sources a plugin is made of");
  refused("drag pow", "a function or type of the C library");
  refused("sensor test", "a target that CMake makes itself");
}

TEST_CASE("describe shall take a model by its name alone where one kind has it") {
  const Outcome whole = engine("describe drag/gidaspow");
  CHECK_MESSAGE(whole.status == 0, whole.err);
  CHECK(engine("describe gidaspow").out == whole.out);
}

TEST_CASE("describe shall print all models of a kind in every form") {
  const Outcome as_json = engine("describe drag --json");
  CHECK_MESSAGE(as_json.status == 0, as_json.err);
  const auto models = nlohmann::json::parse(as_json.out);
  REQUIRE(models.is_array());
  REQUIRE(!models.empty());
  for (const auto& model : models) CHECK(model["kind"] == "drag");
  const Outcome page = engine("describe drag --markdown");
  CHECK_MESSAGE(page.status == 0, page.err);
  CHECK(page.out.find(engine("describe drag/gidaspow --markdown").out) != std::string::npos);
}

TEST_CASE("output that a full disk takes shall be no success") {
  for (const std::string command :
       {"schema", "plugins", "list", "man", "completion", "describe drag/gidaspow", "--help"}) {
    CAPTURE(command);
    const fs::path err = fs::temp_directory_path() / ("dust_full_" + std::to_string(::getpid()));
    const int status = std::system(("env -u DUST_PLUGIN_PATH " PREFIX "/bin/engine " + command +
                                    " > /dev/full 2> " + err.string())
                                       .c_str());
    CHECK(WEXITSTATUS(status) == 1);
    CHECK(
        text_of(err) ==
        "error: standard output cannot be written, and what was printed is not whole: is its disk "
        "full?\n");
    fs::remove(err);
  }
}

TEST_CASE("folders that are no runs shall be refused with a remedy") {
  check_refused("compare nowhere elsewhere",
                "error: nowhere is not a folder; give the output folder of a run, for example "
                "results/transfer_point");
  check_refused("report nowhere", "nowhere: error: no such folder");
}

TEST_CASE("help and version shall exit with 0, for every command with examples") {
  CHECK(engine("--version").out.starts_with("engine "));
  const Outcome help = engine("--help");
  CHECK(help.status == 0);
  for (const std::string command : {"check", "plugins", "describe", "schema", "report", "compare",
                                    "new-plugin", "test-plugin"}) {
    CHECK(help.out.find("  " + command) != std::string::npos);
    const Outcome one = engine(command + " --help");
    CHECK(one.status == 0);
    CHECK(one.out.find("Example") != std::string::npos);
  }
}

TEST_CASE("check shall accept a scenario that is well, with the plugins beside the program") {
  const Outcome o = engine("check " + k_scenario);
  CHECK_MESSAGE(o.status == 0, o.err);
  CHECK(o.err.empty());
  CHECK(o.out.find("the scenario is valid") != std::string::npos);
  CHECK(o.out.find("sets the smallest step") != std::string::npos);
}

TEST_CASE("the shipped transfer point shall be valid with the shipped plugins") {
  const int status = std::system("env -u DUST_PLUGIN_PATH " DUST_ENGINE " check " DUST_SOURCE
                                 "/scenarios/transfer_point.yaml > /dev/null");
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("check shall tell a wrong scenario on stderr, one line per problem, path as given") {
  const fs::path file = fs::temp_directory_path() / "dust_wrong.yaml";
  std::ofstream(file) << "name: wrong\ntime: {end: 1 s, fluid_step: 1 m, outputevery: 1 s}\n";
  const Outcome o = engine("check " + file.string());
  fs::remove(file);
  CHECK(o.status == 2);
  CHECK(o.out.empty());
  std::istringstream lines(o.err);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    CHECK_MESSAGE(line.starts_with(file.string() + ":"), line);
    CHECK(line.find(": error: ") != std::string::npos);
  }
  CHECK(count >= 5);
  CHECK(o.err.find("unknown key 'outputevery' in time; did you mean 'output_every'?") !=
        std::string::npos);
}

namespace {

/// A box of air alone with these conditions at left, right and top; walls elsewhere.
std::string box_of_air(const std::string& left, const std::string& right, const std::string& top,
                       const std::string& fluid = "cells: [10, 2, 10]") {
  return "name: box\n"
         "time: {end: 1 s, fluid_step: 1 ms, output_every: 100 ms}\n"
         "gravity: [0, 0, -9.81]\n"
         "domain:\n"
         "  min: [0, 0, 0]\n"
         "  max: [100, 20, 100 mm]\n"
         "  boundaries:\n"
         "    left: {grains: open, air: {model: " +
         left +
         "}}\n"
         "    right: {grains: open, air: {model: " +
         right +
         "}}\n"
         "    front: {grains: open, air: {model: slip}}\n"
         "    back: {grains: open, air: {model: slip}}\n"
         "    bottom: {grains: open, air: {model: no_slip}}\n"
         "    top: {grains: open, air: {model: " +
         top +
         "}}\n"
         "fluid: {" +
         fluid + ", density: 1.2, viscosity: 18 uPa s}\n";
}

/// What check with the shipped plugins says to stderr, without the file's name.
std::string checked(const std::string& scenario, int expected_status) {
  const fs::path file =
      fs::temp_directory_path() / ("dust_air_" + std::to_string(::getpid()) + ".yaml");
  const fs::path err = file.string() + ".err";
  std::ofstream(file) << scenario;
  const int status = std::system(("env -u DUST_PLUGIN_PATH " DUST_ENGINE " check " + file.string() +
                                  " > /dev/null 2> " + err.string())
                                     .c_str());
  std::string text = text_of(err);
  fs::remove(file);
  fs::remove(err);
  CHECK_MESSAGE(WEXITSTATUS(status) == expected_status, text);
  return text.starts_with(file.string()) ? text.substr(file.string().size()) : text;
}

}  // namespace

TEST_CASE("check shall accept flows that something gives way to, or that cancel") {
  CHECK(checked(
            box_of_air("volume_flow, flow: 60 l/min", "static_pressure, pressure: 0 Pa", "no_slip"),
            0) == "");
  CHECK(
      checked(box_of_air("volume_flow, flow: 60 l/min", "volume_flow, flow: -60 l/min", "no_slip"),
              0) == "");
  CHECK(checked(box_of_air("velocity_inlet, speed: 1 m/s, measure: superficial, profile: "
                           "parabolic, across: [z]",
                           "no_slip",
                           "hood, flow: 120 l/min, min: [20, 0, 100 mm], max: [60, 20, 100 mm]"),
                0) == "");
}

TEST_CASE("check shall refuse sides that contradict each other, with the reason and the place") {
  CHECK(checked(box_of_air("volume_flow, flow: 60 l/min", "no_slip", "no_slip"), 2) ==
        ":8:5: error: domain.boundaries: at t = 0 s the sides let 0.001 m3/s more fluid in than "
        "out (left 0.001 m3/s) and none of them gives way; make one a total_pressure, "
        "static_pressure or zero_gradient side\n");
  // Balanced at the start only.
  const std::string ramp =
      checked(box_of_air("volume_flow, flow: 60 l/min, times: [0, 1 s], factors: [1, 0]",
                         "volume_flow, flow: -60 l/min", "no_slip"),
              2);
  CHECK_MESSAGE(ramp.find("at t = 0.0625 s the sides let") != std::string::npos, ramp);
  CHECK_MESSAGE(ramp.find("more fluid out than in (left") != std::string::npos, ramp);
}

TEST_CASE("check shall refuse a body that sucks what no side gives") {
  const std::string hood =
      "materials: {steel: {density: 7850, young_modulus: 50 MPa, poisson_ratio: 0.3}}\n"
      "bodies: {hood: {shape: box, material: steel, min: [40, 0, 40 mm], max: [60, 20, 60 mm], "
      "suction: {flow: 60 l/min, min: [40, 0, 40 mm], max: [60, 20, 40 mm]}}}\n";
  const std::string closed = checked(box_of_air("no_slip", "no_slip", "no_slip") + hood, 2);
  CHECK_MESSAGE(closed.find("the sides let 0.001 m3/s more fluid out than in (hood -0.001 m3/s) "
                            "and none of them gives way") != std::string::npos,
                closed);
  CHECK(checked(box_of_air("static_pressure, pressure: 0 Pa", "no_slip", "no_slip") + hood, 0) ==
        "");
  CHECK(checked(box_of_air("volume_flow, flow: 60 l/min", "no_slip", "no_slip") + hood, 0) == "");
}

TEST_CASE("check shall count a given mass flow with the density of the fluid at its side") {
  const std::string water =
      "cells: [10, 2, 10], regions: {water: {min: [-1, -1, -1 mm], max: [110, 30, 110 mm], "
      "density: 1000, viscosity: 1 mPa s}}";
  CHECK(checked(
            box_of_air("mass_flow, flow: 10 g/s", "volume_flow, flow: -0.01 l/s", "no_slip", water),
            0) == "");
}

TEST_CASE("check shall refuse wall shear where there is none, or its viscosity is not known") {
  const auto with = [](const std::string& side, const std::string& fluid) {
    return box_of_air("static_pressure, pressure: 0 Pa", "no_slip", "no_slip", fluid) +
           "sensors: {rub: {model: wall_shear, side: " + side + "}}\n";
  };
  const std::string plain = "cells: [10, 2, 10]";
  const std::string water = plain +
                            ", regions: {water: {min: [0, 0, 0], max: [100, 20, 10 mm], density: "
                            "1000, viscosity: 1 mPa s}}";
  CHECK(checked(with("bottom", plain), 0) == "");
  CHECK(checked(with("top", water), 0) == "");
  const std::string open = checked(with("left", plain), 2);
  CHECK_MESSAGE(
      open.find("sensors.rub.side: left lets air pass wherever it is") != std::string::npos, open);
  const std::string slippery = checked(with("front", plain), 2);
  CHECK_MESSAGE(
      slippery.find("sensors.rub.side: front holds no air that goes along it") != std::string::npos,
      slippery);
  const std::string wet = checked(with("bottom", water), 2);
  CHECK_MESSAGE(wet.find("sensors.rub.side: bottom has a region of another viscosity beside it") !=
                    std::string::npos,
                wet);
}

TEST_CASE("check shall tell what an air condition refuses, at its place") {
  const auto reported = [](const std::string& left, const std::string& expected) {
    const std::string text =
        checked(box_of_air(left, "static_pressure, pressure: 0 Pa", "no_slip"), 2);
    CHECK_MESSAGE(text.starts_with(":8:"), text);
    CHECK_MESSAGE(text.find(expected) != std::string::npos, text);
  };
  reported("velocity_inlet, speed: 1 m/s", "missing key 'measure'");
  reported("velocity_inlet, speed: 1 m/s, measure: total", "measure");
  reported("velocity_inlet, speed: 1 m/s, measure: interstitial, profile: parabolic",
           "needs across");
  reported("velocity_inlet, speed: 1 m/s, measure: interstitial, profile: parabolic, across: [x]",
           "across names x, the normal of the side");
  reported("hood, flow: 1 l/min, min: [0, 0, 0], max: [0, 30, 10 mm]",
           "the opening reaches beyond the side along y");
  reported("volume_flow, flow: 1 l/min, times: [0, 1 s], factors: [1]", "differ in length");
}

TEST_CASE("check shall warn of cells far from cubic and of momentum set III") {
  const std::string text = checked(box_of_air("static_pressure, pressure: 0 Pa", "no_slip",
                                              "no_slip", "cells: [50, 2, 10], momentum_set: III"),
                                   0);
  CHECK_MESSAGE(text.find("far from cubic, 5 times as long") != std::string::npos, text);
  CHECK_MESSAGE(text.find("III holds for steady uniform suspensions only") != std::string::npos,
                text);
}

TEST_CASE(
    "check shall say that an impact after a fall lasts few steps, and what makes shorter ones") {
  // The steps are made for 0.5 m/s where nothing else is said; the fall ends at 7.7 m/s.
  const auto fall = [](const std::string& expected_speed) {
    const fs::path file =
        fs::temp_directory_path() / ("dust_fall_" + std::to_string(::getpid()) + ".yaml");
    const fs::path out = file.string() + ".out";
    std::ofstream(file) << "name: fall\ntime: {end: 1 s, fluid_step: 1 ms, output_every: 100 ms" +
                               expected_speed +
                               "}\ngravity: [0, 0, -9.81]\n"
                               "domain: {min: [0, 0, 0], max: [1, 1, 3 m], boundaries: {"
                               "left: {grains: open}, right: {grains: open}, "
                               "front: {grains: open}, back: {grains: open}, "
                               "bottom: {grains: wall, material: ore}, top: {grains: open}}}\n"
                               "materials: {ore: {density: 3200, young_modulus: 100 MPa, "
                               "poisson_ratio: 0.25}}\n"
                               "interactions: [{between: [ore, ore], contact: {model: "
                               "hertz_mindlin, restitution: 0.5, friction: 0.5}}]\n"
                               "emitters: {lump: {model: single, material: ore, "
                               "positions: [[0.5, 0.5, 2.9 m]], diameters: [40 mm]}}\n"
                               "fluid: none\n";
    const int status = std::system(
        ("env -u DUST_PLUGIN_PATH " DUST_ENGINE " check " + file.string() + " > " + out.string())
            .c_str());
    const std::string text = text_of(out);
    fs::remove(file);
    fs::remove(out);
    CHECK(status == 0);
    return text;
  };
  const std::string said = "steps, which costs some per cent of its restitution";
  const std::string slow = fall("");
  CHECK_MESSAGE(slow.find(said) != std::string::npos, slow);
  CHECK(fall(", expected_speed: 8 m/s").find(said) == std::string::npos);
}

TEST_CASE("check shall draw the set-up as a picture where one is asked for") {
  const fs::path file = fs::temp_directory_path() / "dust_setup.svg";
  const std::string command = "check " + k_scenario + " -o " + file.string();
  fs::remove(file);
  CHECK(engine(command).status == 0);
  const std::string picture = text_of(file);
  CHECK(picture.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  CHECK(picture.find("<title>belt</title>") != std::string::npos);
  CHECK(picture.ends_with("</svg>\n"));
  // Axes with their units, a scale, what belts, feeds and openings look like.
  for (const char* part : {">x, mm</text>", ">z, mm</text>", ">belt and its way</text>",
                           ">feed</text>", ">opening for air</text>"}) {
    CHECK_MESSAGE(picture.find(part) != std::string::npos, part);
  }
  CHECK(engine(command).status == 0);  // its own
  std::ofstream(file) << "<svg>mine</svg>";
  CHECK(engine(command).status == 2);
  CHECK(text_of(file) == "<svg>mine</svg>");
  fs::remove(file);
}

TEST_CASE("check shall draw the set-up") {
  const fs::path file = fs::temp_directory_path() / "dust_setup.html";
  fs::remove(file);
  CHECK(engine("check " + k_scenario + " -o " + file.string()).status == 0);
  const std::string page = text_of(file);
  fs::remove(file);
  const std::string head = "id=\"run-data\">";
  const auto at = page.find(head) + head.size();
  const auto data = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  CHECK(data["kind"] == "setup");
  CHECK(data["bodies"][0]["name"] == "belt");
  CHECK(data["bodies"][0]["segments"].size() > 10);  // its pulley is round
  CHECK(data["bodies"][0]["section"].size() > 10);   // the belt is solid inside
  CHECK(data["space"]["surfaces"]["names"][0] == "belt");
  CHECK(data["setting"]["emitters"][0]["name"] == "feed");
  CHECK(data["setting"]["sensors"][0]["name"] == "stream");
  CHECK(data["setting"]["sides"][2]["material"] == "glass");
  CHECK(data["check"]["grains"].is_number());
  CHECK(data["check"]["smallest_step_s"].get<double>() > 0.0);
  CHECK(engine("check " + k_scenario + " -o /not/there.html").status == 2);
  const Outcome picture = engine("check " + k_scenario + " -o setup.png");
  CHECK(picture.status == 2);
  CHECK(picture.err.find("give it a name that ends with .html") != std::string::npos);
}

TEST_CASE("plugins shall list kind, name, version and file") {
  const Outcome o = engine("plugins");
  CHECK(o.status == 0);
  CHECK(o.out.find("contact     hertz_mindlin      1.0  " PREFIX "/lib/dust/plugins") !=
        std::string::npos);
}

TEST_CASE("a plugin folder that is not there shall be refused") {
  const Outcome o = engine("plugins --plugin-path /not/there");
  CHECK(o.status == 2);
  CHECK(o.err.starts_with("/not/there: error: "));
}

TEST_CASE("describe shall tell parameters with unit, default and range") {
  const Outcome o = engine("describe contact/hertz_mindlin");
  CHECK(o.out.find("restitution (e): number, required, 0 < e <= 1") != std::string::npos);
  CHECK(engine("describe shape/plate --markdown").out.find("| `length` |") != std::string::npos);
  CHECK(engine("describe shape/conveyor --json").out.starts_with("{"));
  CHECK(engine("schema").out.starts_with("{"));
}

TEST_CASE("models shall be listed by kind, in short and with what they take") {
  const Outcome kinds = engine("list");
  CHECK(kinds.status == 0);
  CHECK(kinds.out.find("emitter ") != std::string::npos);
  CHECK(kinds.out.find("conveyor") != std::string::npos);
  const Outcome drags = engine("list drag");
  CHECK(drags.status == 0);
  const Outcome described = engine("describe drag");
  CHECK(described.status == 0);
  // Lines of the one stand among those of the other, between lines of parameters.
  std::istringstream lines(drags.out);
  int models = 0;
  for (std::string line; std::getline(lines, line); ++models) {
    CHECK(described.out.find(line + "\n") != std::string::npos);
  }
  CHECK(models >= 1);
  check_refused("list darg", "engine list: error: there is no kind 'darg'; did you mean 'drag'?");
}

TEST_CASE("help shall be a command, of the program and of each command") {
  const Outcome all = engine("help");
  CHECK(all.status == 0);
  CHECK(all.out == engine("--help").out);
  const Outcome one = engine("help study");
  CHECK(one.status == 0);
  CHECK(one.out == engine("study --help").out);
  check_refused("help stud",
                "engine help: error: there is no command 'stud'; did you mean 'study'?");
}
