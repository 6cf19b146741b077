// SPDX-License-Identifier: Apache-2.0
// Grains that are too soft for what holds them together, and bridges too large for them.
#include "base/error.hpp"
#include "support/approx.hpp"
#include "unit/preflight/said.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace dust;

namespace {

/// Powder and rock; nothing moves fast.
const std::string k_powder_box = R"(
name: box
time: {end: 0.1 s, fluid_step: 1 ms, output_every: 0.1 s, expected_speed: 10 mm/s}
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
  powder: {density: 2500, young_modulus: 1 MPa, poisson_ratio: 0.3}
  rock: {density: 2500, young_modulus: 1 MPa, poisson_ratio: 0.3}
  steel: {density: 7800, young_modulus: 500 MPa, poisson_ratio: 0.3}
interactions:
  - between: [powder, powder]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [powder, rock]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [rock, rock]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [powder, steel]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
  - between: [rock, steel]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}
emitters:
  powder: {model: single, material: powder, positions: [[50, 20, 50 mm]], diameters: [10 um]}
  rock: {model: single, material: rock, positions: [[50, 20, 100 mm]], diameters: [4 mm]}
fluid: none
)";

test::Said powder_said(const std::vector<scenario::Override>& set) {
  return test::said_of(k_powder_box, set);
}

/// The one warning that says how deep grains pull themselves; "" without any.
std::string pulled_deep(const std::vector<scenario::Override>& set) {
  const test::Said all = powder_said(set);
  REQUIRE(all.errors == std::vector<std::string>{});
  REQUIRE(all.warnings.size() < 2);
  return all.warnings.empty() ? std::string() : all.warnings.front();
}

bool tells(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("grains that pull themselves deep into each other shall be warned of with a modulus") {
  struct Row {
    const char* law;
    const char* too_soft;  ///< powder of this modulus is warned of
  };
  const std::string path = "interactions[0].cohesion";
  for (const Row& r :
       {Row{"{model: dmt, surface_energy: 50 mJ/m2}", "1 MPa"},
        {"{model: jkr, surface_energy: 50 mJ/m2}", "1 MPa"},
        {"{model: liquid_bridge, surface_tension: 72 mN/m, relative_volume: 0.01}", "1 MPa"}}) {
    CAPTURE(r.law);
    const std::string text =
        pulled_deep({{path, r.law}, {"materials.powder.young_modulus", r.too_soft}});
    INFO(text);
    CHECK(tells(text, path + ": grains of 10 um pull themselves "));
    CHECK(tells(text, " % of R* into each other (powder on powder)"));
    const std::string words = "give materials.powder.young_modulus at least ";
    REQUIRE(tells(text, words));
    std::string wanted = text.substr(text.find(words) + words.size());
    wanted = wanted.substr(0, wanted.find(','));
    // Enough, and not much more than that.
    CHECK(pulled_deep({{path, r.law}, {"materials.powder.young_modulus", wanted}}) == "");
    const double half = 0.5 * std::stod(wanted);
    CHECK(pulled_deep({{path, r.law},
                       {"materials.powder.young_modulus",
                        std::to_string(half) + wanted.substr(wanted.find(' '))}}) != "");
    // What sticks as much and is large is not pulled in.
    CHECK(pulled_deep({{"interactions[2].cohesion", r.law}}) == "");
  }
}

TEST_CASE("the pull of linear springs shall be held against their own stiffness") {
  // 4 pi R* gamma over k, R* 2.5 um: 1.1 um at 2 N/m, where Hertz of these materials would give
  // more than a tenth of R* whatever k.
  const auto with = [](const std::string& stiffness) {
    return pulled_deep(
        {{"interactions[0].contact",
          "{model: hooke, normal_stiffness: " + stiffness + ", restitution: 0.5, friction: 0.5}"},
         {"interactions[0].cohesion",
          "{model: liquid_bridge, surface_tension: 72 mN/m, relative_volume: 0.01}"}});
  };
  const std::string text = with("2 N/m");
  INFO(text);
  CHECK(tells(text, "pull themselves 45 % of R* into each other"));
  CHECK(tells(text, "make interactions[0].contact at least 5 times as stiff"));
  CHECK(with("10 N/m") == "");
}

TEST_CASE("bridges too large for the smallest grains of their law shall be refused") {
  const auto bridges = [](int pair, const std::string& volume) {
    return std::vector<scenario::Override>{
        {"interactions[" + std::to_string(pair) + "].cohesion",
         "{model: liquid_bridge, surface_tension: 72 mN/m, volume: " + volume + "}"}};
  };
  // R* 1 mm: 0.1 (2 R*)^3 is 0.8 mm3. The powder is none of this law's.
  CHECK(powder_said(bridges(2, "0.79 mm3")).errors == std::vector<std::string>{});
  const test::Said large = powder_said(bridges(2, "10 mm3"));
  REQUIRE(large.errors.size() == 1);
  INFO(large.errors[0]);
  CHECK(tells(large.errors[0],
              "error: interactions[2].cohesion.volume: 10 mm3 is 1.25 (2 R*)^3 of "
              "the smallest pair (R* 1 mm)"));
  CHECK(tells(large.errors[0], "up to 0.1: give at most 0.8 mm3, or relative_volume"));
  // On a wall R* is the radius: 6.4 mm3.
  CHECK(powder_said(bridges(4, "6.3 mm3")).errors == std::vector<std::string>{});
  CHECK(powder_said(bridges(4, "6.5 mm3")).errors.size() == 1);
  // Rock with powder: R* is nearly the powder's radius.
  CHECK(powder_said(bridges(1, "0.5 mm3")).errors.size() == 1);
}
