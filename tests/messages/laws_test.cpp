// SPDX-License-Identifier: Apache-2.0
// What a scenario is told about the shipped laws of contact, rolling and cohesion.
#include "base/error.hpp"
#include "preflight/reader.hpp"
#include "registry/registry.hpp"

#include <unistd.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace dust;

const std::string k_scenario = R"(name: wet
time: {end: 10 ms, fluid_step: 1 ms, output_every: 1 ms}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [10, 10, 50 mm]
  boundaries:
    left: {grains: periodic}
    right: {grains: periodic}
    front: {grains: periodic}
    back: {grains: periodic}
    bottom: {grains: wall, material: glass}
    top: {grains: open}
materials:
  sand: {density: 2650, young_modulus: 50 MPa, poisson_ratio: 0.3}
  glass: {density: 2500, young_modulus: 50 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.9, friction: 0.5}
    rolling: {model: epsd, friction: 0.1, damping_ratio: 0.2}
    cohesion: {model: jkr, surface_energy: 20 mJ/m2}
  - between: [sand, glass]
    contact: {model: hooke, normal_stiffness: 1 kN/m, restitution: 0.9, friction: 0.3}
    rolling: {model: cdt, friction: 0.1}
    cohesion: {model: liquid_bridge, surface_tension: 72 mN/m, contact_angle: 10 deg, volume: 1e-13}
emitters:
  feed:
    model: feed
    material: sand
    mass_flow: 6 g/s
    min: [1, 1, 45 mm]
    max: [9, 9, 45 mm]
    velocity: [0, 0, -0.5]
    diameters: [300, 500 um]
    number_fractions: [0.5, 0.5]
fluid: none
)";

const registry::Registry& shipped() {
  static registry::Registry registry;
  static const bool is_loaded = (registry.load({DUST_TEST_PLUGINS}), true);
  (void)is_loaded;
  return registry;
}

struct Reported {
  std::vector<std::string> errors, warnings;
};
Reported reported(const std::string& from = "", const std::string& to = "",
                  const std::vector<scenario::Override>& set = {}) {
  std::string text = k_scenario;
  if (!from.empty()) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }
  const fs::path folder = fs::temp_directory_path() / ("dust_laws_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "s.yaml", std::ios::binary) << text;
  Reported out;
  try {
    out.warnings = preflight::read_scenario(folder / "s.yaml", set, shipped(), {}).warnings;
  } catch (const base::UserError& problem) {
    out.errors = problem.lines();
    out.warnings = problem.warnings();
  }
  fs::remove_all(folder);
  for (auto* lines : {&out.errors, &out.warnings}) {
    for (std::string& line : *lines) {
      if (line.starts_with(folder.string())) line.erase(0, folder.string().size() + 1);
    }
  }
  return out;
}

/// What is read back from the resolved scenario.
scenario::Setup read_again() {
  const fs::path folder = fs::temp_directory_path() / ("dust_again_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "s.yaml", std::ios::binary) << k_scenario;
  const std::string resolved =
      preflight::read_scenario(folder / "s.yaml", {}, shipped(), {}).resolved_yaml;
  std::ofstream(folder / "r.yaml", std::ios::binary) << resolved;
  auto again = preflight::read_scenario(folder / "r.yaml", {}, shipped(), {}).setup;
  fs::remove_all(folder);
  return again;
}

void check(const std::string& from, const std::string& to, const std::string& expected) {
  const Reported t = reported(from, to);
  REQUIRE(t.errors.size() == 1);
  CHECK(t.errors[0] == expected);
}

}  // namespace

TEST_CASE("a scenario with every kind of law shall be well") {
  const Reported t = reported();
  CHECK(t.errors.empty());
  CHECK(t.warnings.empty());
}

TEST_CASE("values far from what is usual shall run, with a question after their unit") {
  const Reported friction = reported("friction: 0.5}", "friction: 30}");
  CHECK(friction.errors.empty());
  REQUIRE(friction.warnings.size() == 1);
  CHECK(friction.warnings[0] ==
        "s.yaml:19:65: warning: interactions[0].contact.friction: 30 is far from what is usual, "
        "0 to 2: is it meant?");
  const Reported tension = reported("72 mN/m", "72 N/m");
  // And what it does to soft grains.
  CHECK(std::any_of(tension.warnings.begin(), tension.warnings.end(), [](const std::string& line) {
    return line.ends_with(
        "interactions[1].cohesion.surface_tension: 72 N/m is far from what is usual, 0.01 to 2 "
        "N/m: is its unit right?");
  }));
  // A rough wall, mercury.
  CHECK(reported("friction: 0.5}", "friction: 1.2}").warnings.empty());
  CHECK(reported("72 mN/m", "485 mN/m").warnings.empty());
}

TEST_CASE("a gas as thick as syrup shall be warned of") {
  const auto of = [](const std::string& density, const std::string& viscosity) {
    return reported("fluid: none",
                    "fluid: {cells: [5, 5, 25], density: " + density + ", viscosity: " + viscosity +
                        "}\ndrag: {model: gidaspow}\nvoidage: {model: centre}",
                    {{"domain.boundaries.bottom.air", "{model: no_slip}"},
                     {"domain.boundaries.top.air", "{model: static_pressure, pressure: 0}"}});
  };
  const Reported thick = of("1.2", "18 Pa s");
  INFO((thick.errors.empty() ? "" : thick.errors[0]));
  REQUIRE(thick.warnings.size() == 1);
  CHECK(thick.warnings[0].find("warning: fluid.viscosity: 18 Pa s is far from that of a gas, which "
                               "1.2 kg/m3 speaks for (5e-06 to 0.0002 Pa s") != std::string::npos);
  CHECK(of("1.2", "18e-6 Pa s").warnings.empty());
  CHECK(of("1260", "1.4 Pa s").warnings.empty());  // glycerol
}

TEST_CASE("a value that cannot be read shall not be judged as well") {
  const auto said = [](const std::string& fluid) {
    return reported("fluid: none",
                    "fluid: {cells: [5, 5, 25], " + fluid +
                        "}\ndrag: {model: gidaspow}\nvoidage: {model: centre}",
                    {{"domain.boundaries.bottom.air", "{model: no_slip}"},
                     {"domain.boundaries.top.air", "{model: static_pressure, pressure: 0}"}});
  };
  const Reported viscosity = said("density: 1.2, viscosity: 1.8e-5 Pa.s");
  REQUIRE(viscosity.errors.size() == 1);
  CHECK(viscosity.errors[0].find("unknown unit 'Pa.s'") != std::string::npos);
  CHECK(viscosity.warnings.empty());
  const Reported density = said("density: 1000 kg/qm, viscosity: 1.8e-5");
  CHECK(density.errors.size() == 1);
  CHECK(density.warnings.empty());
  // Nor does what is none make a unit that others lack.
  const Reported corner = reported("min: [0, 0, 0]\n  max: [10, 10, 50 mm]",
                                   "min: [-0.1, 0, 0]\n  max: [10, 10, 50 mmm]");
  CHECK(corner.errors.size() == 1);
  CHECK(corner.warnings.empty());
  // Nor what is measured against it: the distance of periodic sides.
  const Reported domain = reported("max: [10, 10, 50 mm]", "max: [10, 10, 50 mmm]");
  REQUIRE(domain.errors.size() == 1);
  CHECK(domain.errors[0].find("domain.max: unknown unit 'mmm'") != std::string::npos);
}

TEST_CASE("a sensor of the air without air shall be warned of") {
  const std::string sensors =
      "sensors:\n  suction: {model: low_pressure, min: [0, 0, 0], max: [10, 10, 50 mm]}\n"
      "  still: {model: bed_height, base: [0, 0, 0]}\n";
  const Reported dry = reported("fluid: none", sensors + "fluid: none");
  CHECK(dry.errors.empty());
  REQUIRE(dry.warnings.size() == 1);
  CHECK(dry.warnings[0].ends_with(
      "warning: sensors.suction: looks at the fluid, and fluid is none: it has nothing to tell; "
      "take it out, or declare a fluid"));
}

TEST_CASE("the resolved scenario shall hold every law with its parameters") {
  const scenario::Setup setup = read_again();
  REQUIRE(setup.interactions.size() == 2);
  REQUIRE(setup.interactions[0].cohesion.has_value());
  CHECK(setup.interactions[0].cohesion->name == "jkr");
  CHECK(std::get<double>(setup.interactions[0].cohesion->values.at(0)) == 0.02);
  REQUIRE(setup.interactions[1].cohesion.has_value());
  CHECK(setup.interactions[1].cohesion->name == "liquid_bridge");
  CHECK(std::get<double>(setup.interactions[1].cohesion->values.at(2)) == 1e-13);
  CHECK(setup.interactions[1].contact.name == "hooke");
  CHECK(setup.interactions[1].rolling->name == "cdt");
}

TEST_CASE("a negative parameter of a law shall be told with its range") {
  check("surface_energy: 20 mJ/m2", "surface_energy: -20 mJ/m2",
        "s.yaml:21:44: error: interactions[0].cohesion.surface_energy: -20 mJ/m2 is outside "
        "gamma > 0 N/m");
  check("normal_stiffness: 1 kN/m", "normal_stiffness: -1 kN/m",
        "s.yaml:23:47: error: interactions[1].contact.normal_stiffness: -1 kN/m is outside "
        "k_n > 0 N/m");
  check("damping_ratio: 0.2", "damping_ratio: -0.2",
        "s.yaml:20:58: error: interactions[0].rolling.damping_ratio: -0.2 is outside "
        "0 <= eta_r <= 1");
  check("{model: cdt, friction: 0.1}", "{model: cdt, friction: -0.1}",
        "s.yaml:24:37: error: interactions[1].rolling.friction: -0.1 is outside mu_r >= 0");
  check("volume: 1e-13", "volume: -1e-13",
        "s.yaml:25:95: error: interactions[1].cohesion.volume: -1e-13 is outside V >= 0 m3");
}

TEST_CASE("a missing pair of materials shall be told with who meets") {
  check("[sand, glass]", "[glass, glass]",
        "s.yaml:17:1: error: interactions: missing pair [sand, glass]: grains of emitter 'feed' "
        "meet the wall 'bottom'");
}

TEST_CASE(
    "a moisture that cannot be read shall be told at the material alone, not by its bridges") {
  for (const char* wrong : {"1 furlong", "1 K", "1 2"}) {
    CAPTURE(wrong);
    const Reported t = reported(", contact_angle: 10 deg, volume: 1e-13", "",
                                {{"materials.sand.moisture", wrong}});
    REQUIRE(t.errors.size() == 1);
    CHECK(t.errors[0].find("error: materials.sand.moisture: ") != std::string::npos);
  }
}

TEST_CASE("a cohesion that does not fit its contact law or materials shall be told at its place") {
  check(
      "cohesion: {model: liquid_bridge, surface_tension: 72 mN/m, contact_angle: 10 deg, volume: "
      "1e-13}",
      "cohesion: {model: jkr, surface_energy: 0.05}",
      "s.yaml:25:23: error: interactions[1].cohesion: 'jkr' replaces the Hertz force, which the "
      "contact law 'hooke' does not have: choose another contact law or another cohesion");
  check("{model: jkr, surface_energy: 20 mJ/m2}", "{model: sjkr, energy_density: 10 MPa}",
        "s.yaml:21:23: error: interactions[0].cohesion: energy_density: 1e+07 Pa would pull the "
        "grains more than a tenth of R* into each other: at most 1.84356e+06 Pa goes with these "
        "materials (0.067 of their effective Young's modulus)");
  check("volume: 1e-13", "volume: 0",
        "s.yaml:25:23: error: interactions[1].cohesion: a bridge needs its liquid: give volume, "
        "relative_volume or moisture (of the law or of the materials), one of the three");
  check("{model: jkr, surface_energy: 20 mJ/m2}",
        "{model: lubrication, viscosity: 1 Pa s, smallest_gap: 0.05, reach: 0.04}",
        "s.yaml:21:23: error: interactions[0].cohesion: reach must lie above smallest_gap, for the "
        "film acts between the two: give less of the one or more of the other");
}

TEST_CASE("moisture of a material that makes liquid bridges shall be told where it cannot") {
  const std::string whole =
      "{model: liquid_bridge, surface_tension: 72 mN/m, contact_angle: 10 deg, volume: 1e-13}";
  const std::string at = "s.yaml:25:23: error: interactions[1].cohesion: ";
  check(
      whole, "{model: liquid_bridge, surface_tension: 72 mN/m, volume: 1e-13, moisture: [1 %, 0]}",
      at + "a bridge needs its liquid: give volume, relative_volume or moisture (of the law or of "
           "the materials), one of the three");
  check(
      whole, "{model: liquid_bridge, surface_tension: 72 mN/m, moisture: [1 %]}",
      at + "moisture: two numbers are expected, of the two materials in the order of between, like "
           "[2 %, 0]");
  // 4 pi / 3 of 0.09 times the densities of both over that of six times the water: beyond 0.1.
  const Reported wet =
      reported(whole, "{model: liquid_bridge, surface_tension: 72 mN/m, moisture: [9 %, 9 %]}");
  REQUIRE(wet.errors.size() == 1);
  CHECK(
      wet.errors[0].find("of liquid into a bridge; bridges are small and apart from each other up "
                         "to 0.1: give at most ") != std::string::npos);
}

TEST_CASE("a bridge that is told no liquid shall take the moisture of its materials") {
  const auto resolved = [](const std::string& material, const std::string& law) {
    std::string text = k_scenario;
    const std::string whole =
        "{model: liquid_bridge, surface_tension: 72 mN/m, contact_angle: 10 deg, volume: 1e-13}";
    text.replace(text.find(whole), whole.size(), law);
    const auto sand = text.find("sand: {density");
    REQUIRE(sand != std::string::npos);
    text.insert(sand + std::string("sand: {").size(), material);
    const fs::path folder = fs::temp_directory_path() / ("dust_wet_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    std::ofstream(folder / "s.yaml", std::ios::binary) << text;
    const auto read = preflight::read_scenario(folder / "s.yaml", {}, shipped(), {});
    fs::remove_all(folder);
    return std::get<std::vector<double>>(read.setup.interactions[1].cohesion->values.at(4));
  };
  const std::string law = "{model: liquid_bridge, surface_tension: 72 mN/m}";
  CHECK(resolved("moisture: 1 %, ", law) == std::vector<double>{0.01, 0.0});
  CHECK(resolved("moisture: 0, ", law) == std::vector<double>{0.0, 0.0});
  // As a run's own scenario.yaml says it, with both.
  CHECK(resolved("moisture: 1 %, ",
                 "{model: liquid_bridge, surface_tension: 72 mN/m, moisture: [1 %, 0]}") ==
        std::vector<double>{0.01, 0.0});
  // A liquid of its own stays; moisture that nothing reads is refused.
  CHECK_THROWS(resolved("moisture: 1 %, ",
                        "{model: liquid_bridge, surface_tension: 72 mN/m, moisture: [2 %, 0]}"));
  CHECK_THROWS(resolved("moisture: 1 %, ",
                        "{model: liquid_bridge, surface_tension: 72 mN/m, relative_volume: 0.01}"));
}

TEST_CASE("a convention that a law does not have shall be told with those it has") {
  check("contact: {model: hertz_mindlin, ", "contact: {model: hertz_mindlin, tangential: ligghts, ",
        "s.yaml:19:49: error: interactions[0].contact.tangential: 'ligghts' is none of rescaled, "
        "liggghts; did you mean 'liggghts'?");
}

TEST_CASE("an unknown cohesion shall be told with all there are") {
  check("model: jkr", "model: jkrs",
        "s.yaml:21:23: error: interactions[0].cohesion.model: unknown cohesion model 'jkrs'; did "
        "you mean 'jkr'? (cohesion models: dmt, jkr, liquid_bridge, lubrication, sjkr); plugins "
        "were looked for "
        "in " DUST_TEST_PLUGINS " (--plugin-path and DUST_PLUGIN_PATH name more folders)");
}

TEST_CASE("a corner without a unit beside one in mm shall be asked about") {
  const Reported wide = reported("min: [0, 0, 0]", "min: [-10, 0, 0]");
  CHECK(wide.errors.empty());
  REQUIRE(wide.warnings.size() == 1);
  CHECK(wide.warnings[0] ==
        "s.yaml:5:8: warning: domain.min: has no unit and is read in m, while domain.max is in mm: "
        "write mm or m behind its last number");
  // Nothing to ask: the same unit, metres said, nothing but zeros, another dimension (velocity).
  CHECK(reported("min: [0, 0, 0]", "min: [-10, 0, 0 mm]").warnings.empty());
  CHECK(reported("max: [10, 10, 50 mm]", "max: [0.01, 0.01, 0.05 m]").warnings.empty());
  CHECK(reported().warnings.empty());
}

TEST_CASE("a vector without a unit among others in mm shall be asked about") {
  const auto grains = [](const std::string& positions) {
    return reported("emitters:\n",
                    "emitters:\n  some: {model: single, material: sand, diameters: [0.3 mm], "
                    "positions: " +
                        positions + "}\n");
  };
  const Reported mixed = grains("[[0, 0, 0], [2, 2, 5], [3, 3, 5], [4, 4, 5 mm]]");
  CHECK(mixed.errors.empty());
  REQUIRE(mixed.warnings.size() == 1);
  CHECK(mixed.warnings[0] ==
        "s.yaml:27:85: warning: emitters.some.positions[1]: has no unit and is read in m, while "
        "emitters.some.positions[3] is in mm: write mm or m behind its last number");
  CHECK(grains("[[0, 0, 0], [2, 2, 5 mm], [3, 3, 5 mm]]").warnings.empty());
  CHECK(grains("[[0.002, 0.002, 0.005], [0.003, 0.003, 0.005 m]]").warnings.empty());
}

TEST_CASE("a fixed step above the stable one shall be told: warned of, or refused") {
  CHECK(reported("output_every: 1 ms", "output_every: 1 ms, dem_step: 0.5 us").warnings.empty());
  const Reported longer = reported("output_every: 1 ms", "output_every: 1 ms, dem_step: 2.5 us");
  CHECK(longer.errors.empty());
  REQUIRE(longer.warnings.size() == 1);
  CHECK(longer.warnings[0].starts_with(
      "s.yaml:2:68: warning: time.dem_step: 2.5e-06 s is longer than the stable step of grains of "
      "0.0003 m, "));
  CHECK(longer.warnings[0].ends_with(
      "collisions lose their accuracy; leave dem_step out or give at most that"));
  const Reported hopeless = reported("output_every: 1 ms", "output_every: 1 ms, dem_step: 20 us");
  REQUIRE(hopeless.errors.size() == 1);
  CHECK(hopeless.errors[0].starts_with(
      "s.yaml:2:68: error: time.dem_step: 2e-05 s is longer than the stable step of grains of "
      "0.0003 m, "));
  CHECK(hopeless.errors[0].ends_with(
      "the grains would fly apart; leave dem_step out or give at most that"));
}
