// SPDX-License-Identifier: Apache-2.0
// What an engineer reads off a transfer point, through the whole program.
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::engine;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// A figure of a sensor in summary.json.
double figure(const std::string& summary, const std::string& sensor, const std::string& name) {
  auto at = summary.find("\"sensors\": {");
  for (const std::string& key : {sensor, name, std::string("value")}) {
    at = summary.find("\"" + key + "\"", at);
    REQUIRE(at != std::string::npos);
  }
  return std::stod(summary.substr(summary.find(':', at) + 1));
}

/// The number behind a chain of keys, each looked for behind the one before.
double number_at(const std::string& summary, const std::vector<std::string>& keys) {
  std::size_t at = 0;
  for (const std::string& key : keys) {
    at = summary.find("\"" + key + "\":", at);
    REQUIRE(at != std::string::npos);
    at += key.size() + 3;
  }
  return std::stod(summary.substr(summary.find_first_of("-0123456789", at)));
}

/// Three blocks (spheres that cannot roll) that slide down a plate at 30 degrees.
const std::string k_slide = R"(
time: {end: 0.6 s, fluid_step: 1 ms, output_every: 0.6 s, expected_speed: 1 m/s}
gravity: [4.905, 0, -8.495709211]
domain:
  min: [0, 0, 0]
  max: [1, 0.4, 0.3 m]
  boundaries:
    left: {grains: open}
    right: {grains: open}
    front: {grains: open}
    back: {grains: open}
    bottom: {grains: wall, material: steel}
    top: {grains: open}
materials:
  limestone: {density: 2700, young_modulus: 50 MPa, poisson_ratio: 0.3}
  steel: {density: 7850, young_modulus: 50 MPa, poisson_ratio: 0.3}
interactions:
  - between: [limestone, limestone]
    contact: {model: hertz_mindlin, restitution: 0.3, friction: 0.6}
  - between: [limestone, steel]
    contact: {model: hertz_mindlin, restitution: 0.05, friction: 0.3}
    rolling: {model: epsd2, friction: 20}
emitters:
  blocks: {model: single, material: limestone, diameters: [60 mm],
    positions: [[50, 100, 30.001 mm], [50, 200, 30.001 mm], [50, 300, 30.001 mm]]}
fluid: none
sensors:
  liner: {model: wear, min: [0, 0, -5 mm], max: [1, 0.4, 0.005 m], cell: 50 mm, coefficient: 2e-3, hardness: 4 GPa}
  stay: {model: residence_time, min: [0.1, 0, 0 m], max: [0.4, 0.4, 0.3 m]}
  age: {model: residence_time, from: birth, min: [0.1, 0, 0 m], max: [0.4, 0.4, 0.3 m]}
  chute: {model: blockage, min: [0.1, 0, 0 m], max: [0.4, 0.4, 0.3 m], largest_mass: 0.5 kg}
)";

/// The scenario's run; its summary.json.
std::string slide(const TemporaryFolder& folder, const std::string& end = "0.6 s") {
  const fs::path scenario = folder / "slide.yaml";
  std::ofstream(scenario) << k_slide;
  const fs::path out = folder / "out";
  const auto run = engine({"run", scenario, "-o", out, "--quiet", "--set", "time.end=" + end});
  INFO(run.err);
  REQUIRE(run.status == 0);
  return read_file(out / "summary.json");
}

constexpr double k_acceleration = 4.905 - 0.3 * 8.495709211;            ///< [m/s2] down the plate
const double k_mass = 2700 * std::numbers::pi / 6 * std::pow(0.06, 3);  ///< [kg] of a block

}  // namespace

TEST_CASE("blocks that slide down a liner shall wear it by Archard's law within one per cent") {
  const TemporaryFolder folder;
  const std::string summary = slide(folder);
  const double press = k_mass * 8.495709211;
  const double way = 0.5 * k_acceleration * 0.6 * 0.6;
  const double worn = 3 * 2e-3 * press * way / 4e9;
  CHECK(figure(summary, "liner", "volume") == approx(worn).epsilon(0.01));
  CHECK(figure(summary, "liner", "normal_force") == approx(3 * press).epsilon(0.01));
}

TEST_CASE("wear shall not depend on how long the fluid step is") {
  const auto worn = [](const std::string& fluid_step) {
    const TemporaryFolder folder;
    const fs::path scenario = folder / "slide.yaml";
    std::ofstream(scenario) << k_slide;
    const fs::path out = folder / "out";
    // Let fall from 20 mm, so that the blocks bounce before they slide.
    const auto run =
        engine({"run", scenario, "-o", out, "--quiet", "--set", "time.end=0.3 s", "--set",
                "time.fluid_step=" + fluid_step, "--set", "time.dem_step=20 us", "--set",
                "time.output_every=0.3 s", "--set", "sensors.liner.walls=[bottom]", "--set",
                "emitters.blocks.positions=[[50, 200, 50 mm]]"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    return figure(read_file(out / "summary.json"), "liner", "volume");
  };
  CHECK(worn("10 ms") == approx(worn("1 ms")).epsilon(1e-6));
}

TEST_CASE("the forces on blocks that slide shall have the shares of a slope with friction") {
  const TemporaryFolder folder;
  const std::string summary = slide(folder);
  const auto over_weight = [&](const char* kind) {
    return number_at(summary, {"forces", "kinds", kind, "over_weight"});
  };
  const double cosine = 8.495709211 / 9.81;
  CHECK(over_weight("gravity") == approx(1.0));
  CHECK(over_weight("contact_normal") == approx(cosine).epsilon(0.01));
  CHECK(over_weight("contact_tangential") == approx(0.3 * cosine).epsilon(0.01));
  CHECK(number_at(summary, {"forces", "kinds", "contact_tangential", "share"}) ==
        approx(0.3 * cosine / (1.0 + 1.3 * cosine)).epsilon(0.01));
  CHECK(over_weight("drag") == 0.0);
  CHECK(summary.find("contact hertz_mindlin (limestone, steel)") != std::string::npos);
}

TEST_CASE("blocks that have slid off the end shall be named with place and step") {
  const TemporaryFolder folder;
  const std::string summary = slide(folder, "1 s");
  // Found at the end of the fluid step in which they pass 1 m.
  const double time = std::sqrt(2.0 * 0.95 / k_acceleration);
  CHECK(number_at(summary, {"grains_left", "right", "count"}) == 3.0);
  CHECK(number_at(summary, {"grains_left", "right", "mass_kg"}) == approx(3.0 * k_mass));
  CHECK(number_at(summary, {"grains_left", "right", "place_m"}) == approx(1.0).epsilon(0.01));
  const double seen = number_at(summary, {"grains_left", "right", "time_s"});
  CHECK(seen == approx(time).epsilon(0.005));
  CHECK(number_at(summary, {"grains_left", "right", "step"}) ==
        approx(seen / number_at(summary, {"dem_step_s"})).epsilon(1e-6));
  CHECK(number_at(summary, {"particles", "left"}) == 3.0);
  const std::string log = read_file(folder / "out" / "run.log");
  CHECK(log.find("left by the side 'right': 3 grains") != std::string::npos);
  CHECK(log.find("forces that act: gravity, contact hertz_mindlin (limestone, limestone)") !=
        std::string::npos);
}

TEST_CASE("blocks that slide shall stay in a box as long as uniform acceleration says") {
  const TemporaryFolder folder;
  const std::string summary = slide(folder);
  // Their centres start at 0.05 m; faces at 0.1 and 0.4 m.
  const double in = std::sqrt(2.0 * 0.05 / k_acceleration);
  const double out = std::sqrt(2.0 * 0.35 / k_acceleration);
  CHECK(figure(summary, "stay", "grains") == 3.0);
  CHECK(figure(summary, "stay", "mean") == approx(out - in).epsilon(0.005));
  CHECK(figure(summary, "age", "mean") == approx(out).epsilon(0.005));
  // Three come in and go out; in between more than half a kilogram is in the region.
  CHECK(figure(summary, "chute", "inflow") == approx(3.0 * k_mass / 0.6).epsilon(1e-9));
  CHECK(figure(summary, "chute", "outflow") == approx(3.0 * k_mass / 0.6).epsilon(1e-9));
  CHECK(figure(summary, "chute", "mass_held_at_end") == 0.0);
  CHECK(figure(summary, "chute", "mass_held_largest") == approx(3.0 * k_mass));
  CHECK(figure(summary, "chute", "first_beyond_largest_mass") == approx(in).epsilon(0.01));
  CHECK(figure(summary, "chute", "time_beyond_largest_mass") == approx(out - in).epsilon(0.01));
}
