// SPDX-License-Identifier: Apache-2.0
// How far grains overlap in an impact, and what a scenario with a missing MPa is told.
#include "preflight/stiffness/softness.hpp"

#include "preflight/derived.hpp"
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace dust;

namespace {

// The law rounds the factor of its collision time to three digits, 2.87.
constexpr double k_duration = 1e-3;

const std::string k_box = R"(
name: box
time: {end: 0.1 s, fluid_step: 1 ms, output_every: 0.1 s, expected_speed: 2 m/s}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [100, 50, 200 mm]
  boundaries:
    left: {grains: open}
    right: {grains: open}
    front: {grains: open}
    back: {grains: open}
    bottom: {grains: wall, material: steel}
    top: {grains: open}
materials:
  sand: {density: 2500, young_modulus: 50 MPa, poisson_ratio: 0.3}
  steel: {density: 7800, young_modulus: 500 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [sand, steel]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
emitters:
  feed: {model: feed, material: sand, mass_flow: 0.1 kg/s, min: [20, 10, 150 mm], max: [60, 40, 150 mm], velocity: [0, 0, -1 m/s], diameters: [4 mm], mass_fractions: [1]}
fluid: none
)";

using Set = std::vector<scenario::Override>;

const registry::Registry& shipped_models() {
  static registry::Registry registry;
  static const bool is_loaded = (registry.load({DUST_TEST_PLUGINS}), true);
  (void)is_loaded;
  return registry;
}

scenario::ReadResult read_box(const Set& set) {
  const Folder folder;
  return preflight::read_scenario(folder.write("box.yaml", k_box), set, shipped_models());
}

preflight::ImpactOverlap impact(const Set& set) {
  return preflight::derive(read_box(set).setup, shipped_models()).impact;
}

/// The one warning; "" without any.
std::string warning(const Set& set) {
  const auto all = read_box(set).warnings;
  REQUIRE(all.size() < 2);
  return all.empty() ? std::string() : all.front();
}

}  // namespace

TEST_CASE("the overlap of an impact shall be that of Hertz, of any size of grains") {
  // On a wall: 1/2 m v^2 = 8/15 E* sqrt(R) delta^(5/2), so
  // delta/R = (5 pi rho v^2 / (4 E*))^(2/5). Two grains: half of m and of R.
  const double share = 1.0 - 0.3 * 0.3;
  const auto ratio = [](double young) {
    return std::pow(5.0 * std::numbers::pi * 2500.0 * 4.0 / (4.0 * young), 0.4);
  };
  const double of_two = ratio(0.5 * 5e7 / share) * std::pow(0.5, 0.2);
  CHECK(impact({}).ratio == test::approx(of_two).epsilon(k_duration));
  CHECK(impact({}).interaction == 0);
  CHECK(impact({}).speed == 2.0);
  CHECK(impact({{"emitters.feed.diameters", "[1 mm]"}}).ratio ==
        test::approx(of_two).epsilon(k_duration));
  const scenario::Override soft_wall = {"materials.steel.young_modulus", "20 MPa"};
  const double of_wall = ratio(1.0 / (share / 5e7 + share / 2e7));
  CHECK(impact({soft_wall}).ratio == test::approx(of_wall).epsilon(k_duration));
  CHECK(impact({soft_wall}).interaction == 1);
  // A wall that is not there is not met.
  CHECK(impact({soft_wall, {"domain.boundaries.bottom", "{grains: open}"}}).interaction == 0);
}

TEST_CASE("the overlap of a linear spring shall be that of its own collision time") {
  // delta = v sqrt(m / k), on the wall.
  const double mass = 2500.0 * std::numbers::pi / 6.0 * std::pow(4e-3, 3);
  const std::string hooke =
      "{model: hooke, normal_stiffness: 1 kN/m, restitution: 0.9, friction: 0.3}";
  const auto soft = impact({{"interactions[1].contact", hooke}});
  CHECK(soft.ratio == test::approx(2.0 * std::sqrt(mass / 1e3) / 2e-3).epsilon(1e-9));
  CHECK_FALSE(soft.is_hertz);
  const std::string text =
      warning({{"interactions[1].contact", hooke}, {"time.expected_speed", "3"}});
  CHECK(text.find("interactions[1].contact: grains of 4 mm overlap by 43 % of their radius") !=
        std::string::npos);
  CHECK(text.find("make interactions[1].contact at least 76 times as stiff") != std::string::npos);
}

TEST_CASE("where no speed is given impacts shall be those at the end of the largest fall") {
  const scenario::Override none = {"time.expected_speed", "0"};
  // The feed comes in with 1 m/s, all of a grain above 150 mm.
  const double speed = std::sqrt(1.0 + 2.0 * 9.81 * 0.152);
  const auto fallen = impact({none});
  CHECK(fallen.is_of_fall);
  CHECK(fallen.fall.height == test::approx(0.152).epsilon(1e-9));
  CHECK(fallen.speed == test::approx(speed).epsilon(1e-9));
  CHECK(fallen.ratio == test::approx(impact({}).ratio * std::pow(0.5 * speed, 0.8)).epsilon(1e-4));
  // Half as fast as the 2 m/s that are given: 2^(-4/5).
  CHECK(fallen.ratio_in_stream ==
        test::approx(impact({}).ratio * std::pow(0.5, 0.8)).epsilon(1e-4));
  CHECK(preflight::impact_speed_text(fallen) == "2 m/s, after a fall of 152 mm");
  // Steps are those of the feed.
  CHECK(preflight::derive(read_box({none}).setup, shipped_models()).steps.expected_speed == 1.0);
  // A given speed holds, and the fall is known.
  const auto given = impact({{"time.expected_speed", "0.8"}});
  CHECK(given.speed == 0.8);
  CHECK_FALSE(given.is_of_fall);
  CHECK(given.fall.speed == test::approx(speed).epsilon(1e-9));
  CHECK(preflight::impact_speed_text(given) == "0.8 m/s");
  // Nothing below that they could meet; then a plate.
  const scenario::Override open = {"domain.boundaries.bottom", "{grains: open}"};
  CHECK(impact({none, open}).fall.height == 0.0);
  CHECK(impact({none, open}).speed == 1.0);
  // The upper side of a plate, not its lower one.
  const scenario::Override plate = {
      "bodies.plate", "{shape: box, material: steel, min: [0, 0, 50 mm], max: [99, 49, 60 mm]}"};
  CHECK(impact({none, open, plate}).fall.height == test::approx(0.092).epsilon(1e-9));
  // Without weight nothing falls.
  CHECK(impact({none, {"gravity", "[0, 0, 0]"}}).speed == 1.0);
}

TEST_CASE("the modulus that is advised for the end of a fall shall make its impact small") {
  const scenario::Override none = {"time.expected_speed", "0"};
  const scenario::Override soft = {"materials.sand.young_modulus", "100 kPa"};
  const std::string text = warning({none, soft});
  INFO(text);
  CHECK(text.find("in an impact at 2 m/s, after a fall of 152 mm (sand on sand)") !=
        std::string::npos);
  CHECK(text.find("or say by time.expected_speed how fast they meet") != std::string::npos);
  const std::string words = "young_modulus at least ";
  const std::size_t at = text.find(words);
  REQUIRE(at != std::string::npos);
  const std::string wanted = text.substr(at + words.size(), text.find(',', at) - at - words.size());
  const double after = impact({none, {"materials.sand.young_modulus", wanted}}).ratio;
  CHECK(after <= preflight::k_soft_overlap * (1.0 + k_duration));
}

TEST_CASE("an overlap of a third at the end of a fall shall be warned of, as in a stream") {
  const scenario::Override none = {"time.expected_speed", "0"};
  const scenario::Override soft = {"materials.sand.young_modulus", "640 kPa"};
  const auto fallen = impact({none, soft});
  CHECK(fallen.ratio == test::approx(0.36).epsilon(0.03));
  CHECK(fallen.ratio_in_stream < preflight::k_warned_overlap);
  CHECK(warning({none, soft}).find("% of their radius in an impact at 2 m/s, after a fall") !=
        std::string::npos);
  CHECK(warning({none, {"materials.sand.young_modulus", "2 MPa"}}) == "");
}

TEST_CASE("a missing MPa shall be warned of with the modulus to write") {
  CHECK(warning({}) == "");
  const std::string text = warning({{"materials.sand.young_modulus", "5"}});
  INFO(text);
  CHECK(text.find("times their radius in an impact at 2 m/s (sand on sand)") != std::string::npos);
  CHECK(text.find("through each other and through walls") != std::string::npos);
  CHECK(text.find("young_modulus at least") != std::string::npos);
  CHECK(text.find("(it is 5 Pa: was MPa meant?)") != std::string::npos);
  // Soft on purpose: said in the line of the check, not warned of.
  CHECK(warning({{"materials.sand.young_modulus", "5 MPa"}}) == "");
}

TEST_CASE("grains that are heavy so as to stay where they are shall not be looked at") {
  CHECK(impact({{"materials.sand.density", "1e8"}}).ratio == 0.0);
}

TEST_CASE("the modulus that is advised shall be that of a small overlap") {
  for (const char* soft : {"5", "20 kPa", "1 MPa"}) {
    CAPTURE(soft);
    const scenario::ReadResult read = read_box({{"materials.sand.young_modulus", soft}});
    const auto before = preflight::derive(read.setup, shipped_models()).impact;
    const std::string advice = preflight::stiffness_advice(read.setup, before);
    INFO(advice);
    const std::string words = "give materials.sand.young_modulus at least ";
    REQUIRE(advice.starts_with(words));
    std::string wanted = advice.substr(words.size());
    wanted = wanted.substr(0, wanted.find(" ("));
    const double after = impact({{"materials.sand.young_modulus", wanted}}).ratio;
    CHECK(after <= preflight::k_soft_overlap * (1.0 + k_duration));
    CHECK(after > 0.9 * preflight::k_soft_overlap);
  }
}
